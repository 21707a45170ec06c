#include "engine/late/late_warp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/base/parallel.h"
#include "engine/simd/kernel_sets.h"

namespace stereonav {

STEREONAV_EACH_SET(const LateKernels& lateKernels();)

namespace {

constexpr float kSmooth = 0.3f;   // pixels that neighbours move apart: less is one surface
constexpr float kLittle = 0.5f;   // pixels between the nearest and the farthest: no search is worth it
constexpr float kNothing = 0.1f;  // pixels: as if all were equally far
constexpr float kAhead = 1e-3f;   // along the viewing axis: less is beside what was seen
constexpr int kNarrowings = 3;

const LateKernels& kernelsFor(SimdTarget target) {
    using Get = const LateKernels& (*)();
    return kernelsOf<Get>(target, plain::lateKernels, avx2::lateKernels, avx512::lateKernels)();
}

int tilesFor(int pixels, int tile) {
    return (pixels + tile - 1) / tile;
}

// The mean of what is known in each tile, spread to where nothing is, smoothed, and bilinear between tiles.
void smoothDepths(const Plane<float>& depth, Plane<float>& smooth) {
    constexpr int kSpread = 64, kSmoothings = 2;  // rounds over the tiles
    const int across = tilesFor(depth.width(), kLateTileWidth),
              down = tilesFor(depth.height(), kLateTileHeight);
    Plane<float> mean(across, down), next(across, down);
    for (int ty = 0; ty < down; ++ty)
        for (int tx = 0; tx < across; ++tx) {
            float sum = 0, count = 0;
            for (int y = ty * kLateTileHeight; y < std::min(depth.height(), (ty + 1) * kLateTileHeight); ++y)
                for (int x = tx * kLateTileWidth; x < std::min(depth.width(), (tx + 1) * kLateTileWidth); ++x)
                    if (const float z = depth.at(x, y); z > 0 && std::isfinite(z)) sum += 1 / z, ++count;
            mean.at(tx, ty) = count > 0 ? sum / count : 0;
        }
    // all: known tiles are averaged too.
    const auto average = [&](bool all) {
        bool missing = false;
        for (int y = 0; y < down; ++y)
            for (int x = 0; x < across; ++x) {
                float sum = 0, count = 0;
                for (int v = std::max(y - 1, 0); v <= std::min(y + 1, down - 1); ++v)
                    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, across - 1); ++u)
                        if (mean.at(u, v) > 0) sum += mean.at(u, v), ++count;
                const bool keeps = mean.at(x, y) > 0 && !all;
                next.at(x, y) = keeps ? mean.at(x, y) : count > 0 ? sum / count : 0;
                missing = missing || !(next.at(x, y) > 0);
            }
        std::swap(mean, next);
        return missing;
    };
    for (int n = 0; n < kSpread && average(false); ++n) {
    }
    for (int n = 0; n < kSmoothings; ++n) average(true);
    smooth.resize(depth.width(), depth.height());
    for (int y = 0; y < depth.height(); ++y) {
        const float v = std::clamp((static_cast<float>(y) + 0.5f) / kLateTileHeight - 0.5f, 0.0f,
                                   static_cast<float>(down - 1));
        const int v0 = static_cast<int>(v), v1 = std::min(v0 + 1, down - 1);
        const float lower = v - static_cast<float>(v0);
        for (int x = 0; x < depth.width(); ++x) {
            const float u = std::clamp((static_cast<float>(x) + 0.5f) / kLateTileWidth - 0.5f, 0.0f,
                                       static_cast<float>(across - 1));
            const int u0 = static_cast<int>(u), u1 = std::min(u0 + 1, across - 1);
            const float right = u - static_cast<float>(u0);
            const float up = mean.at(u0, v0) * (1 - right) + mean.at(u1, v0) * right;
            const float low = mean.at(u0, v1) * (1 - right) + mean.at(u1, v1) * right;
            smooth.at(x, y) = 1 / (up * (1 - lower) + low * lower);  // infinite where nothing is at all
        }
    }
}

struct Corner {
    float a = 0, b = 0, du = 0, dv = 0;
};

}  // namespace

LateMove lateMove(const EyeView& from, const EyeView& to) {
    const double pw = from.pixelWidth(), ph = from.pixelHeight();
    // A direction of the world, as columns and rows of the picture times its depth, and its depth.
    const auto seen = [&](const glm::dvec3& direction) {
        const double x = glm::dot(direction, from.right), y = glm::dot(direction, from.up),
                     z = glm::dot(direction, from.forward);
        return glm::dvec3((x - from.xMin * z) / pw, (from.yMax * z - y) / ph, z);
    };
    const glm::dvec3 column = seen(to.right * to.pixelWidth()), row = seen(to.up * -to.pixelHeight());
    const glm::dvec3 corner = seen(to.forward + to.right * to.xMin + to.up * to.yMax);
    const glm::dvec3 shift = seen(to.eye - from.eye);
    LateMove move;
    for (int n = 0; n < 3; ++n) {
        move.rows[n][0] = static_cast<float>(column[n]);
        move.rows[n][1] = static_cast<float>(row[n]);
        move.rows[n][2] = static_cast<float>(corner[n]);
        move.shift[n] = static_cast<float>(shift[n]);
    }
    return move;
}

void LateEye::prepare(const Plane<float>& depth, const EyeView& view, SimdTarget simd, bool soft) {
    mView = view;
    mSimd = simd;
    mInverse.resize(depth.width(), depth.height());
    mAcross = tilesFor(depth.width(), kLateTileWidth);
    mDown = tilesFor(depth.height(), kLateTileHeight);
    mTiles.resize(static_cast<std::size_t>(mAcross) * static_cast<std::size_t>(mDown));
    mReady = !depth.empty();
    if (!mReady) return;
    if (!soft) return measure(depth);
    Plane<float> smooth;
    smoothDepths(depth, smooth);
    measure(smooth);
}

void LateEye::measure(const Plane<float>& depth) {
    const LateKernels& kernels = kernelsFor(mSimd);
    const LateDepths depths{depth.row(0),  depth.stride(), mInverse.row(0), mInverse.stride(),
                            depth.width(), depth.height(), mTiles.data()};
    parallelFor(mDown, [&](int tile) {
        const int end = std::min(depth.height(), (tile + 1) * kLateTileHeight);
        for (int y = tile * kLateTileHeight; y < end; ++y) kernels.invert(depths, y);
    });
    parallelFor(mDown, [&](int tile) { kernels.measure(depths, tile); });
    mFarthest = mTiles.front().farthest;
    mNearest = 0;
    for (const LateTile& tile : mTiles) {
        mFarthest = std::min(mFarthest, tile.farthest);
        mNearest = std::max(mNearest, tile.nearest);
    }
}

const LateTile& LateEye::tileAt(double x, double y) const {
    const auto tile = [](double pixel, int size, int count) {
        return static_cast<int>(std::clamp(pixel / size, 0.0, static_cast<double>(count - 1)));
    };
    return mTiles[static_cast<std::size_t>(tile(y, kLateTileHeight, mDown)) * mAcross +
                  tile(x, kLateTileWidth, mAcross)];
}

LatePlan LateEye::planOf(const LateMove& move, int x0, int y0, int x1, int y1, float nearestSeen) const {
    std::array<Corner, 4> corners;
    float length = 0;
    for (std::size_t n = 0; n < corners.size(); ++n) {
        const auto x = static_cast<float>(n % 2 ? x1 : x0), y = static_cast<float>(n / 2 ? y1 : y0);
        const auto row = [&](int k) { return move.rows[k][0] * x + move.rows[k][1] * y + move.rows[k][2]; };
        if (!(row(2) > kAhead)) return {};
        Corner& corner = corners[n];
        corner.a = row(0) / row(2);
        corner.b = row(1) / row(2);
        corner.du = move.shift[0] - move.shift[2] * corner.a;
        corner.dv = move.shift[1] - move.shift[2] * corner.b;
        length = std::max(length, corner.du * corner.du + corner.dv * corner.dv);
    }
    length = std::sqrt(length);
    LatePlan plan{mFarthest, std::min(mNearest, nearestSeen), 0};
    float jump = 0;
    // The depths in the tile bound the places that it shows, and these places bound the depths: a few rounds
    // narrow both.
    for (int round = 0; round < kNarrowings; ++round) {
        float left = 1e30f, right = -1e30f, top = 1e30f, bottom = -1e30f;
        for (const Corner& corner : corners)
            for (const float inverse : {plan.farthest, plan.nearest}) {
                const float u = corner.a + inverse * corner.du, v = corner.b + inverse * corner.dv;
                left = std::min(left, u), right = std::max(right, u);
                top = std::min(top, v), bottom = std::max(bottom, v);
            }
        const auto tile = [](float pixel, int size, int count) {
            return static_cast<int>(
                std::clamp(pixel / static_cast<float>(size), 0.0f, static_cast<float>(count - 1)));
        };
        const int fromX = tile(left - 1, kLateTileWidth, mAcross),
                  toX = tile(right + 1, kLateTileWidth, mAcross);
        const int fromY = tile(top - 1, kLateTileHeight, mDown),
                  toY = tile(bottom + 1, kLateTileHeight, mDown);
        float farthest = 1e30f, nearest = 0;
        jump = 0;
        for (int y = fromY; y <= toY; ++y)
            for (int x = fromX; x <= toX; ++x) {
                const LateTile& seen = mTiles[static_cast<std::size_t>(y) * mAcross + x];
                farthest = std::min(farthest, seen.farthest);
                nearest = std::max(nearest, seen.nearest);
                jump = std::max(jump, seen.jump);
            }
        nearest = std::min(nearest, nearestSeen);
        const bool narrower = farthest > plan.farthest || nearest < plan.nearest;
        plan.farthest = std::min(farthest, nearest);
        plan.nearest = nearest;
        if (!narrower) break;
    }
    const float way = (plan.nearest - plan.farthest) * length;
    if (way < kNothing) plan.steps = -1;
    if (jump * length < kSmooth || way < kLittle) return plan;
    plan.steps = static_cast<int>(std::clamp(std::ceil(way), 1.0f, static_cast<float>(kMostLateSteps)));
    return plan;
}

void LateEye::planRow(const LateMove& move, const EyeView& to, int tileRow, LatePlan* plans) const {
    // Points nearer than the new view's near plane are not visible any more.
    const double near = to.nearDepth + static_cast<double>(move.shift[2]);
    const float nearestSeen = near > 0 ? static_cast<float>(1 / near) : 1e30f;
    const int across = tilesFor(to.width, kLateTileWidth), top = tileRow * kLateTileHeight;
    for (int tile = 0; tile < across; ++tile)
        plans[tile] =
            planOf(move, tile * kLateTileWidth, top, std::min(to.width, (tile + 1) * kLateTileWidth),
                   std::min(to.height, top + kLateTileHeight), nearestSeen);
}

LateMove LateEye::planAll(const EyeView& to, std::vector<LatePlan>& plans) const {
    const LateMove move = lateMove(mView, to);
    const int across = tilesFor(to.width, kLateTileWidth), down = tilesFor(to.height, kLateTileHeight);
    plans.resize(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
    for (int row = 0; row < down; ++row)
        planRow(move, to, row, plans.data() + static_cast<std::size_t>(row) * across);
    return move;
}

void LateEye::warp(const Plane<PackedColor>& color, const EyeView& to, Plane<PackedColor>& image,
                   Plane<std::uint8_t>* uncovered, bool parallel) const {
    image.resize(to.width, to.height);
    if (uncovered) uncovered->resize(to.width, to.height);
    if (!mReady || image.empty()) return;
    const LateMove move = lateMove(mView, to);
    const LateKernels& kernels = kernelsFor(mSimd);
    const LateSource source{mInverse.width(),  mInverse.height(), mInverse.row(0),
                            mInverse.stride(), color.row(0),      color.stride()};
    const int across = tilesFor(to.width, kLateTileWidth), down = tilesFor(to.height, kLateTileHeight);
    const auto band = [&](int tileRow) {
        const int top = tileRow * kLateTileHeight, rows = std::min(kLateTileHeight, to.height - top);
        std::vector<LatePlan> plans(static_cast<std::size_t>(across));
        planRow(move, to, tileRow, plans.data());
        LateBand all{&source, &move,          plans.data(),   to.width, top,
                     rows,    image.row(top), image.stride(), nullptr,  0};
        if (uncovered) {
            all.uncovered = uncovered->row(top);
            all.uncoveredStride = uncovered->stride();
        }
        kernels.warp(all);
    };
    if (parallel) return parallelFor(down, band);
    for (int tileRow = 0; tileRow < down; ++tileRow) band(tileRow);
}

}  // namespace stereonav
