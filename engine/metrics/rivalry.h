// Rivalry: what the two eyes show differently where they ought to agree. Both see most of a scene, each point
// at a place of its own; what they show there may differ as the truths of both eyes differ (a highlight, air)
// and no further. An error that both eyes share, as of a warped pixel that was copied with what is wrong in
// it, is no rivalry; one eye's alone is, as of pixels cast anew beside warped ones. It is counted, not
// modelled as eyes do it: nothing is suppressed or filtered.
#pragma once

#include <cstdint>

#include "engine/camera/stereo_rig.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

struct TwoEyes {
    const Plane<PackedColor>&left, &right;
};

// Returns where the right eye sees what the centre of each pixel of the left eye sees: the column of a pixel
// in the same row, 0 for the first pixel's centre; -1 where it does not see it. depths: the view depths of
// both eyes, each cast by itself, metres. Seen are pixels whose two neighbours in the right eye lie within a
// pixel of parallax of the left one's depth. Throws Error where sizes differ.
Plane<float> columnsInRightEye(const StereoViews& views, const Plane<float>& leftDepth,
                               const Plane<float>& rightDepth);

struct Rivalry {
    // The PSNR of (right - left) - (true right - true left) in sRGB levels over pixels that both eyes see,
    // the right eye's interpolated between two pixels; kIdenticalPsnr_db (image_difference.h) at most, NaN
    // where both see nothing.
    double psnr_db = 0;
    double edge_psnr_db = 0;  // psnr_db over those pixels alone that have one of the mask in the right eye
    double seen_percent = 0;  // pixels that both eyes see, of the left eye's
};

// Compares the pairs. columns: by columnsInRightEye; rightMask: holes and edges of the right eye (edgeMask).
// All of one size, not empty. Throws Error otherwise.
Rivalry rivalryOf(const Plane<float>& columns, const TwoEyes& truth, const TwoEyes& image,
                  const Plane<std::uint8_t>& rightMask);

}  // namespace stereonav
