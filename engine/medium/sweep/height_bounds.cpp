#include "engine/medium/sweep/height_bounds.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace stereonav {
namespace {

constexpr double kSamplesOff = 0.01;      // samples: bound of rounding errors of places in floats
constexpr double kFootprintsOff = 1.001;  // factor
constexpr double kHeightsOff = 2e-6;      // rounding error as a share of the layer's vertical reach

constexpr float kNoHeight = std::numeric_limits<float>::infinity();

}  // namespace

HeightBounds::HeightBounds(const HeightLayer& layer, double displacement)
    : mOrigin(layer.originX, layer.originY),
      mWidth(layer.levels[0].width()),
      mHeight(layer.levels[0].height()),
      mSpacing(layer.spacing),
      mCoarsest(std::ldexp(1.0, static_cast<int>(layer.levels.size()) - 1)),
      mReach(displacement) {
    const double extent = (mWidth + mHeight) * mSpacing + layer.highest - layer.lowest;
    const double off = kHeightsOff * extent + displacement;
    mBelow = layer.below + off;
    mAbove = layer.above + off;
    mLowest = layer.lowest - off;
    mHighest = layer.highest + off;
    const auto blocksOf = [](int width, int height, const auto& rangeAt) {
        Level level{(width + 1) / 2, (height + 1) / 2, {}};
        level.blocks.reserve(static_cast<std::size_t>(level.width) * level.height);
        for (int y = 0; y < height; y += 2)
            for (int x = 0; x < width; x += 2) {
                Range all{kNoHeight, -kNoHeight};
                for (int j = y; j < std::min(y + 2, height); ++j)
                    for (int i = x; i < std::min(x + 2, width); ++i) {
                        const Range r = rangeAt(i, j);
                        all.low = std::min(all.low, r.low);
                        all.high = std::max(all.high, r.high);
                    }
                level.blocks.push_back(all);
            }
        return level;
    };
    const Plane<float>& finest = layer.levels[0];
    mLevels.push_back(blocksOf(mWidth, mHeight, [&](int x, int y) {
        const float h = finest.at(x, y);
        return std::isfinite(h) ? Range{h, h} : Range{kNoHeight, -kNoHeight};
    }));
    while (std::max(mLevels.back().width, mLevels.back().height) > 1) {
        const Level& fine = mLevels.back();
        Level coarse = blocksOf(fine.width, fine.height, [&](int x, int y) {
            return fine.blocks[static_cast<std::size_t>(y) * fine.width + x];
        });
        mLevels.push_back(std::move(coarse));
    }
}

// Samples around a place that count: between the middles of two blocks of a level what is at most one and a
// half blocks away does; at the far edges, where the last samples are in no block, two.
double HeightBounds::marginOf(double footprint) const {
    const double samples = kFootprintsOff * footprint / mSpacing;
    if (samples <= 1) return kSamplesOff;
    if (!(samples < mCoarsest)) return kSamplesOff + 2 * mCoarsest;
    int exponent = 0;
    std::frexp(samples, &exponent);
    return kSamplesOff + 2 * std::min(std::ldexp(1.0, exponent), mCoarsest);
}

bool HeightBounds::meets(const glm::dvec3& low, const glm::dvec3& high, double footprint) const {
    if (high.z < mLowest || low.z > mHighest) return false;
    const double margin = marginOf(footprint) + mReach / mSpacing;
    int first[2], last[2], span = 1;
    const int size[2] = {mWidth, mHeight};
    for (int axis = 0; axis < 2; ++axis) {
        const double from = (low[axis] - mOrigin[axis]) / mSpacing - margin,
                     to = (high[axis] - mOrigin[axis]) / mSpacing + margin;
        const int end = size[axis] - 1;
        if (from > end || to < 0) return false;
        first[axis] = from > 0 ? static_cast<int>(from) : 0;
        last[axis] = to < end ? static_cast<int>(to) + 1 : end;
        span = std::max(span, last[axis] - first[axis]);
    }
    // At most three blocks along each axis.
    const int shift = std::clamp(static_cast<int>(std::bit_width(static_cast<unsigned>(span))) - 1, 1,
                                 static_cast<int>(mLevels.size()));
    const Level& level = mLevels[shift - 1];
    Range all{kNoHeight, -kNoHeight};
    for (int y = first[1] >> shift; y <= last[1] >> shift; ++y)
        for (int x = first[0] >> shift; x <= last[0] >> shift; ++x) {
            const Range& r = level.blocks[static_cast<std::size_t>(y) * level.width + x];
            all.low = std::min(all.low, r.low);
            all.high = std::max(all.high, r.high);
        }
    return all.low <= all.high && !(high.z < all.low - mBelow) && !(low.z > all.high + mAbove);
}

std::size_t HeightBounds::heldBytes() const {
    std::size_t blocks = 0;
    for (const Level& level : mLevels) blocks += level.blocks.size();
    return blocks * sizeof(Range);
}

}  // namespace stereonav
