// The plain statement of a medium: what kernels and shaders sample, one place at a time, in double precision.
#include "engine/medium/model/medium.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "engine/base/error.h"
#include "engine/medium/model/medium_extent.h"

namespace stereonav {
namespace {

bool insideGrid(const VolumeFrame& frame, const glm::dvec3& voxel) {
    for (int a = 0; a < 3; ++a)
        if (!(voxel[a] >= 0 && voxel[a] <= frame.size[a] - 1)) return false;  // NaN too
    return true;
}

// Returns the trilinear value. voxel: clamped to the grid.
double valueAt(const GreyVolume& field, const glm::dvec3& voxel) {
    const glm::ivec3 size = field.frame.size;
    const glm::dvec3 inside = glm::clamp(voxel, glm::dvec3(0.0), glm::dvec3(size - 1));
    const glm::ivec3 low = glm::min(glm::ivec3(inside), glm::max(size - 2, 0));
    const glm::ivec3 high = glm::min(low + 1, size - 1);
    const glm::dvec3 s = inside - glm::dvec3(low);
    const auto alongRow = [&](int j, int k) {
        return field.at(low.x, j, k) * (1 - s.x) + field.at(high.x, j, k) * s.x;
    };
    const auto inSlice = [&](int k) { return alongRow(low.y, k) * (1 - s.y) + alongRow(high.y, k) * s.y; };
    const double stored = inSlice(low.z) * (1 - s.z) + inSlice(high.z) * s.z;
    return stored * field.scale + field.offset;
}

// Returns the gradient in value units per metre, world axes. Beyond the faces the outermost voxels are
// repeated; the step stays two voxels.
glm::dvec3 gradientOf(const GreyVolume& field, const glm::dvec3& voxel) {
    glm::dvec3 gradient(0.0);
    for (int a = 0; a < 3; ++a) {
        glm::dvec3 step(0.0);
        step[a] = 1;
        gradient[a] =
            (valueAt(field, voxel + step) - valueAt(field, voxel - step)) / (2 * field.frame.spacing[a]);
    }
    return field.frame.axes * gradient;
}

WorldBox grown(WorldBox box, double metres) {
    if (box.empty()) return {};
    box.low -= metres;
    box.high += metres;
    return box;
}

void include(WorldBox& box, const WorldBox& other) {
    if (other.empty()) return;
    box = box.empty() ? other : WorldBox{glm::min(box.low, other.low), glm::max(box.high, other.high)};
}

WorldBox worldBoxOf(const VolumeFrame& frame, const CellBox& cells) {
    if (cells.empty()) return {};
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    WorldBox box{glm::dvec3(kInfinity), glm::dvec3(-kInfinity)};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::bvec3 high(corner & 1, corner & 2, corner & 4);
        const glm::dvec3 world = frame.worldFromVoxel(glm::dvec3(glm::mix(cells.first, cells.last, high)));
        box.low = glm::min(box.low, world);
        box.high = glm::max(box.high, world);
    }
    return box;
}

WorldBox worldBoxOf(const HeightLayer& layer) {
    if (layer.levels.empty() || !(layer.lowest < layer.highest)) return {};
    const Plane<float>& heights = layer.levels[0];
    return {{layer.originX, layer.originY, layer.lowest},
            {layer.originX + (heights.width() - 1) * layer.spacing,
             layer.originY + (heights.height() - 1) * layer.spacing, layer.highest}};
}

void checkLayer(const HeightLayer& layer, const std::string& place) {
    const auto fail = [&](const std::string& problem, const char* advice) {
        throw Error("medium", place, problem, advice);
    };
    if (!(layer.spacing > 0 && std::isfinite(layer.spacing + layer.originX + layer.originY)))
        fail(fmt::format("expected heights at finite places, above 0 m apart, got {} m", layer.spacing),
             "check the spacing and the origin");
    if (!(layer.below + layer.above > 0 && std::isfinite(layer.below) && std::isfinite(layer.above)))
        fail(fmt::format("expected a layer with a thickness, got {} m below and {} m above the height",
                         layer.below, layer.above),
             "give distances whose sum is above 0");
    if (layer.color &&
        (layer.color->levelCount() == 0 || !(layer.colorSpacing.x > 0 && layer.colorSpacing.y > 0)))
        fail("expected a texture with texels, some metres across", "leave the texture out");
    if (!(layer.taper >= 0 && std::isfinite(layer.taper)))
        fail(fmt::format("expected a taper of 0 m or more, got {}", layer.taper), "0 has sharp faces");
}

// Several media in one place: extinctions add up, the rest by its share of them.
void add(OpticalProperties& sum, const OpticalProperties& other) {
    if (!(other.extinction > 0)) return;
    const float share = other.extinction / (sum.extinction + other.extinction);
    sum.extinction += other.extinction;
    sum.indirectExtinction += other.indirectExtinction;
    sum.color = glm::mix(sum.color, other.color, share);
    sum.surface = glm::mix(sum.surface, other.surface, share);
    sum.glow = glm::mix(sum.glow, other.glow, share);
}

// Slopes by the neighbours one sample away; 0 where they are not known.
glm::dvec3 normalOf(const HeightLayer& layer, double x, double y) {
    const double d = layer.spacing;
    const double alongX = (layer.heightAt(x + d, y, 0) - layer.heightAt(x - d, y, 0)) / (2 * d);
    const double alongY = (layer.heightAt(x, y + d, 0) - layer.heightAt(x, y - d, 0)) / (2 * d);
    return glm::normalize(
        glm::dvec3(std::isfinite(alongX) ? -alongX : 0.0, std::isfinite(alongY) ? -alongY : 0.0, 1.0));
}

}  // namespace

Medium::Medium(std::shared_ptr<const GreyVolume> field, const MediumTransfer& transfer,
               Perturbation perturbation)
    : mField(std::move(field)) {
    usePerturbation(std::move(perturbation));
    if (!mField || mField->empty()) {
        mField = nullptr;
        return;
    }
    const GreyRange values = valueRange(*mField);
    mTable = makeMediumTable(transfer, values.lowest, values.highest);
    const MediumTransfer::Range visible = mTable.visibleRange();
    mBounds = grown(worldBoxOf(mField->frame, cellsBetween(*mField, visible.lowest, visible.highest)),
                    mPerturbation.largestDisplacement());
    mLargestExtinction =
        mTable.largestExtinction(values.lowest, values.highest) * mPerturbation.largestExtinctionFactor();
}

Medium::Medium(std::vector<HeightLayer> layers, Perturbation perturbation) : mLayers(std::move(layers)) {
    for (std::size_t n = 0; n < mLayers.size(); ++n) checkLayer(mLayers[n], "layer " + std::to_string(n + 1));
    usePerturbation(std::move(perturbation));
    for (const HeightLayer& layer : mLayers) {
        include(mBounds, worldBoxOf(layer));
        mLargestExtinction +=
            layer.table.largestExtinction(layer.lowest - layer.above, layer.highest + layer.below) *
            mPerturbation.largestExtinctionFactor();
    }
    mBounds = grown(mBounds, mPerturbation.largestDisplacement());
}

void Medium::usePerturbation(Perturbation perturbation) {
    checkPerturbation(perturbation, "perturbation");
    mPerturbation = std::move(perturbation);
    if (mPerturbation.any()) mNoise = std::make_shared<NoiseVolume>(mPerturbation.seed);
}

glm::dvec3 Medium::displaced(const glm::dvec3& world, double time) const {
    return mNoise ? world + displacementAt(mPerturbation, *mNoise, world, time) : world;
}

OpticalProperties Medium::unperturbed(const glm::dvec3& place, double footprint) const {
    OpticalProperties sum;
    if (mField) {
        const glm::dvec3 voxel = mField->frame.voxelFromWorld(place);
        if (!insideGrid(mField->frame, voxel)) return sum;
        const double gradient = mTable.usesGradient() ? glm::length(gradientOf(*mField, voxel)) : 0.0;
        return mTable.at(valueAt(*mField, voxel), gradient);
    }
    for (const HeightLayer& layer : mLayers) add(sum, layer.at(place, footprint));
    return sum;
}

OpticalProperties Medium::at(const glm::dvec3& world, double time, double footprint) const {
    OpticalProperties properties = unperturbed(displaced(world, time), footprint);
    if (mNoise && properties.extinction > 0) perturb(mPerturbation, *mNoise, world, time, properties);
    return properties;
}

glm::dvec3 Medium::gradientAt(const glm::dvec3& world, double time) const {
    const glm::dvec3 place = displaced(world, time);
    if (mField) {
        const glm::dvec3 voxel = mField->frame.voxelFromWorld(place);
        return insideGrid(mField->frame, voxel) ? gradientOf(*mField, voxel) : glm::dvec3(0.0);
    }
    const HeightLayer* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const HeightLayer& layer : mLayers) {
        const double distance = std::abs(place.z - layer.heightAt(place.x, place.y, 0));
        if (!(distance < least)) continue;
        least = distance;
        nearest = &layer;
    }
    return nearest ? normalOf(*nearest, place.x, place.y) : glm::dvec3(0.0);
}

}  // namespace stereonav
