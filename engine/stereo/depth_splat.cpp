// Three pixels side by side at a time, without branches: the compiler makes vectors of it.
#include "engine/stereo/depth_splat.h"

#include <algorithm>
#include <limits>

namespace stereonav {

void shortenDepths(const DepthSplatRow& row) {
    constexpr float kFar = std::numeric_limits<float>::infinity();
    const int width = row.width;
    const float kept = 1.0f - row.share, range = row.rangeShare;
    float* const own = row.scratch + 1;
    // Beyond the ends nothing is known.
    std::copy_n(row.depth, width, own);
    own[-1] = own[width] = 0.0f;
    float* __restrict const result = row.depth;
    for (int p = 0; p < width; ++p) {
        const float d = own[p], before = own[p - 1], after = own[p + 1];
        const float a = before > 0 ? before : d, b = after > 0 ? after : d;
        const float nearest = std::min(d, std::min(a, b)), farthest = std::max(d, std::max(a, b));
        const float start = nearest * kept - range * (farthest - nearest);
        // Without a neighbour the least is 0, so that an unknown one is told from nothing at all.
        const float nothing = std::min(d, std::min(before, after)) < kFar ? 0.0f : kFar;
        result[p] = farthest < kFar ? std::max(start, 0.0f) : nothing;
    }
    std::uint8_t* __restrict const holes = row.holes;
    for (int p = 0; p < width; ++p) holes[p] = result[p] > 0 ? 0 : 255;
}

}  // namespace stereonav
