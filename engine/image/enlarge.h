// Enlarges pictures that were made with fewer pixels than they are shown with, to save time.
#pragma once

#include "engine/image/eye_image.h"

namespace stereonav {

// Enlarges a picture to width x height pixels, both >= 1. Colours are bilinear between pixel centres, in the
// packed channels (square roots of linear light), and repeated beyond the outermost centres. Depths are those
// of the nearest pixel, since between two depths there is nothing. Planes for shading again are left out.
// image: at least 1x1, another object than `large`, whose memory is reused where its size is the same.
void enlarge(const EyeImage& image, int width, int height, EyeImage& large);

}  // namespace stereonav
