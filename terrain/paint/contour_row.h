// A row of an eye's pixels that contour lines are painted on: what the kernels read and write. The formulas
// are those of ContourPainter's plain way, in floats: places are counted from the eye, and heights from the
// nearest wide line, so that what rounding makes of them is a small part of a pixel at any distance.
#pragma once

#include <cstdint>

#include "engine/simd/kernel_sets.h"

namespace stereonav {

// The constants of contour_painter.h.
struct ContourShape {
    float width, indexWidth, share, indexShare;  // pixels; shares of ink, 0 to 1
    float gone, whole;                           // pixels between lines
    float index;                                 // lines from a wide one to the next
    float reach;                                 // pixels from a line within which it may show
    float level;                                 // share of an interval, a pixel: less is level ground
    float ink[3];                                // linear
};

struct ContourRow {
    static constexpr int kPadding = 16;  // values beyond their end that buffers may be read and written

    ContourShape shape{};
    // The eye's row: metres along the view; the rows beside it, null where there is none; PackedColor.
    const float *depth = nullptr, *above = nullptr, *below = nullptr;
    std::uint32_t* color = nullptr;
    int width = 0;
    // Rays, metres at view depth 1: of the first pixel, from one to the next at the right, and to the one
    // above.
    float ray[3] = {}, right[3] = {}, up[3] = {};
    // Ground: samples, metres; the eye's cell and its place in it, and where the ground ends.
    const float* heights = nullptr;
    int groundWidth = 0, groundHeight = 0, cell[2] = {};
    float place[2] = {}, low[2] = {}, high[2] = {};  // cells, from the eye's
    float inverseSpacing[2] = {};                    // 1/metre
    float sameCell = 0;    // spacings: a ray that has to be followed farther at once is not
    double eyeHeight = 0;  // metres
    // Metres of the file from line to line, and how many of them are a metre of the ground; a wide line to
    // the next in metres of the ground, and the eye's height over one, in metres of the file.
    float interval = 0, perMetre = 0;
    double indexStep = 0;
    float eyeOver = 0;
    // Pixels that may have a line, and for each half of the least change of heights beside it (by pixel of
    // the row), the ink's share, and the depth of the ground, below 0 where the ray has to be followed to
    // other cells (GroundView).
    std::int32_t* pixels = nullptr;
    float *least = nullptr, *share = nullptr, *seen = nullptr;  // metres of the file; 0 to 1; metres
};

// Sets pixels and least, and returns how many pixels there are; sets share and seen; paints.
STEREONAV_EACH_SET(int findLinePixels(const ContourRow&); void shareOfLines(const ContourRow&, int pixels);
                   void inkLines(const ContourRow&, int pixels);)

}  // namespace stereonav
