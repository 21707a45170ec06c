// Which pixels of a row one ray does not stand for. One row as plain pointers, since the kernel is compiled
// once for each instruction set.
#pragma once

#include <cstdint>

#include "engine/simd/simd_target.h"

namespace stereonav {

// A row with those above and below it; at the picture's border null.
struct EdgeRow {
    const std::uint32_t *above, *row, *below;  // packed colours
    const float *depthAbove, *depth,
        *depthBelow;      // view depths, metres: infinite where nothing was hit, 0 where it is not known
    std::uint8_t* edges;  // out: 255 or 0 for each pixel; 0 where its depth is not known
    int width;            // >= 1
    // A pixel is an edge where a channel (of 1023) differs from one of its four known neighbours by contrast
    // or more and 1 / depth is bent there, between two known neighbours, by more than depthBreak of its
    // largest value; or by jumpContrast or more where it is bent by more than depthJump of it; or by
    // strongContrast or more, whatever the depths. On a plane 1 / depth is linear over the picture, however
    // steeply one looks at it.
    std::int32_t contrast, jumpContrast, strongContrast;  // 1 to 1023
    float depthBreak, depthJump;                          // shares, 0 to 1
};

using EdgeFunction = void (*)(const EdgeRow& row);
// The function of the set that availableTarget() gives.
EdgeFunction edgeFinder(SimdTarget target = SimdTarget::Auto);

}  // namespace stereonav
