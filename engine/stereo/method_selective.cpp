// The method linear, but that pixels whose depths shift apart are cast: for translucent scenes.
#include "engine/stereo/warp_method.h"

namespace stereonav {
namespace {

void warpRowSelective(const WarpJob& job, ResampleFunction resample, WarpScratch& scratch, int y) {
    ResampleRow row = resampleRowOf(job, scratch, y);
    if (!job.left.depthSpread.empty()) {
        row.leftSpread = job.left.depthSpread.row(y);
        row.mostSpread = job.setting.mostSpread;
    }
    resample(row);
}

}  // namespace

const WarpMethod kMethodSelective{
    .warpRow = warpRowSelective, .between = true, .opaque = false, .translucent = true};

}  // namespace stereonav
