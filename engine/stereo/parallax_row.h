// Counts one row of depths by their parallax: types that the kernels and the histogram share. Few includes,
// since the kernel is compiled once for each instruction set. Depths are compared as integers with the same
// bits (keys), which for numbers above 0 have the same order. That is exact; a parallax computed in float is
// not.
#pragma once

#include <cstdint>

namespace stereonav {

constexpr int kParallaxBins = 64;                                       // ParallaxHistogram's
constexpr std::int32_t kFirstDepthKey = 1, kLastDepthKey = 0x7f800000;  // the smallest above 0; infinity

// Classes of depths, and counts that rows are added to.
struct ParallaxTally {
    // Class n holds the keys from keys[n] up to, but not including, keys[n + 1]. Class 0 is before the first
    // bin, the last class behind the last bin. keys[0] is kFirstDepthKey; the last key is above
    // kLastDepthKey.
    static constexpr int kClasses = kParallaxBins + 2;
    const std::int32_t* keys = nullptr;  // kClasses + 1
    // Constants of a first guess at the class of a depth z in metres, offset - scale / z, which is right for
    // most depths.
    float offset = 0, scale = 0;
    std::int32_t counts[kClasses] = {};
    std::int32_t unknown = 0;                                // holes and NaN: no depth above 0
    std::int32_t nearest = kLastDepthKey + 1, farthest = 0;  // smallest and largest key that was counted
};

// Adds a row of depths, metres, to the tally.
using TallyFunction = void (*)(const float* depths, int width, ParallaxTally& tally);

}  // namespace stereonav
