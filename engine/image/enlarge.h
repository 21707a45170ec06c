// Pictures made in fewer pixels than they are shown in, where time is short.
#pragma once

#include "engine/image/eye_image.h"

namespace stereonav {

// Makes of a picture the same one in width x height pixels, both >= 1: colours bilinear between the centres
// of pixels, in the packed channels (square roots of linear light), and those of the border beyond the
// outermost centres; depths from the nearest pixel, since what lies between two depths is seen nowhere.
// Planes for shading again are left out. image: at least 1x1, not `large`, whose memory is used again where
// its size is the same.
void enlarge(const EyeImage& image, int width, int height, EyeImage& large);

}  // namespace stereonav
