// Speed in proportion to the distance ahead: slow near the ground or a wall, fast far from it, so that
// whatever one looks at approaches equally fast. A multiplier of a flight's own speed
// (FlightInput::speedMultiplier).
#pragma once

namespace stereonav {

// Seconds in which the surface ahead is reached at full input.
constexpr double kReachSeconds = 4.0;
// Bounds of the speed, as shares of the base speed.
constexpr double kSlowestShare = 0.02, kFastestShare = 4.0;

// Returns metres per second, from kSlowestShare to kFastestShare of the base; the base itself where the depth
// is unknown or infinite (sky, NaN). depthAhead: view depth in the middle of the picture, metres; base:
// metres per second, > 0.
double speedFor(double depthAhead, double base);

constexpr double kSpeedSeconds = 0.5;  // for 63 % of a change of speed
// Returns the speed, metres per second, dt seconds later on its way to the wanted one: in logarithms, 63 % of
// the way in kSpeedSeconds, in closed form, so that edges that pass through the picture's middle cause no
// jolts. Where one of the speeds is not above 0 and finite, returns the other; dt below 0 or NaN counts as 0.
double dampedSpeed(double now, double wanted, double dt);

}  // namespace stereonav
