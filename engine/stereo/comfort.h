// How hard a picture's parallax is on the eyes, and eyes that make it comfortable at once: for a picture that
// begins something. What goes on while one flies changes slowly (ComfortLimit, room_seen.h).
#pragma once

#include "engine/camera/stereo_rig.h"
#include "engine/stereo/room_seen.h"

namespace stereonav {

// Bounds of parallax within which all may lie all the time, as shares of the picture's width; farther out are
// short excursions.
constexpr double kUsualNearest = -0.01, kUsualFarthest = 0.02;

// How long a picture's parallax can be looked at.
enum class ComfortState {
    Comfortable,  // within what is usual
    Excursion,    // within what is comfortable for a short time
    TooMuch,      // beyond the budget, or beyond excursions
};
// Judges a range of parallax; NaN is too much.
ComfortState comfortOf(const ParallaxRange& parallax);

// Returns the setting, changed as little as it takes for the same picture to lie within what is usual, and a
// twentieth less: eyes come together where the range from nearest to farthest is too wide, which no screen
// distance mends; what is then still too near or too far is mended by the distance of the screen. The setting
// stays as it is where it is comfortable or has no parallax. atInfinity: the parallax of what is infinitely
// far, a share of the picture's width.
StereoSetting comfortableEyes(const StereoSetting& setting, const ParallaxRange& parallax, double atInfinity);

}  // namespace stereonav
