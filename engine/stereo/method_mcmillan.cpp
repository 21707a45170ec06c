// W14 of docs/ledger.md: back-to-front forward warp without holes filled or clipping fixed.
#include "engine/stereo/paint_row.h"
#include "engine/stereo/warp_method.h"

namespace stereonav {
namespace {

void warpRowMcMillan(const WarpJob& job, ResampleFunction, WarpScratch& scratch, int y) {
    paintRow({job.from().row(y), job.left.viewDepth.row(y), job.to().row(y), job.right.viewDepth.row(y),
              job.mask.row(y), job.width(), job.shift(), job.scale(), scratch.source.data()});
}

}  // namespace

const WarpMethod kMethodMcMillan{.warpRow = warpRowMcMillan, .after = AfterWarp::Leave, .marksBorder = false};

}  // namespace stereonav
