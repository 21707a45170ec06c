#include "terrain/cast/hole_rays.h"

#include <algorithm>
#include <cmath>

namespace stereonav {
namespace {

// Blocks of 16 x 16 pixels of which at least 3 in 8 are holes are cast as bands: a packet led by its
// neighbours costs far less than one that starts from scattered knowledge.
constexpr int kHoleBlock = 16;
constexpr int kDenseHoles = kHoleBlock * kHoleBlock * 3 / 8;

constexpr int kLookBack = 24;  // steps towards lower rays searched for a known depth
constexpr int kProofs = 3;     // how many of those steps are tried as proof

struct Heading {
    double x, y, slope, run;  // unit horizontal direction, rise over run, horizontal length
};

Heading headingOf(const CasterView& v, const GroundData& ground, double lane, double step) {
    const double x = (v.base[0] + lane * v.perLane[0] + step * v.perStep[0]) * ground.spacingX;
    const double y = (v.base[1] + lane * v.perLane[1] + step * v.perStep[1]) * ground.spacingY;
    const double z = v.base[2] + lane * v.perLane[2] + step * v.perStep[2];
    const double run = std::max(1e-12, std::sqrt(x * x + y * y));
    return {x / run, y / run, z / run, run};
}

float depthInside(const Plane<float>& viewDepth, PixelRect bounds, int x, int y) {
    const bool inside = x >= bounds.x0 && x < bounds.x1 && y >= bounds.y0 && y < bounds.y1;
    return inside ? viewDepth.at(x, y) : -1.0f;
}

// Returns the start of a ray above a lower ray that meets the ground at that view depth; 0 where the ground
// between their directions might rise above the upper ray.
float provenStart(const Heading& ray, const Heading& lower, float depth, const GroundData& ground) {
    const double x = ray.x - lower.x, y = ray.y - lower.y;
    if (!(ray.slope - lower.slope >= ground.maxSlope * std::sqrt(x * x + y * y))) return 0.0f;
    return depth * static_cast<float>(lower.run / ray.run) * kInFront;
}

// Columns in vertical planes: any lower pixel of the column proves the way.
float startInColumn(const CasterView& v, PixelRect bounds, const Plane<float>& viewDepth, PixelIndex p) {
    for (int back = 1; back <= kLookBack; ++back) {
        const float depth = depthInside(viewDepth, bounds, p.x - back * v.stepX, p.y - back * v.stepY);
        if (depth != 0.0f) return std::max(0.0f, depth) * kInFront;
    }
    return 0.0f;
}

// Returns the start of the ray at (lane a, step q) of the view, whole numbers at pixel centres, from the
// depths of pixels towards lower rays; 0: unknown.
float startAbove(const CasterView& v, const GroundData& ground, PixelRect bounds,
                 const Plane<float>& viewDepth, double a, double q) {
    const double lowQ = v.lowQ - q * v.lowW;
    if (!(lowQ < 0)) return 0.0f;
    const double drift = (v.lowA - a * v.lowW) / -lowQ;
    const Heading ray = headingOf(v, ground, a, q);
    int tries = kProofs;
    const int first = static_cast<int>(std::ceil(q)) - 1;  // the next lower row
    for (int step = first; step >= std::max(0, first + 1 - kLookBack) && tries > 0; --step) {
        const double back = q - step, at = a + drift * back, nearest = std::floor(at + 0.5);
        // Too far aside to be proven, most likely.
        if (std::abs(at - nearest) * ground.maxSlope > back) continue;
        const int lane = static_cast<int>(nearest);
        const float depth = depthInside(viewDepth, bounds, v.firstX + lane * v.laneX + step * v.stepX,
                                        v.firstY + lane * v.laneY + step * v.stepY);
        if (depth < 0.0f) return 0.0f;
        if (depth == 0.0f || !std::isfinite(depth)) continue;
        --tries;
        if (const float start = provenStart(ray, headingOf(v, ground, lane, step), depth, ground))
            return start;
    }
    return 0.0f;
}

}  // namespace

float startInFront(const CasterView& v, const GroundData& ground, PixelRect bounds,
                   const Plane<float>& viewDepth, PixelIndex p) {
    // Through a hole in the ground a lower ray goes below it, and says nothing of a higher one.
    if (!v.coherent || !std::isfinite(ground.maxSlope)) return 0.0f;
    if (v.verticalColumns) return startInColumn(v, bounds, viewDepth, p);
    return startAbove(v, ground, bounds, viewDepth, (p.x - v.firstX) * v.laneX + (p.y - v.firstY) * v.laneY,
                      (p.x - v.firstX) * v.stepX + (p.y - v.firstY) * v.stepY);
}

StartBeside::StartBeside(const CasterView& view, const CasterView& known, const GroundData& ground,
                         const Plane<float>& viewDepth)
    : mView(view), mKnown(known), mGround(ground), mDepth(viewDepth) {
    if (!view.coherent || !known.coherent || !std::isfinite(ground.maxSlope)) return;
    // Both views have the same directions across and along where they are turned alike.
    if (view.laneX != known.laneX || view.stepX != known.stepX || view.stepY != known.stepY) return;
    // base - known.base = mLane * perLane + mStep * perStep, by least squares.
    double aa = 0, ab = 0, bb = 0, ad = 0, bd = 0;
    for (int k = 0; k < 3; ++k) {
        const double a = known.perLane[k], b = known.perStep[k], d = view.base[k] - known.base[k];
        aa += a * a, ab += a * b, bb += b * b, ad += a * d, bd += b * d;
    }
    const double det = aa * bb - ab * ab;
    if (!(det > 0)) return;
    mLane = (bb * ad - ab * bd) / det;
    mStep = (aa * bd - ab * ad) / det;
    mAny = std::abs(mLane) < 1 && std::abs(mStep) < 1;
}

float StartBeside::of(PixelIndex p) const {
    if (!mAny) return 0.0f;
    const CasterView& v = mKnown;
    const double a = (p.x - v.firstX) * v.laneX + (p.y - v.firstY) * v.laneY + mLane;
    const double q = (p.x - v.firstX) * v.stepX + (p.y - v.firstY) * v.stepY + mStep;
    return startAbove(v, mGround, {0, 0, mDepth.width(), mDepth.height()}, mDepth, a, q);
}

void HoleSort::sort(const CasterView& view, PixelRect bounds, std::span<const PixelIndex> pixels) {
    mDense.clear();
    mSparse.clear();
    const int across = (bounds.width() + kHoleBlock - 1) / kHoleBlock,
              down = (bounds.height() + kHoleBlock - 1) / kHoleBlock;
    mBlocks.assign(static_cast<std::size_t>(across) * down, 0);
    const auto block = [&](PixelIndex p) -> int& {
        return mBlocks[static_cast<std::size_t>((p.y - bounds.y0) / kHoleBlock) * across +
                       (p.x - bounds.x0) / kHoleBlock];
    };
    // Bands run along columns of the picture; in rolled views, where steps do not, all holes are sparse.
    const bool upright = view.laneX == 1;
    if (upright)
        for (const PixelIndex p : pixels) ++block(p);
    for (int i = 0; i < across && upright; ++i)
        for (int j = 0; j < down; ++j) {
            const auto dense = [&](int row) {
                return mBlocks[static_cast<std::size_t>(row) * across + i] >= kDenseHoles;
            };
            if (!dense(j)) continue;
            int end = j + 1;
            while (end < down && dense(end)) ++end;
            const int x0 = bounds.x0 + i * kHoleBlock, y0 = bounds.y0 + j * kHoleBlock;
            const int x1 = std::min(x0 + kHoleBlock, bounds.x1),
                      y1 = std::min(bounds.y0 + end * kHoleBlock, bounds.y1);
            const int first = view.stepY < 0 ? view.firstY - (y1 - 1) : y0;
            mDense.push_back({double(x0), 0, double(x1), 0, first, first + (y1 - y0), bounds.x0, bounds.x1});
            j = end;
        }
    for (const PixelIndex p : pixels)
        if (!upright || block(p) < kDenseHoles) mSparse.push_back(p);
    const auto step = [&](PixelIndex p) { return p.x * view.stepX + p.y * view.stepY; };
    if (upright) {
        if (view.stepY < 0) std::reverse(mSparse.begin(), mSparse.end());
    } else {
        std::stable_sort(mSparse.begin(), mSparse.end(),
                         [&](PixelIndex p, PixelIndex q) { return step(p) < step(q); });
    }
}

}  // namespace stereonav
