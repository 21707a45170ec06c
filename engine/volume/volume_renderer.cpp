// Chooses the kernels and hands them rectangles and pixels.
#include "engine/volume/volume_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "engine/base/error.h"
#include "engine/volume/baked_data.h"
#include "engine/volume/highlight_bound.h"
#include "engine/volume/studio_data.h"
#include "engine/volume/transfer_integrals.h"
#include "engine/volume/volume_kernel_types.h"

namespace stereonav {
namespace {

constexpr int kTileWidth = 64, kTileHeight = 32;

const VolumeKernels& kernelsFor(SimdTarget target) {
    return kernelsOf(target, plain::kVolumeKernels, avx2::kVolumeKernels, avx512::kVolumeKernels);
}

void addDenseBricks(const SurfaceCells& cells, CellData& d) {
    const std::size_t first = cells.frame.count() > (1ull << 31) - 64 ? 1ull << 31 : 0;
    const glm::uvec3 size(cells.frame.size);
    d.normals = cells.normals.data();
    d.values = cells.values.data() + first;
    d.firstVoxel = static_cast<std::int32_t>(static_cast<std::uint32_t>(first));
    d.row = cells.frame.size.x;
    d.slice = static_cast<std::int32_t>(size.x * size.y);
}

double smallestSpacing(const VolumeFrame& frame) {
    return std::min({frame.spacing.x, frame.spacing.y, frame.spacing.z});
}

CellData cellDataOf(const SurfaceCells& cells, bool leaping) {
    CellData d;
    const std::size_t count = cells.layout.count(), before = count > (1ull << 31) - 64 ? 1ull << 31 : 0;
    d.firstBrick = -static_cast<std::int32_t>(before >> 12);
    d.codes = cells.codes.data() + before;
    if (!cells.farCodes.empty()) d.farCodes = cells.farCodes.data() + (before >> 6);
    d.places = cells.places.data() + before;
    d.bricks = cells.bricks.data() + (before >> 12);
    d.records = reinterpret_cast<const std::uint32_t*>(cells.records.data());
    d.brickCount[0] = cells.layout.bricks.x;
    d.brickCount[1] = cells.layout.bricks.y;
    if (!cells.normals.empty()) addDenseBricks(cells, d);
    for (int k = 0; k < 3; ++k) d.last[k] = cells.frame.size[k] - 2;
    // Rounded down a little: leaps are measured in float.
    d.leapUnit = static_cast<float>(cells.leapUnit * (1 - 1e-5));
    d.isovalue = cells.isovalue;
    d.leaping = leaping;
    const glm::dvec3 per = smallestSpacing(cells.frame) / cells.frame.spacing;
    for (int k = 0; k < 3; ++k) {
        d.downX[k] = static_cast<float>(-cells.frame.axes[0][k] * per.x);
        d.downY[k] = static_cast<float>(-cells.frame.axes[1][k] * per.y);
        d.downZ[k] = static_cast<float>(-cells.frame.axes[2][k] * per.z);
    }
    return d;
}

// what: names it where it does not fit.
ByteData byteDataOf(const Volume<std::uint8_t>& bytes, const VolumeFrame& frame, const char* what) {
    const glm::ivec3 size = frame.size, has = bytes.frame.size;
    if (has != size || frame.count() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw Error("", what,
                    fmt::format("expected {}x{}x{} voxels, as the volume has, less than 2^31 of them, got "
                                "{}x{}x{}",
                                size.x, size.y, size.z, has.x, has.y, has.z),
                    "compute it from the same volume, or leave it out");
    return {bytes.values.data(), size.x, size.x * size.y, {size.x - 1, size.y - 1, size.z - 1}};
}

OcclusionData occlusionDataOf(const VolumeLook& look, const VolumeFrame& frame) {
    if (!look.showsOpenness()) return {};
    const AmbientLook& ambient = look.occlusion;
    return {byteDataOf(*ambient.openness, frame, "ambient occlusion"), ambient.strength / 255,
            ambient.lampShare};
}

LightData lightDataOf(const VolumeLook& look, const VolumeFrame& frame) {
    LightData d;
    for (int k = 0; k < 3; ++k) {
        d.albedo[k] = look.surface[k];
        d.background[k] = look.background[k];
    }
    d.ambient = look.showsOpenness() || look.showsStudio() ? 0 : look.ambient;
    d.diffuse = look.diffuse;
    d.specular = look.specular;
    d.shininess = look.shininess;
    // less for what the kernels' square roots are off
    d.faintCosine = static_cast<float>(0.998 * faintHighlightCosine(look));
    const float half = 0.5f * look.shininess;
    d.wholeHalf = half >= 1 && half <= 1024 && half == std::floor(half) ? static_cast<int>(half) : 0;
    d.shadows = look.shadows && look.lampAt;
    d.largestSpacing = static_cast<float>(std::max({frame.spacing.x, frame.spacing.y, frame.spacing.z}));
    d.varyingAmbient = look.varyingAmbient;
    d.inverseFog = look.fog > 0 ? std::min(1 / look.fog, std::numeric_limits<float>::max()) : 0.0f;
    if (look.falloff > 0) d.inverseFalloffSquared = std::min(1 / (look.falloff * look.falloff), kMostFalloff);
    return d;
}

int tilesAcross(const EyeView& view) {
    return (view.width + kTileWidth - 1) / kTileWidth;
}

VolumeRect tileRect(const EyeView& view, int tile) {
    const int x0 = tile % tilesAcross(view) * kTileWidth, y0 = tile / tilesAcross(view) * kTileHeight;
    return {x0, y0, std::min(x0 + kTileWidth, view.width), std::min(y0 + kTileHeight, view.height)};
}

VolumeTarget targetOf(EyeImage& image) {
    return {image.color.row(0),
            image.viewDepth.row(0),
            image.normal.empty() ? nullptr : image.normal.row(0),
            image.depthSpread.empty() ? nullptr : image.depthSpread.row(0),
            image.color.stride(),
            image.viewDepth.stride(),
            image.normal.stride()};
}

void setLamp(VolumeView& v, const glm::dvec3& world, const VolumeFrame& frame) {
    const glm::dvec3 lamp = frame.voxelFromWorld(world);
    const glm::dvec3 cell = glm::clamp(glm::floor(lamp), glm::dvec3(-1e6), glm::dvec3(1e6));
    v.lampInside = true;
    for (int k = 0; k < 3; ++k) {
        v.lampBase[k] = static_cast<std::int32_t>(cell[k]);
        v.lampEye[k] = static_cast<float>(lamp[k] - cell[k]);
        v.lampInside = v.lampInside && lamp[k] >= 0 && lamp[k] <= frame.size[k] - 1;
    }
}

VolumeView makeVolumeView(const EyeView& view, const VolumeScene& scene) {
    const VolumeFrame& frame = scene.cells.frame;
    VolumeView v;
    const glm::dvec3 eye = frame.voxelFromWorld(view.eye);
    const glm::dvec3 cell = glm::clamp(glm::floor(eye), glm::dvec3(-1e6), glm::dvec3(1e6));
    const glm::dvec3 corner = frame.voxelDirection(view.rayDirection(0.5, 0.5));
    const glm::dvec3 across = frame.voxelDirection(view.right * view.pixelWidth());
    const glm::dvec3 down = frame.voxelDirection(-view.up * view.pixelHeight());
    const glm::dvec3 head = scene.look.lampAt.value_or(view.head) - view.eye;
    if (scene.look.lampAt) setLamp(v, *scene.look.lampAt, frame);
    v.inside = true;
    for (int k = 0; k < 3; ++k) {
        v.base[k] = static_cast<std::int32_t>(cell[k]);
        v.eye[k] = static_cast<float>(eye[k] - cell[k]);
        v.direction[k] = corner[k];
        v.perX[k] = across[k];
        v.perY[k] = down[k];
        v.forward[k] = static_cast<float>(view.forward[k]);
        v.right[k] = static_cast<float>(view.right[k]);
        v.up[k] = static_cast<float>(view.up[k]);
        v.head[k] = static_cast<float>(head[k]);
        v.inside = v.inside && eye[k] >= 0 && eye[k] <= frame.size[k] - 1;
    }
    v.lampAway = static_cast<float>(glm::length(head));
    v.xMin = static_cast<float>(view.xMin);
    v.yMax = static_cast<float>(view.yMax);
    v.pixelWidth = static_cast<float>(view.pixelWidth());
    v.pixelHeight = static_cast<float>(view.pixelHeight());
    v.nearDepth = static_cast<float>(view.nearDepth);
    return v;
}

// The function sampled for the kernels.
struct TransferTable {
    std::vector<float> extinction;
    std::vector<std::uint32_t> color;
    TransferData data;

    TransferTable(const TransferFunction& function, const GreyVolume& field, double step) {
        if (function.empty()) return;
        const auto& points = function.points();
        // Beyond its ends the function is constant.
        const double first = points.front().value, last = std::max(points.back().value, first + 1e-3);
        const double scale = TransferData::kEntries / (last - first);
        for (int k = 0; k <= TransferData::kEntries + 1; ++k) {
            const double value = first + k / scale;
            extinction.push_back(static_cast<float>(function.extinction(value)));
            color.push_back(packColor(function.at(value + 0.5 / scale).color));
        }
        // The kernels meet stored numbers.
        data.first = static_cast<float>((first - field.offset) / field.scale);
        data.scale = static_cast<float>(scale * field.scale);
        data.step = static_cast<float>(step);
        data.extinction = extinction.data();
        data.color = color.data();
    }
};

}  // namespace

struct VolumeRenderer::State {
    SimdTarget target;
    const VolumeKernels* kernels;
    bool shadeAgain;
    TransferTable transfer;
    std::optional<TransferIntegrals> integrals;
    VolumeData data;

    State(const VolumeScene& scene, const VolumeCasting& casting)
        : target(availableTarget(casting.target)),
          kernels(&kernelsFor(target)),
          shadeAgain(casting.shadeAgain),
          transfer(scene.look.transfer, scene.field, casting.stepVoxels * smallestSpacing(scene.cells.frame)),
          data{cellDataOf(scene.cells, casting.leaping),
               lightDataOf(scene.look, scene.cells.frame),
               bakedDataOf(scene.look.baked, scene.cells.frame),
               occlusionDataOf(scene.look, scene.cells.frame),
               studioDataOf(scene.look, scene.cells.frame),
               transfer.data} {
        if (scene.look.transfer.empty()) {
            data.light.leastCosine4 = std::pow(casting.leastCosine, 4.0f);
            return;
        }
        if (casting.integrated)
            data.transfer.integrals =
                &integrals.emplace(scene.look.transfer, scene.field, scene.cells.isovalue).data();
        if (!scene.look.modulation) return;
        data.transfer.modulation =
            byteDataOf(*scene.look.modulation, scene.cells.frame, "opacity modulation");
    }

    // Leap code of the cell around a world point, in metres; negative outside the volume.
    static double freeAt(const SurfaceCells& cells, const glm::dvec3& world) {
        const glm::dvec3 voxel = cells.frame.voxelFromWorld(world);
        const glm::ivec3 cell(glm::floor(voxel));
        for (int k = 0; k < 3; ++k)
            if (cell[k] < 0 || cell[k] > cells.frame.size[k] - 2) {  // outside: as far as the volume's box
                const glm::dvec3 last(cells.frame.size - 1);
                const glm::dvec3 beside = voxel - glm::clamp(voxel, glm::dvec3(0.0), last);
                return glm::length(beside * cells.frame.spacing);
            }
        return (cells.code(cell) - 1) * cells.leapUnit;
    }
};

VolumeRenderer::VolumeRenderer(const VolumeScene& scene, const VolumeCasting& casting)
    : mScene(scene), mState(std::make_unique<State>(scene, casting)) {}
VolumeRenderer::~VolumeRenderer() = default;

int VolumeRenderer::tileCount(const EyeView& view) const {
    return tilesAcross(view) * ((view.height + kTileHeight - 1) / kTileHeight);
}

void VolumeRenderer::renderTile(const EyeView& view, int tile, EyeImage& image) const {
    mState->kernels->castRect(mState->data, makeVolumeView(view, mScene), tileRect(view, tile),
                              targetOf(image), false);
    const VolumeRect rect = tileRect(view, tile);
    lookUpAgain(view, {rect.x0, rect.y0, rect.x1, rect.y1}, image);
}

void VolumeRenderer::renderTileFromDepth(const EyeView& view, int tile, EyeImage& image) const {
    mState->kernels->castRect(mState->data, makeVolumeView(view, mScene), tileRect(view, tile),
                              targetOf(image), true);
}

// Lookups that the kernels do not have, which are there to be compared: one pixel at a time.
void VolumeRenderer::lookUpAgain(const EyeView& view, PixelRect rect, EyeImage& image) const {
    using Lookup = IlluminationVolume::Lookup;
    const BakedLook& baked = mScene.look.baked;
    if (!mState->data.baked.texels || baked.lookup == Lookup::Trilinear || translucent()) return;
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x) {
            const double depth = image.viewDepth.at(x, y);
            if (!(depth < kMissDepth)) continue;
            const glm::dvec3 world = view.eye + depth * view.rayDirection(x + 0.5, y + 0.5);
            const IlluminationVolume::Light light =
                bakedLightAt(baked, world, &mScene.field, mScene.cells.isovalue);
            if (light.weight > 0)
                image.color.at(x, y) = packColor(mScene.look.surface * light.value * baked.exposure);
        }
}

// Lists go row by row through a band of columns; packets of pixels from a narrower band are closer to each
// other, and so are their rays.
void VolumeRenderer::renderPixels(const EyeView& view, PixelRect bounds, std::span<const PixelIndex> pixels,
                                  EyeImage& image) const {
    constexpr int kNarrow = 8, kMost = 1024;
    const VolumeView volumeView = makeVolumeView(view, mScene);
    const VolumeTarget target = targetOf(image);
    VolumePixel sorted[kMost];
    for (std::size_t first = 0; first < pixels.size(); first += kMost) {
        const auto some = pixels.subspan(first, std::min<std::size_t>(kMost, pixels.size() - first));
        int count = 0;
        for (int x0 = bounds.x0; x0 < bounds.x1; x0 += kNarrow)
            for (const PixelIndex p : some)
                if (p.x >= x0 && p.x < x0 + kNarrow) sorted[count++] = {p.x, p.y};
        mState->kernels->castPixels(mState->data, volumeView, sorted, count, target);
        for (int n = 0; n < count; ++n)
            lookUpAgain(view, {sorted[n].x, sorted[n].y, sorted[n].x + 1, sorted[n].y + 1}, image);
    }
}

bool VolumeRenderer::mayHitBeyondEdge(const EyeView& view, PixelRect rect, double column,
                                      double parallaxScale) const {
    double freeDepth = 0;
    return mayHitBeyondEdgeFrom(view, rect, column, parallaxScale, freeDepth);
}

// A beam around the rectangle, as the kernels' beams. Up to where it ends the beams of the rectangle's parts
// are free as well.
bool VolumeRenderer::mayHitBeyondEdgeFrom(const EyeView& view, PixelRect rect, double column,
                                          double parallaxScale, double& freeDepth) const {
    const double beyond = column - rect.x1;
    const double end = beyond > 0 ? parallaxScale / beyond : std::numeric_limits<double>::infinity();
    const glm::dvec3 axis = view.rayDirection(0.5 * (rect.x0 + rect.x1), 0.5 * (rect.y0 + rect.y1));
    const double radius =
        0.5 * std::hypot(rect.width() * view.pixelWidth(), rect.height() * view.pixelHeight());
    const double length = glm::length(axis);
    const SurfaceCells& cells = mScene.cells;
    // Behind the whole volume nothing is hit; distances along rays are not below their view depths.
    const glm::dvec3 half = 0.5 * glm::dvec3(cells.frame.size - 1);
    const double farthest =
        glm::length(view.eye - cells.frame.worldFromVoxel(half)) + glm::length(half * cells.frame.spacing);
    double& t = freeDepth;
    t = std::max(t, view.nearDepth);
    while (t < std::min(end, farthest)) {
        const double free = State::freeAt(cells, view.eye + t * axis);
        if (free < 0) return true;
        const double ahead = (free - radius * t) / (length + radius) * (1 - 1e-9);
        if (!(ahead * length > cells.leapUnit) || !(t + ahead > t)) return true;
        t += ahead;
    }
    return false;
}

ViewDependence VolumeRenderer::viewDependence() const {
    if (translucent()) return ViewDependence::Depths;
    const VolumeLook& look = mScene.look;
    // Baked light does not move with the eyes, but has grain of a texel's size that warped colours blur:
    // looked up again it is as near to a full cast as light of the lamp is. What lies in shadow is not kept,
    // and rows know the trilinear lookup alone.
    const bool baked = mState->data.baked.texels != nullptr;
    if (baked && look.baked.lookup != IlluminationVolume::Lookup::Trilinear) return ViewDependence::None;
    const bool changes = look.specular > 0 || baked || look.showsOpenness() || look.showsStudio();
    return mState->shadeAgain && changes && !look.shadows ? ViewDependence::Normal : ViewDependence::None;
}

void VolumeRenderer::shadeAgain(const EyeView& view, int y, int x0, int x1, EyeImage& image) const {
    mState->kernels->shadeRow(mState->data, makeVolumeView(view, mScene), y, x0, x1, targetOf(image));
}

bool VolumeRenderer::translucent() const {
    return !mScene.look.transfer.empty();
}

SimdTarget VolumeRenderer::target() const {
    return mState->target;
}

}  // namespace stereonav
