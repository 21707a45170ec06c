// One row of the warp from the left to the right eye, as plain pointers: what the vector kernels and
// the scalar oracle share. Light on purpose: the kernels are compiled once for each instruction set.
// A left pixel i of view depth z lies at column r = (i + 0.5) + (shift - scale / z) of the right row.
#pragma once

#include <cstdint>

namespace stereonav {

// Elements that scratch rows hold beyond the width: vector code reads and writes whole registers.
constexpr int kRowPadding = 64;

// Inverse one-dimensional resampling. Of the left pixels, those survive that lie strictly left of all
// pixels to their right (Wan et al. 2004, section 2.4); their columns increase. A link joins survivors
// i and i + 1 when they are minStretch to maxStretch right pixels apart. A right pixel is warped when
// its centre falls between the ends of a link whose neighbours within `reach` hold too; else it is a hole.
struct ResampleRow {
    const std::uint32_t* leftColor;
    const float* leftDepth;        // metres > 0; infinity: sky
    std::uint32_t* color;          // 0 in a hole
    float* depth;                  // metres, of the nearer linked pixel (see `surface`); 0 in a hole
    std::uint8_t* holes;           // 255 in a hole, 0 elsewhere
    int width, stride;             // pixels, width >= 1; every row may be read up to the stride (>= 32)
    float shift, scale;            // pixels, pixels * metres
    float minStretch, maxStretch;  // right pixels
    int reach;   // 0: the link alone; 1: and the next to the right; 2: and the one to the left
    bool cubic;  // four taps (Catmull-Rom; needs reach 2), else two

    // Scratch, width + kRowPadding elements each. Afterwards, for a warped right pixel p:
    // s = source[p] is the link's left end, ((p + 0.5) - column[s]) * inverse[s] the place in it.
    float* column;
    float* inverse;
    std::int32_t* source;

    // The colours are normals, to be shaded at the given depths. A link then never joins surface and sky, and
    // depth is interpolated linearly between the two linked pixels. Where their depths differ by a share d of
    // their mean, the result is off from the plane through both by at most d^2 / 4 of the mean.
    bool surface = false;

    // Spread, in metres, of the depths that each left pixel's light comes from; may be null. No link holds
    // where it shifts those depths apart by more than mostSpread right pixels.
    const float* leftSpread = nullptr;
    float mostSpread = 0;
};

// Warps one row.
using ResampleFunction = void (*)(const ResampleRow&);

// Splats of the paper (section 2.5): two pixels wide, eight subpixels a pixel, Gaussian, blended front
// to back along a supersampled scanline; pixels of too little weight are holes. Sky is not reprojected.
struct SplatRow {
    const std::uint32_t* leftColor;
    const float* leftDepth;  // metres, as above
    std::uint32_t* color;
    float* depth;           // metres, the nearest of the splats that reach the pixel; 0 in a hole
    std::uint8_t* holes;    // 255 in a hole, 0 elsewhere
    int width;              // pixels
    float shift, scale;     // pixels, pixels * metres
    float weightThreshold;  // share of full cover

    float* accumulators;   // scratch, splatScratchSize(width)
    std::int32_t* source;  // scratch, width; afterwards the left pixel nearest to a warped pixel
};

// McMillan's forward warp: back to front, each left pixel painted over what lies behind it.
struct PaintRow {
    const std::uint32_t* leftColor;
    const float* leftDepth;
    std::uint32_t* color;
    float* depth;  // members mean what those of SplatRow mean
    std::uint8_t* holes;
    int width;
    float shift, scale;
    std::int32_t* source;  // like SplatRow::source
};

}  // namespace stereonav
