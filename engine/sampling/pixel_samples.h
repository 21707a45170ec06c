// Places inside a pixel that rays go through, where one ray in its centre is not enough.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "engine/camera/eye_view.h"
#include "engine/camera/stereo_rig.h"

namespace stereonav {

// Offsets from the pixel's centre, in pixels, x to the right and y downwards, each in (-0.5, 0.5).

// Returns the places of a rotated grid: no two of the `count` (1 to 64) places share a row or a column of a
// count x count grid, and the places lie as far apart as that allows, also from those of the pixels beside
// it. They are symmetric about the centre, so that a ray there can be added to them. With 4: the rotated grid
// of graphics processors. Throws Error for other counts.
std::vector<glm::dvec2> rotatedGrid(int count);

// Returns the k-th of places without end, of which each beginning covers the pixel evenly: the additive
// sequence of the plastic number (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences").
// The first, 0, is the centre. k >= 0.
glm::dvec2 evenPlace(long long k);

// Returns the same view, with each pixel's centre at `offset` from the pixel's centre here.
EyeView shiftedBy(const EyeView& view, const glm::dvec2& offset);
StereoViews shiftedBy(const StereoViews& views, const glm::dvec2& offset);

}  // namespace stereonav
