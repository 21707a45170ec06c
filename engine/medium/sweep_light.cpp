// See the header. Which tiles a slab concerns is found first, by their boxes among the cells.
#include "engine/medium/sweep_light.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr int kSide = LightTile::kSide;
constexpr int kBorder = 16;                       // columns of 1 to both sides of a plane
constexpr std::size_t kMostPacked = 32u << 20;    // bytes that the eyes' light may take
constexpr std::uint32_t kAllLight = 0x7fff7fffu;  // both halves 1
constexpr int kPieces = 16;                       // of a slab's tiles, for threads

std::int32_t strideOf(int width) {
    return (width + kSide - 1) / kSide * kSide + 2 * kBorder;
}

}  // namespace

int SweepLightBuffers::start(SweepLight& light) {
    mAcross = (light.width + kSide - 1) / kSide;
    mDown = (light.height + kSide - 1) / kSide;
    const std::int32_t stride = strideOf(light.width);
    const std::size_t plane = static_cast<std::size_t>(stride) * (light.height + 4);
    mPlanes.assign(7 * plane, 1.0f);
    light.stride = stride;
    light.direct = mPlanes.data() + stride + kBorder;
    // From column -1 to width + 1, row -1 to height + 1.
    light.packedStride = light.width + 4;
    light.packedPlane = static_cast<std::int64_t>(light.packedStride) * (light.height + 3) + 1;
    if (mPackedWidth != light.width || mPackedHeight != light.height) {
        const std::size_t bytes = 2 * sizeof(std::uint32_t) * static_cast<std::size_t>(light.packedPlane);
        mChunk = static_cast<int>(std::clamp<std::size_t>(kMostPacked / bytes, 1, SweepChunk::kMost));
        mPacked.assign(2 * mChunk * static_cast<std::size_t>(light.packedPlane) + kBorder, kAllLight);
        mPackedWidth = light.width;
        mPackedHeight = light.height;
    }
    light.packed = mPacked.data();
    mSwapped = false;
    mTouched = {};
    return mChunk;
}

// Whether a tile, and a texel around it, meets cells that may not be empty.
bool SweepLightBuffers::mayHold(const SweepGeometry& geometry, const SweepSpace& space, int tile,
                                double t) const {
    const RayFan& fan = geometry.light;
    glm::dvec3 low(1e300), high(-1e300);
    for (int n = 0; n < 4; ++n) {
        const double x = (tile % mAcross + (n & 1)) * kSide + (n & 1 ? 1 : -1),
                     y = (tile / mAcross + (n >> 1)) * kSide + (n & 2 ? 1 : -1);
        const glm::dvec3 start = fan.start(x, y), way = fan.direction(x, y);
        const double along = glm::dot(way, geometry.axis);
        if (!(along > kLeastCosine)) return true;
        const glm::dvec3 place = start + (t - glm::dot(start, geometry.axis)) / along * way;
        const glm::dvec3 cell = space.cellFromWorld(geometry.anchor + place);
        low = glm::min(low, cell);
        high = glm::max(high, cell);
    }
    return space.any(low, high);
}

void SweepLightBuffers::chooseTiles(const SweepScene& scene, const SweepGeometry& geometry, double t,
                                    const SweepSpace* space, double reach_texels) {
    Rect spread;
    if (!mTouched.empty() && scene.look.model == 3) {
        const int reach = static_cast<int>(std::min(std::ceil(reach_texels / kSide), 1e6));
        spread = {std::max(mTouched.x0 - reach, 0), std::max(mTouched.y0 - reach, 0),
                  std::min(mTouched.x1 + reach, mAcross), std::min(mTouched.y1 + reach, mDown)};
    }
    mChanged.assign(static_cast<std::size_t>(mAcross) * mDown, 0);
    parallelFor(mDown, [&](int y) {
        for (int x = 0; x < mAcross; ++x) {
            const int tile = y * mAcross + x;
            const bool sample = !space || mayHold(geometry, *space, tile, t);
            mChanged[tile] = sample ? 2 : spread.holds(x, y) ? 1 : 0;
        }
    });
    mTiles.clear();
    for (int tile = 0; tile < mAcross * mDown; ++tile)
        if (mChanged[tile])
            mTiles.push_back({tile % mAcross * kSide, tile / mAcross * kSide, mChanged[tile] == 2});
}

long long SweepLightBuffers::pass(const SweepScene& scene, const SweepGeometry& geometry, int slab,
                                  int inChunk, const SweepSpace* space, const SweepKernels& kernels) {
    const SweepLight& light = scene.light;
    LightPass pass;
    pass.middle = 0.5 * (geometry.faces[slab] + geometry.faces[slab + 1]);
    if (!(pass.middle > geometry.lightStart)) return 0;
    pass.thickness = static_cast<float>(geometry.faces[slab + 1] - geometry.faces[slab]);
    pass.slab = slab;
    pass.inChunk = inChunk;
    const std::size_t plane = static_cast<std::size_t>(light.stride) * (light.height + 4);
    for (int k = 0; k < 3; ++k) {
        float* first = light.direct + (1 + k) * plane;
        float* second = first + 3 * plane;
        pass.before[k] = mSwapped ? second : first;
        pass.after[k] = mSwapped ? first : second;
    }
    // Texels of a lamp differ in size: any may be reached.
    const double offset = std::sqrt(pass.thickness * light.length) * light.blur / light.perX;
    chooseTiles(scene, geometry, pass.middle, space, light.parallel ? std::max(offset, 1.0) + 1 : 1e9);
    const int count = static_cast<int>(mTiles.size()), pieces = std::min(count, kPieces);
    parallelFor(pieces, [&](int piece) {
        for (int n = count * piece / pieces; n < count * (piece + 1) / pieces; ++n)
            mChanged[n] = kernels.lightTile(scene, pass, mTiles[n]);
    });
    for (int n = 0; n < count; ++n) {
        if (!mChanged[n]) continue;
        const int x = mTiles[n].x0 / kSide, y = mTiles[n].y0 / kSide;
        mTouched = {std::min(mTouched.x0, x), std::min(mTouched.y0, y), std::max(mTouched.x1, x + 1),
                    std::max(mTouched.y1, y + 1)};
    }
    mSwapped = !mSwapped;
    return static_cast<long long>(count) * kSide * kSide;
}

std::size_t SweepLightBuffers::heldBytes() const {
    return mPlanes.size() * sizeof(float) + mPacked.size() * sizeof(std::uint32_t);
}

}  // namespace stereonav
