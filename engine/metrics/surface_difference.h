// Hole share and error as Wan et al. 2004 count them (section 5): of pixels that show the scene alone.
// Neither sky, which their picture has none of to warp, nor what a method leaves open is an error of the
// warp.
#pragma once

#include <cstdint>

#include "engine/image/eye_image.h"

namespace stereonav {

struct SurfaceDifference {
    long long surfacePixels = 0;  // pixels that show the scene in the full cast
    long long holePixels = 0;     // compared pixels that were cast again, or left open
    // "The ratio between the number of hole pixels and the warped ones", of pixels that show the scene.
    // NaN where none of them is warped.
    double holesOfWarped_percent = 0;
    // The PSNR over those that were not left open, the three channels together; kIdenticalPsnr_db at most.
    // NaN where there is none.
    double psnr_db = 0;
};

// Compares a right eye with its truth. full: the right eye cast in full; right: what a method made; holeMask:
// 255 where it cast again, or left open (leavesHoles), 0 where it warped. All of one size. Throws Error
// otherwise.
SurfaceDifference surfaceDifference(const EyeImage& full, const EyeImage& right,
                                    const Plane<std::uint8_t>& holeMask, bool leavesHoles);

// Counts of holes by where they lie in a row (Table 1 of the paper): right of all that was warped, left of
// it, or between. Only pixels that show the scene; the sum is holePixels of surfaceDifference.
struct GapPixels {
    long long rightEnd = 0, middle = 0, leftEnd = 0;
};
GapPixels gapPixels(const EyeImage& full,
                    const Plane<std::uint8_t>& holeMask);  // throws Error where sizes differ

}  // namespace stereonav
