// W12 of docs/ledger.md: depths splatted, every ray cast from there with one jump; for translucent scenes.
#include "engine/stereo/depth_splat.h"
#include "engine/stereo/warp_method.h"

namespace stereonav {
namespace {

// Depths alone are wanted; the colours come along and are cast anew.
void warpRowDepthSplat(const WarpJob& job, ResampleFunction resample, WarpScratch& scratch, int y) {
    ResampleRow row = resampleRowOf(job, scratch, y);
    row.minStretch = 0.0f;  // what is drawn together is known the better
    row.reach = 0;
    row.surface = false;
    resample(row);
    shortenDepths(
        {row.depth, row.holes, row.width, job.setting.depthMargin, job.setting.depthRangeMargin, row.column});
}

}  // namespace

const WarpMethod kMethodDepthSplat{
    .warpRow = warpRowDepthSplat, .after = AfterWarp::CastFromDepths, .opaque = false, .translucent = true};

}  // namespace stereonav
