// Butteraugli: how visible the difference of two pictures is to a person, computed by libjxl. Its distance at
// a pixel is about 1 where a flip between both pictures is just noticeable, and 0 where they are equal
// (https://github.com/google/butteraugli). It models the light of a screen, so it needs the brightness of
// white: kButteraugliWhite_nits. Compares the 8-bit sRGB bytes that a file or a display would get.
#pragma once

#include <cstdint>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// White in cd/m^2: that of sRGB's reference display (IEC 61966-2-1), and libjxl's default. A brighter screen
// shows errors in dark parts a little better.
constexpr float kButteraugliWhite_nits = 80;

// Distances, 0 and more, without unit.
struct ButteraugliMap {
    double norm3 = 0;  // distance of the whole picture, libjxl's mean of the 3-, 6- and 12-norms
    double max = 0;    // largest distance of a pixel
    Plane<float> distances;
};

// Compares two pictures of one size, at least 1 x 1. Throws Error for others. Takes about 0.3 s for a million
// pixels on two threads.
ButteraugliMap butteraugliOf(const Plane<PackedColor>& truth, const Plane<PackedColor>& image);

// norm3 of a part of a map: inside the mask and outside it; NaN where there is no pixel.
struct ButteraugliParts {
    double inside = 0, outside = 0;
};
// Splits a map of distances; the inside is where the mask is not 0. Throws Error where the sizes differ.
ButteraugliParts partsOf(const Plane<float>& distances, const Plane<std::uint8_t>& mask);

// Returns the distances as a grey picture: black at 0, half bright (in sRGB) at 1, white from 2.
Plane<PackedColor> pictureOf(const Plane<float>& distances);

}  // namespace stereonav
