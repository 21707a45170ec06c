// Share of holes and error as Wan et al. 2004 count them (section 5), only over pixels that show the scene.
// Sky, which their pictures do not have, and pixels that a method leaves open do not count as errors of the
// warp.
#pragma once

#include <cstdint>

#include "engine/image/eye_image.h"

namespace stereonav {

struct SurfaceDifference {
    long long surfacePixels = 0;  // pixels that show the scene in the full cast
    long long holePixels = 0;     // compared pixels that were cast again, or left open
    // "The ratio between the number of hole pixels and the warped ones", over pixels that show the scene. NaN
    // where none of them is warped.
    double holesOfWarped_percent = 0;
    // PSNR over the compared pixels that were not left open, over the three channels together; at most
    // kIdenticalPsnr_db. NaN without such pixels.
    double psnr_db = 0;
};

// Compares a right eye with its truth. full: the right eye cast in full; right: a method's picture; holeMask:
// 255 where the method cast again or left a hole (leavesHoles), 0 where it warped. All of one size. Throws
// Error otherwise.
SurfaceDifference surfaceDifference(const EyeImage& full, const EyeImage& right,
                                    const Plane<std::uint8_t>& holeMask, bool leavesHoles);

// Numbers of holes by their position in a row (Table 1 of the paper): right of all warped pixels, left of
// them, or between. Counts only pixels that show the scene; the sum is holePixels of surfaceDifference().
struct GapPixels {
    long long rightEnd = 0, middle = 0, leftEnd = 0;
};
GapPixels gapPixels(const EyeImage& full,
                    const Plane<std::uint8_t>& holeMask);  // throws Error where sizes differ

}  // namespace stereonav
