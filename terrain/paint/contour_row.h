// A row of an eye's pixels for contour lines: data that the kernels read and write. The formulas are those of
// ContourPainter's plain version, in floats: places are relative to the eye, and heights to the nearest wide
// line, so that rounding errors are a small part of a pixel at any distance.
#pragma once

#include <cstdint>

#include "engine/simd/kernel_sets.h"

namespace stereonav {

// The constants of contour_painter.h.
struct ContourShape {
    float width, indexWidth, share, indexShare;  // pixels; shares of ink, 0 to 1
    // Distance of lines in pixels at which they have faded out; at which they are whole.
    float gone, whole;
    float index;  // lines from a wide one to the next
    float reach;  // pixels from a line within which it may show
    // Level ground: largest change of height per pixel, as a share of an interval.
    float level;
    float ink[3];  // linear
};

struct ContourRow {
    // Values beyond their end up to which buffers may be read and written.
    static constexpr int kPadding = 16;

    ContourShape shape{};
    // The eye's row of view depths, metres; the rows beside it, null where there is none; PackedColor.
    const float *depth = nullptr, *above = nullptr, *below = nullptr;
    std::uint32_t* color = nullptr;
    int width = 0;
    // Rays in metres at view depth 1: of the first pixel; the step to the next on the right; the step to the
    // one above.
    float ray[3] = {}, right[3] = {}, up[3] = {};
    // Ground: samples, metres; the eye's cell and the eye's place in it; the ground's borders.
    const float* heights = nullptr;
    int groundWidth = 0, groundHeight = 0, cell[2] = {};
    float place[2] = {}, low[2] = {}, high[2] = {};  // cells, from the eye's
    float inverseSpacing[2] = {};                    // 1/metre
    // Spacings: largest first step with which a ray stays in its cell; rays with a larger one are followed.
    float sameCell = 0;
    double eyeHeight = 0;  // metres
    // Metres of the file between two lines; metres of the file per metre of the ground; metres of the ground
    // between two wide lines; height of the eye above a wide line, metres of the file.
    float interval = 0, perMetre = 0;
    double indexStep = 0;
    float eyeOver = 0;
    // Pixels that may have a line, and for each: half of the least change of height beside it (stored by
    // pixel of the row), the share of ink, and the depth of the ground, below 0 where the ray has to be
    // followed to other cells (GroundView).
    std::int32_t* pixels = nullptr;
    float *least = nullptr, *share = nullptr, *seen = nullptr;  // metres of the file; 0 to 1; metres
};

// Sets pixels and least, and returns how many pixels there are; sets share and seen; paints.
STEREONAV_EACH_SET(int findLinePixels(const ContourRow&); void shareOfLines(const ContourRow&, int pixels);
                   void inkLines(const ContourRow&, int pixels);)

}  // namespace stereonav
