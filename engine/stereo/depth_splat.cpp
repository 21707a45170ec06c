// Three pixels side by side at a time, without branches: the compiler makes vectors of it.
#include "engine/stereo/depth_splat.h"

#include <algorithm>
#include <limits>

namespace stereonav {

void shortenDepths(const DepthSplatRow& row) {
    constexpr float kFar = std::numeric_limits<float>::infinity();
    // Beyond the ends nothing is known.
    float* const own = row.scratch + 1;
    std::copy_n(row.depth, row.width, own);
    own[-1] = own[row.width] = 0.0f;
    const float kept = 1.0f - row.share;
    for (int p = 0; p < row.width; ++p) {
        const float d = own[p], before = own[p - 1], after = own[p + 1];
        const float a = before > 0 ? before : d, b = after > 0 ? after : d;
        const float nearest = std::min(d, std::min(a, b)), farthest = std::max(d, std::max(a, b));
        const float start = nearest * kept - row.rangeShare * (farthest - nearest);
        const bool surrounded = before == kFar && after == kFar && d == kFar;
        const bool known = farthest < kFar && start > 0;
        const float result = known ? start : surrounded ? kFar : 0.0f;
        row.depth[p] = result;
        row.holes[p] = result > 0 ? 0 : 255;
    }
}

}  // namespace stereonav
