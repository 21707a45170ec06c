// Inverse resampling between neighbouring survivors, four taps (Catmull-Rom).
#include "engine/stereo/warp_method.h"

namespace stereonav {
namespace {

void warpRowCubic(const WarpJob& job, ResampleFunction resample, WarpScratch& scratch, int y) {
    ResampleRow row = resampleRowOf(job, scratch, y);
    row.cubic = true;
    row.reach = 2;  // four taps must not cross a silhouette
    resample(row);
}

}  // namespace

const WarpMethod kMethodCubic{.warpRow = warpRowCubic, .between = true};

}  // namespace stereonav
