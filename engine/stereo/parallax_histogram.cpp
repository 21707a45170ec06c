#include "engine/stereo/parallax_histogram.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/simd/kernel_sets.h"

namespace stereonav {

STEREONAV_EACH_SET(void tallyParallax(const float* depths, int width, ParallaxTally& tally);)

namespace {

constexpr int kRowsOfTally = 32;  // rows of a task: some ten microseconds

using DepthKeys = std::array<std::int32_t, ParallaxTally::kClasses + 1>;

double depthOfKey(std::int32_t key) {
    return static_cast<double>(std::bit_cast<float>(key));
}

// The first key at whose depth the parallax is no less than the edge; behind the last where there is none.
// Rounded operations keep the order of what they are given, so that there is one such key.
std::int32_t firstKeyAt(const StereoViews& views, double edge) {
    std::int32_t low = kFirstDepthKey - 1, high = kLastDepthKey + 1;
    while (high - low > 1) {
        const std::int32_t middle = low + (high - low) / 2;
        (parallaxAt(views, depthOfKey(middle)) >= edge ? high : low) = middle;
    }
    return high;
}

DepthKeys keysOf(const StereoViews& views) {
    DepthKeys keys;
    keys.front() = kFirstDepthKey;
    keys.back() = kLastDepthKey + 1;
    for (int n = 0; n <= kParallaxBins; ++n)
        keys[static_cast<std::size_t>(n) + 1] = firstKeyAt(views, ParallaxHistogram::lowerEdge(n));
    return keys;
}

ParallaxTally beginningWith(const DepthKeys& keys, const StereoViews& views) {
    constexpr double kBinsPerShare =
        ParallaxHistogram::kBins / (ParallaxHistogram::kHighest - ParallaxHistogram::kLowest);
    const double perPixel = kBinsPerShare / std::max(views.left.width, 1);
    ParallaxTally tally;
    tally.keys = keys.data();
    tally.offset =
        static_cast<float>(1 - ParallaxHistogram::kLowest * kBinsPerShare + views.shiftAtInfinity * perPixel);
    tally.scale = static_cast<float>(views.parallaxScale * perPixel);
    return tally;
}

void add(const ParallaxTally& tally, ParallaxTally& sum) {
    for (int n = 0; n < ParallaxTally::kClasses; ++n) sum.counts[n] += tally.counts[n];
    sum.unknown += tally.unknown;
    sum.nearest = std::min(sum.nearest, tally.nearest);
    sum.farthest = std::max(sum.farthest, tally.farthest);
}

}  // namespace

std::int64_t ParallaxHistogram::known() const {
    return std::accumulate(counts.begin(), counts.end(), std::int64_t{below} + above);
}

double ParallaxHistogram::shareOf(std::int32_t count) const {
    const std::int64_t all = known();
    return all > 0 ? static_cast<double>(count) / static_cast<double>(all) : 0;
}

ParallaxSeen parallaxSeen(const StereoViews& views, const Plane<float>& viewDepth, SimdTarget target) {
    const DepthKeys keys = keysOf(views);
    const ParallaxTally begun = beginningWith(keys, views);
    const TallyFunction tallyRow =
        kernelsOf<TallyFunction>(target, plain::tallyParallax, avx2::tallyParallax, avx512::tallyParallax);
    const int width = viewDepth.width(), height = viewDepth.height();
    const int tasks = width > 0 ? (height + kRowsOfTally - 1) / kRowsOfTally : 0;
    std::vector<ParallaxTally> tallies(static_cast<std::size_t>(tasks));
    parallelFor(tasks, [&](int task) {
        ParallaxTally tally = begun;
        const int end = std::min(height, (task + 1) * kRowsOfTally);
        for (int y = task * kRowsOfTally; y < end; ++y) tallyRow(viewDepth.row(y), width, tally);
        tallies[static_cast<std::size_t>(task)] = tally;
    });
    ParallaxTally sum;
    for (const ParallaxTally& tally : tallies) add(tally, sum);
    ParallaxSeen seen;
    seen.histogram.below = sum.counts[0];
    std::copy_n(sum.counts + 1, kParallaxBins, seen.histogram.counts.begin());
    seen.histogram.above = sum.counts[ParallaxTally::kClasses - 1];
    seen.histogram.unknown = sum.unknown;
    if (sum.farthest < kFirstDepthKey) return seen;
    seen.nearest = depthOfKey(sum.nearest);
    seen.farthest = depthOfKey(sum.farthest);
    seen.range = {parallaxAt(views, seen.nearest), parallaxAt(views, seen.farthest)};
    return seen;
}

}  // namespace stereonav
