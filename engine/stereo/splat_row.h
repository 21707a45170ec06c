// The paper's reconstruction of one row (Wan et al. 2004, sections 2.4 to 2.6 and table 1).
#pragma once

#include "engine/stereo/warp_row.h"

namespace stereonav {

constexpr int kSubpixels = 8;                  // subpixels of a pixel
constexpr int kSplatWidth = 2 * kSubpixels;    // subpixels of a splat: two pixels
constexpr float kSplatSigma = 0.5f;            // pixels; the paper gives none: the kernel ends at two sigma
constexpr int kSplatMargin = 2 * kSplatWidth;  // subpixels kept on each side of the scanline

// Returns how many floats of scratch a row takes: four channels (weight, r, g, b) of the supersampled
// scanline.
constexpr int splatScratchSize(int width) {
    return 4 * (width * kSubpixels + 2 * kSplatMargin);
}

// Splats one row, width up to 32768; see SplatRow.
void splatRow(const SplatRow& row);

}  // namespace stereonav
