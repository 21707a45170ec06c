// Rivalry: wrong differences between the two eyes' pictures. Both eyes see most points of a scene, each at
// another pixel. What they show there may differ as much as the truths of both eyes do (a highlight, air),
// and no more. An error that both eyes share, such as that of a warped pixel copied from a wrong one, is no
// rivalry; an error of one eye is, such as between warped pixels and pixels cast anew beside them. It is a
// plain measure: suppression or filtering by human vision is not modelled.
#pragma once

#include <cstdint>

#include "engine/camera/stereo_rig.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

struct TwoEyes {
    const Plane<PackedColor>&left, &right;
};

// Returns for each pixel of the left eye the column in the right eye that shows the same point, in the same
// row, 0 for the first pixel's centre; -1 where the right eye does not see it. depths: the view depths of
// both eyes, each cast alone, metres. A point counts as seen where the depths of the two pixels beside it in
// the right eye lie within a pixel of parallax of the left one's. Throws Error where sizes differ.
Plane<float> columnsInRightEye(const StereoViews& views, const Plane<float>& leftDepth,
                               const Plane<float>& rightDepth);

struct Rivalry {
    // PSNR of (right - left) - (true right - true left) in sRGB levels over pixels that both eyes see; the
    // right eye's values are interpolated between two pixels. At most kIdenticalPsnr_db (image_difference.h);
    // NaN without such pixels.
    double psnr_db = 0;
    double edge_psnr_db = 0;  // psnr_db over only those pixels that lie on the mask in the right eye
    double seen_percent = 0;  // pixels that both eyes see, percent of the left eye's
};

// Compares the pairs. columns: from columnsInRightEye(); rightMask: holes and edges of the right eye
// (edgeMask). All of one size, not empty. Throws Error otherwise.
Rivalry rivalryOf(const Plane<float>& columns, const TwoEyes& truth, const TwoEyes& image,
                  const Plane<std::uint8_t>& rightMask);

}  // namespace stereonav
