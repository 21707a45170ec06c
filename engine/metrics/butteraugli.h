// Butteraugli: how much a person would notice of the difference of two pictures, through libjxl. Its distance
// of a place is about 1 where a flip between both pictures is just noticed, and 0 where they are equal
// (https://github.com/google/butteraugli). It models what a screen emits, so it has to know how bright white
// is: kButteraugliWhite_nits. On the 8-bit sRGB bytes that a file or a display would get.
#pragma once

#include <cstdint>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// White in cd/m^2: that of sRGB's reference display (IEC 61966-2-1), which is also what libjxl takes unasked.
// A brighter screen shows errors in the dark a little better.
constexpr float kButteraugliWhite_nits = 80;

// Distances, 0 and more, without unit.
struct ButteraugliMap {
    double norm3 = 0;  // distance of the whole picture, as libjxl has it: the mean of the 3-, 6- and 12-norms
    double max = 0;    // the largest distance of a place
    Plane<float> distances;
};

// Compares two pictures of one size, from 1 x 1. Throws Error otherwise. Takes some 0.3 s for a million
// pixels on two threads.
ButteraugliMap butteraugliOf(const Plane<PackedColor>& truth, const Plane<PackedColor>& image);

// norm3 of a part of a map: inside the mask and outside it; NaN where there is no pixel.
struct ButteraugliParts {
    double inside = 0, outside = 0;
};
// distances: a map's; the mask is inside where it is not 0. Throws Error where their sizes differ.
ButteraugliParts partsOf(const Plane<float>& distances, const Plane<std::uint8_t>& mask);

// Returns a picture for the eye: grey, black at 0, half bright (in sRGB) at 1, white from 2.
Plane<PackedColor> pictureOf(const Plane<float>& distances);

}  // namespace stereonav
