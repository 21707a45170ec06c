// One row of depths, counted by their parallax: what the kernels and the histogram share. Light on purpose:
// the kernel is compiled once for each instruction set. A depth is compared by its bits as an integer, which
// are in the order of the numbers for those above 0; that is exact, where a parallax computed in float is
// not.
#pragma once

#include <cstdint>

namespace stereonav {

constexpr int kParallaxBins = 64;                                       // ParallaxHistogram's
constexpr std::int32_t kFirstDepthKey = 1, kLastDepthKey = 0x7f800000;  // the smallest above 0; infinity

// Classes of depths, and counts that rows are added to.
struct ParallaxTally {
    // Class n holds the keys from keys[n] to before keys[n + 1]: class 0 what lies before the first bin, the
    // last one what lies behind the last bin. keys[0] is kFirstDepthKey, the last one is behind
    // kLastDepthKey.
    static constexpr int kClasses = kParallaxBins + 2;
    const std::int32_t* keys = nullptr;  // kClasses + 1
    // Constants of the class of a depth of z metres, which is about, and for most exactly, offset - scale /
    // z.
    float offset = 0, scale = 0;
    std::int32_t counts[kClasses] = {};
    std::int32_t unknown = 0;                                // no depth above 0: a hole, NaN
    std::int32_t nearest = kLastDepthKey + 1, farthest = 0;  // keys of what was counted
};

// Adds a row of depths, metres, to the tally.
using TallyFunction = void (*)(const float* depths, int width, ParallaxTally& tally);

}  // namespace stereonav
