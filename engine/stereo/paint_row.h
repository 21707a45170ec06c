// McMillan's warp of one row (1997; compared in Wan et al. 2004, section 6): occlusion-compatible
// order instead of a depth buffer, oversized opaque splats, nothing cast.
#pragma once

#include "engine/stereo/warp_row.h"

namespace stereonav {

constexpr float kPaintWidth = 1.5f;  // pixels of a splat: "slightly oversized"

// Paints one row of the right eye; every pixel of it is written.
void paintRow(const PaintRow& row);

}  // namespace stereonav
