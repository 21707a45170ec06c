// Flicker: how far a picture's change from one frame to the next is from the truth's change. A viewer
// forgives an error that stays where it is, and sees one that comes and goes. As Chu et al. 2020 compare
// changes of neighbouring frames with those of the true ones (tLP, "Learning Temporal Coherence via
// Self-Supervision for GAN-based Video Generation", ACM Trans. Graph. 39(4)), with a plain difference in the
// place of their network's distance.
#pragma once

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// One picture at two moments.
struct Moments {
    const Plane<PackedColor>&before, &now;
};

// Returns the PSNR, dB, of (image.now - image.before) - (truth.now - truth.before), pixel by pixel, in sRGB
// levels over the three channels together; kIdenticalPsnr_db (image_difference.h) at most. An error that is
// the same in both frames costs nothing; errors that have nothing to do with each other cost 3 dB more than
// each alone. All of one size, not empty. Throws Error otherwise.
double flickerPsnr(const Moments& truth, const Moments& image);

}  // namespace stereonav
