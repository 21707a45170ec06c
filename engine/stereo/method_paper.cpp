// W5 to W9 of docs/ledger.md: splats of eight subpixels, weight threshold, holes cast.
#include "engine/stereo/splat_row.h"
#include "engine/stereo/warp_method.h"

namespace stereonav {
namespace {

void warpRowPaper(const WarpJob& job, ResampleFunction, WarpScratch& scratch, int y) {
    splatRow({job.from().row(y), job.left.viewDepth.row(y), job.to().row(y), job.right.viewDepth.row(y),
              job.mask.row(y), job.width(), job.shift(), job.scale(), job.setting.weightThreshold,
              scratch.accumulators.data(), scratch.source.data()});
}

}  // namespace

const WarpMethod kMethodPaper{.warpRow = warpRowPaper, .splats = true};

}  // namespace stereonav
