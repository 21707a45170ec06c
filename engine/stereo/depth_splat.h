// Where the right eye's rays may start in translucent scenes (W12 of docs/ledger.md; Wan et al. 2004, section
// 4). The paper splats each left depth over two right pixels and keeps the nearest. Here the hidden-pixel
// rule and the columns are those of the inverse warp (ResampleRow): a right pixel gathers the two survivors
// it lies between, and the pixels beside it, which cover as much; a pixel between survivors that were
// stretched apart or folded stays unknown.
#pragma once

#include <cstdint>

namespace stereonav {

// One row of gathered depths, which is shortened in place.
struct DepthSplatRow {
    float* depth;         // metres; in: the nearer of two survivors, 0 unknown; out: where a ray may start
    std::uint8_t* holes;  // out: 255 where nothing is known
    int width;            // pixels
    float share;          // share by which depths are shortened
    float rangeShare;     // share of the difference to the two pixels beside it that is taken off
    float* scratch;       // width + 2 numbers
};

// Infinite depth (nothing at all) stays only between pixels that are infinite too. Else a pixel beside
// nothing is unknown: the edge may be anywhere between them.
void shortenDepths(const DepthSplatRow& row);

}  // namespace stereonav
