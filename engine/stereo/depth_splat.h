// Depths from which the right eye's rays may start in translucent scenes (W12 of docs/ledger.md; Wan et al.
// 2004, section 4). The paper splats each left depth over two right pixels and keeps the nearest. Here hidden
// pixels and columns are found as in the inverse warp (ResampleRow): a right pixel gathers the depths of the
// two surviving left pixels that it lies between, and those of the pixels beside it, which covers as much. A
// pixel between survivors that were stretched apart or folded stays unknown.
#pragma once

#include <cstdint>

namespace stereonav {

// One row of gathered depths, which is shortened in place.
struct DepthSplatRow {
    float* depth;  // metres; in: the nearer of two survivors, 0: unknown; out: depth where a ray may start
    std::uint8_t* holes;  // out: 255 where the depth is unknown
    int width;            // pixels
    float share;          // share of itself by which a depth is shortened
    float rangeShare;  // share of its difference to the two neighbouring pixels by which a depth is shortened
    float* scratch;    // width + 2 numbers
};

// Shortens a row's depths. An infinite depth (nothing hit) stays only between pixels that are infinite too.
// Any other pixel beside an infinite one becomes unknown, since the edge may lie anywhere between them.
void shortenDepths(const DepthSplatRow& row);

}  // namespace stereonav
