// Colours as videos have them: luma and two differences of colour, of which each 2 x 2 pixels share one pair.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

enum class YuvRule {
    Bt709,  // ITU-R BT.709: 16 to 235, 16 to 240; a pair lies on the left column, between the rows (H.264)
    Jfif,   // ITU-T T.871: BT.601's weights, 0 to 255; a pair lies in the middle of its four pixels (JPEG)
};

// The planes' first bytes, row 0 at the top.
struct YuvPlanes {
    std::uint8_t *y, *u, *v;
    std::ptrdiff_t yStride, uStride, vStride;  // bytes from row to row
};

// Fills the planes, y with the size rounded up to even ones and u, v with half of that: the last column or
// row is repeated where it is odd. Rounded to nearest, the pair from the mean of its pixels' encoded colours.
void yuvFromPlane(const Plane<PackedColor>& picture, YuvRule rule, const YuvPlanes& to);

// Writes four bytes a pixel: blue, green, red, 255; where width x height is larger than the picture, its last
// column or row again. stride: bytes from row to row.
void bgr0FromPlane(const Plane<PackedColor>& picture, std::uint8_t* to, std::ptrdiff_t stride, int width,
                   int height);

}  // namespace stereonav
