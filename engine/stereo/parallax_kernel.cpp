// Depths lie in a picture in patches of one bin: a vector whose lanes are all in the bin of the one before is
// counted whole, by two comparisons. Of the others a class is computed in float, and where it is not the
// right one, by the keys, it is looked for.
#include "engine/simd/simd.h"
#include "engine/stereo/parallax_row.h"

namespace stereonav::STEREONAV_ISA {
namespace {

STEREONAV_INLINE bool isOf(const std::int32_t* keys, std::int32_t key, int found) {
    return key >= keys[found] && key < keys[found + 1];
}

inline int classLookedFor(const std::int32_t* keys, std::int32_t key) {
    int low = 0, high = ParallaxTally::kClasses;  // keys[low] <= key < keys[high]
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        (key >= keys[middle] ? low : high) = middle;
    }
    return low;
}

STEREONAV_INLINE bool isDepth(std::int32_t key) {
    return key >= kFirstDepthKey && key <= kLastDepthKey;
}

STEREONAV_INLINE I likelyClasses(const ParallaxTally& tally, I keys) {
    const F at = F(tally.offset) - F(tally.scale) / asFloat(keys);
    const I number = truncateToInt(clamp(at, F(0.0f), F(ParallaxTally::kClasses - 1.0f)));
    return clamp(number, I(0), I(ParallaxTally::kClasses - 1));  // NaN of eyes without end
}

struct Lanes {
    std::int32_t values[kLanes];
};

STEREONAV_INLINE Lanes lanesOf(I numbers) {
    Lanes lanes;
    store(lanes.values, numbers);
    return lanes;
}

}  // namespace

void tallyParallax(const float* depths, int width, ParallaxTally& tally) {
    const std::int32_t* const keys = tally.keys;
    int here = 0;
    const auto count = [&](std::int32_t key, std::int32_t likely) {
        if (!isDepth(key)) {
            ++tally.unknown;
            return;
        }
        here = isOf(keys, key, likely) ? likely : classLookedFor(keys, key);
        ++tally.counts[here];
    };
    I nearest(tally.nearest), farthest(tally.farthest);
    I from(keys[here]), to(keys[here + 1]);
    int x = 0;
    for (; x + kLanes <= width; x += kLanes) {
        const I key = loadI(depths + x);
        if (all(andNot(key < to, key < from))) {
            tally.counts[here] += kLanes;
            nearest = min(nearest, key);
            farthest = max(farthest, key);
            continue;
        }
        const M known = (key > I(kFirstDepthKey - 1)) & (key < I(kLastDepthKey + 1));
        nearest = min(nearest, select(known, key, nearest));
        farthest = max(farthest, select(known, key, farthest));
        const Lanes lanes = lanesOf(key), likely = lanesOf(likelyClasses(tally, key));
        for (int n = 0; n < kLanes; ++n) count(lanes.values[n], likely.values[n]);
        from = I(keys[here]);
        to = I(keys[here + 1]);
    }
    for (const std::int32_t lane : lanesOf(nearest).values)
        tally.nearest = lane < tally.nearest ? lane : tally.nearest;
    for (const std::int32_t lane : lanesOf(farthest).values)
        tally.farthest = lane > tally.farthest ? lane : tally.farthest;
    for (; x < width; ++x) {
        const std::int32_t key = __builtin_bit_cast(std::int32_t, depths[x]);
        count(key, here);
        if (!isDepth(key)) continue;
        tally.nearest = key < tally.nearest ? key : tally.nearest;
        tally.farthest = key > tally.farthest ? key : tally.farthest;
    }
}

}  // namespace stereonav::STEREONAV_ISA
