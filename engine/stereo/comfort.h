// Comfort of a picture's parallax, and eye settings that make it comfortable at once: for the first picture
// of a flight. During flight, settings change slowly (ComfortLimit, room_seen.h).
#pragma once

#include "engine/camera/stereo_rig.h"
#include "engine/stereo/room_seen.h"

namespace stereonav {

// Bounds of parallax that are comfortable permanently, as shares of the picture's width; farther out only
// short excursions are.
constexpr double kUsualNearest = -0.01, kUsualFarthest = 0.02;

// How long a picture's parallax can be looked at.
enum class ComfortState {
    Comfortable,  // within what is usual
    Excursion,    // within what is comfortable for a short time
    TooMuch,      // beyond the budget, or beyond excursions
};
// Judges a range of parallax; NaN is too much.
ComfortState comfortOf(const ParallaxRange& parallax);

// Returns the setting with the least change after which the same picture lies within the usual bounds, with a
// twentieth to spare. The eyes come together where the range from nearest to farthest is too wide, since no
// screen distance helps there; then the distance of the screen is changed where one end is still too near or
// too far. A comfortable setting, or one without parallax, is returned unchanged. atInfinity: parallax of
// infinitely far objects, a share of the picture's width.
StereoSetting comfortableEyes(const StereoSetting& setting, const ParallaxRange& parallax, double atInfinity);

}  // namespace stereonav
