// Doubles and world coordinates become floats relative to the anchor here, and nowhere else.
#include "engine/medium/sweep/sweep_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "engine/base/error.h"
#include "engine/medium/model/medium_extent.h"
#include "engine/volume/baked_data.h"

namespace stereonav {
namespace {

constexpr std::size_t kReadAhead = 16;  // numbers behind the last that vector code may read

void setVector(float (&to)[3], const glm::dvec3& from) {
    for (int k = 0; k < 3; ++k) to[k] = static_cast<float>(from[k]);
}
void setVector(double (&to)[3], const glm::dvec3& from) {
    for (int k = 0; k < 3; ++k) to[k] = from[k];
}

SweepLight lightOf(const SweepGeometry& g, double blur) {
    const RayFan& fan = g.light;
    SweepLight light;
    light.parallel = fan.parallel;
    setVector(light.origin, fan.origin);
    setVector(light.right, fan.right);
    setVector(light.up, fan.up);
    setVector(light.forward, fan.forward);
    setVector(light.axis,
              {glm::dot(fan.right, g.axis), glm::dot(fan.up, g.axis), glm::dot(fan.forward, g.axis)});
    light.xMin = static_cast<float>(fan.xMin);
    light.yMax = static_cast<float>(fan.yMax);
    light.perX = static_cast<float>(fan.perX);
    light.perY = static_cast<float>(fan.perY);
    light.width = fan.width;
    light.height = fan.height;
    light.length = static_cast<float>(1 / std::max(glm::dot(fan.forward, g.axis), kLeastCosine));
    light.start = fan.parallel ? 0.0f : static_cast<float>(g.lightStart);
    light.inverseFalloffSquared = g.falloff > 0 ? static_cast<float>(1 / (g.falloff * g.falloff)) : 0.0f;
    light.lampCosine = static_cast<float>(g.lampCosine);
    light.blur = static_cast<float>(blur);
    light.leaning = static_cast<float>(g.leaning);
    return light;
}

// Each entry and the next, of 0 to 1, as a word of 15-bit halves.
std::vector<std::uint32_t> pairsOf(const std::vector<float>& entries) {
    std::vector<std::uint32_t> pairs;
    const auto half = [&](std::size_t n) {
        return static_cast<std::uint32_t>(entries[std::min(n, entries.size() - 1)] * 32767 + 0.5f);
    };
    for (std::size_t n = 0; n < entries.size(); ++n) pairs.push_back(half(n) | half(n + 1) << 16);
    return pairs;
}

// Sets baked light by the texels' own frame: it may lie in any way, and layers need no grid.
void setBaked(SweepLook& to, const BakedLook& look, const glm::dvec3& anchor) {
    const VolumeFrame& frame = look.light->frame;
    to.baked = bakedDataOf(look, frame);
    const glm::dvec3 zero = frame.voxelFromWorld(anchor);
    for (int k = 0; k < 3; ++k) {
        setVector(to.texelFromPlace[k], frame.axes[k] / frame.spacing[k]);
        to.texelZero[k] = static_cast<float>(zero[k]);
    }
}

}  // namespace

SweepData::SweepData(const Medium& medium) : mMedium(medium) {
    if (const GreyVolume* field = medium.field()) {
        if (field->frame.count() >= 0x7fffffffu)
            throw Error("", "volume", fmt::format("{} voxels are more than 2^31", field->frame.count()),
                        "crop it or take every second voxel");
        takeTable(medium.table(), field->scale, field->offset, mGridTable);
        if (mGridTable.data.surface || mGridTable.data.rows > 1) {
            const GreyRange range = valueRange(*field);
            mNarrow = range.highest - range.lowest < 32767 * std::abs(field->scale);
        }
    }
    mBase = medium.bounds().center().z;
    mLayerTables.resize(medium.layers().size());
    for (const HeightLayer& layer : medium.layers())
        if (!layer.levels.empty() && !layer.levels[0].empty()) takeLayer(layer);
}

// Takes a table for values stored as (value - offset) / scale.
void SweepData::takeTable(const MediumTable& table, double scale, double offset, Table& to) {
    const std::size_t count = table.entries.size();
    for (auto& member : to.members) member.assign(count + kReadAhead, 0.0f);
    bool surface = false, glow = false;
    for (std::size_t n = 0; n < count; ++n) {
        const OpticalProperties& p = table.entries[n];
        const float values[11] = {p.extinction,
                                  p.indirectExtinction.x,
                                  p.indirectExtinction.y,
                                  p.indirectExtinction.z,
                                  p.color.x,
                                  p.color.y,
                                  p.color.z,
                                  p.surface,
                                  p.glow.x,
                                  p.glow.y,
                                  p.glow.z};
        for (int k = 0; k < 11; ++k) to.members[k][n] = values[k];
        float& most = to.members[11][n % SweepTable::kColumns];
        most = std::max(most, p.surface);
        surface = surface || p.surface > 0;
        glow = glow || p.glow.x > 0 || p.glow.y > 0 || p.glow.z > 0;
    }
    SweepTable& d = to.data;
    d.extinction = to.members[0].data();
    for (int k = 0; k < 3; ++k) {
        d.indirect[k] = to.members[1 + k].data();
        d.color[k] = to.members[4 + k].data();
        d.glow[k] = glow ? to.members[8 + k].data() : nullptr;
    }
    d.surface = surface ? to.members[7].data() : nullptr;
    d.mostSurface = to.members[11].data();
    d.uniform = true;
    for (int k = 0; k < 11; ++k)
        for (std::size_t n = 0; n < count; ++n) d.uniform = d.uniform && to.members[k][n] == to.members[k][0];
    d.rowsOfSurface = true;
    for (int k = 0; k < 11; ++k)
        for (std::size_t n = SweepTable::kColumns; n < count && k != 7; ++n)
            d.rowsOfSurface = d.rowsOfSurface && to.members[k][n] == to.members[k][n % SweepTable::kColumns];
    d.perValue = static_cast<float>(scale * table.perValue);
    d.zero = static_cast<float>((offset - table.firstValue) * table.perValue);
    d.perGradient = static_cast<float>(table.perGradient);
    d.rows = table.rows;
    if (d.surface && d.rowsOfSurface) takePairs(to);
}

// Surface ramps multiply each column's weight by a share of the row's: two small tables are as good then.
void SweepData::takePairs(Table& table) {
    constexpr std::size_t kColumns = SweepTable::kColumns;
    const std::vector<float>&most = table.members[11], &surface = table.members[7];
    const auto column = static_cast<std::size_t>(
        std::max_element(most.begin(), most.begin() + static_cast<std::ptrdiff_t>(kColumns)) - most.begin());
    std::vector<float> weights(most.begin(), most.begin() + static_cast<std::ptrdiff_t>(kColumns)), shares;
    const auto rows = static_cast<std::size_t>(table.data.rows);
    for (std::size_t row = 0; row < rows; ++row) {
        shares.push_back(surface[row * kColumns + column] / most[column]);
        for (std::size_t n = 0; n < kColumns; ++n)
            if (std::abs(surface[row * kColumns + n] - weights[n] * shares.back()) > 1e-5f) return;
    }
    table.surfacePairs = pairsOf(weights);
    table.sharePairs = pairsOf(shares);
    table.data.surfacePairs = table.surfacePairs.data();
    if (rows > 1) table.data.sharePairs = table.sharePairs.data();
}

void SweepData::takeLayer(const HeightLayer& layer) {
    const std::size_t n = mLayers.size();
    takeTable(layer.table, 1, mBase, mLayerTables[n]);
    SweepLayer d;
    std::vector<float> heights;
    for (const Plane<float>& level : layer.levels) {
        if (d.levels == SweepLayer::kMostLevels) break;
        d.start[d.levels] = static_cast<std::uint32_t>(heights.size());
        d.width[d.levels] = static_cast<std::uint32_t>(level.width());
        d.height[d.levels] = static_cast<std::uint32_t>(level.height());
        ++d.levels;
        for (int y = 0; y < level.height(); ++y)
            for (int x = 0; x < level.width(); ++x)
                heights.push_back(static_cast<float>(level.at(x, y) - mBase));
    }
    d.flat = std::all_of(heights.begin(), heights.end(), [&](float h) { return h == heights.front(); });
    d.holes = !std::all_of(heights.begin(), heights.end(), [](float h) { return std::abs(h) < 1e30f; });
    heights.resize(heights.size() + kReadAhead);
    mHeights.push_back(std::move(heights));
    d.heights = mHeights.back().data();
    d.table = mLayerTables[n].data;
    d.perMetre = static_cast<float>(1 / layer.spacing);
    d.below = static_cast<float>(layer.below);
    d.above = static_cast<float>(layer.above);
    d.perTaper = layer.taper > 0 ? static_cast<float>(1 / layer.taper) : 0.0f;
    mLayers.push_back(d);
}

void SweepData::setGrid(SweepGrid& grid, const glm::dvec3& anchor) const {
    const GreyVolume* field = mMedium.field();
    if (!field) return;
    const VolumeFrame& frame = field->frame;
    const glm::dvec3 zero = frame.voxelFromWorld(anchor);
    grid.values = field->values.data();
    grid.strideY = frame.size.x;
    grid.strideZ = frame.size.x * frame.size.y;
    for (int k = 0; k < 3; ++k) {
        grid.lastCell[k] = std::max(frame.size[k] - 2, 0);
        grid.last[k] = static_cast<float>(frame.size[k] - 1);
        setVector(grid.fromPlace[k], frame.axes[k] / frame.spacing[k]);
        grid.zero[k] = static_cast<float>(zero[k]);
        grid.slope[k] = static_cast<float>(field->scale / (2 * frame.spacing[k]));
        setVector(grid.axes[k], {frame.axes[0][k], frame.axes[1][k], frame.axes[2][k]});
    }
    grid.table = mGridTable.data;
    grid.large = std::min({frame.size.x, frame.size.y, frame.size.z}) >= 8;
    grid.blocks = mNarrow && grid.large;
}

void SweepData::setLayers(const glm::dvec3& anchor) {
    std::size_t n = 0;
    for (const HeightLayer& layer : mMedium.layers()) {
        if (layer.levels.empty() || layer.levels[0].empty()) continue;
        SweepLayer& d = mLayers[n++];
        d.zero[0] = static_cast<float>((anchor.x - layer.originX) / layer.spacing);
        d.zero[1] = static_cast<float>((anchor.y - layer.originY) / layer.spacing);
        if (layer.color)
            d.color = layer.color->forKernels(glm::dvec2(layer.originX, layer.originY) - glm::dvec2(anchor),
                                              layer.colorSpacing);
        d.base = static_cast<float>(mBase - anchor.z);
        d.lowest = static_cast<float>(layer.lowest - anchor.z);
        d.highest = static_cast<float>(layer.highest - anchor.z);
    }
}

void SweepData::setNoise(SweepNoise& noise, const glm::dvec3& anchor, double time) const {
    if (!mMedium.noise()) return;
    noise.texels = reinterpret_cast<const std::uint32_t*>(mMedium.noise()->bytes().data());
    for (const NoiseScale& s : mMedium.perturbation().scales) {
        SweepNoise::Scale& d = noise.scale[noise.scales++];
        const glm::dvec3 texel = noiseTexel(s, anchor, time);
        const double size = NoiseVolume::kSize;
        d.perMetre = static_cast<float>(size / s.size);
        setVector(d.zero, texel - size * glm::floor(texel / size));
        d.displacement = static_cast<float>(s.displacement);
        d.extinction = s.extinction;
        setVector(d.color, s.color);
        setVector(d.indirect, s.indirect);
    }
}

void SweepData::setLook(SweepLook& to, const MediumLook& look, const glm::dvec3& anchor) {
    to.model = static_cast<int>(look.model);
    to.indirectShare = look.indirectShare;
    to.ambient = look.ambient;
    to.diffuse = look.diffuse;
    to.specular = look.specular;
    to.shininess = look.shininess;
    if (look.baked.light) setBaked(to, look.baked, anchor);
    if (look.phase.isotropic()) return;
    const auto& entries = look.phase.entries();
    for (int k = 0; k < 3; ++k) {
        mPhase[k].assign(entries.size() + kReadAhead, 0.0f);
        for (std::size_t n = 0; n < entries.size(); ++n) mPhase[k][n] = entries[n][k];
        to.phase[k] = mPhase[k].data();
    }
}

SweepScene SweepData::sceneFor(const MediumLook& look, const SweepSetting& setting,
                               const SweepGeometry& geometry, double time) {
    SweepScene scene;
    setGrid(scene.grid, geometry.anchor);
    setLayers(geometry.anchor);
    scene.layers = mLayers.data();
    scene.layerCount = static_cast<int>(mLayers.size());
    setNoise(scene.noise, geometry.anchor, time);
    const SweepTable& table = scene.grid.table;
    scene.gridAlone = scene.grid.values && mLayers.empty() && !scene.noise.texels &&
                      (table.rows == 1 || table.rowsOfSurface);
    setLook(scene.look, look, geometry.anchor);
    setVector(scene.look.radiance, geometry.radiance);
    if (scene.gridAlone && table.surface && !scene.look.baked.texels)
        scene.shadingWidth = static_cast<float>(setting.shadingWidth);
    scene.light = lightOf(geometry, blurOf(mMedium, setting));
    return scene;
}

std::size_t SweepData::heldBytes() const {
    std::size_t numbers = mPhase[0].size() * 3;
    const auto count = [&](const Table& t) {
        for (const auto& member : t.members) numbers += member.size();
        numbers += t.surfacePairs.size() + t.sharePairs.size();
    };
    count(mGridTable);
    for (const Table& t : mLayerTables) count(t);
    for (const auto& h : mHeights) numbers += h.size();
    return numbers * sizeof(float);
}

SweepEye sweepEye(const RayFan& fan, const SweepGeometry& geometry) {
    SweepEye eye;
    eye.forward = geometry.forward;
    setVector(eye.origin, fan.origin);
    setVector(eye.right, fan.right);
    setVector(eye.up, fan.up);
    setVector(eye.ahead, fan.forward);
    setVector(eye.axis, {glm::dot(fan.right, geometry.axis), glm::dot(fan.up, geometry.axis),
                         glm::dot(fan.forward, geometry.axis)});
    eye.start = glm::dot(fan.origin, geometry.axis);
    eye.xMin = fan.xMin;
    eye.yMax = fan.yMax;
    eye.perX = fan.perX;
    eye.perY = fan.perY;
    eye.width = fan.width;
    eye.height = fan.height;
    eye.footprint = static_cast<float>(fan.perX);
    return eye;
}

}  // namespace stereonav
