// Speed by how far away what is ahead is: near the ground or a wall slow, far from it fast, so that what one
// looks at comes nearer as fast everywhere. A multiplier of a flight's own speed
// (FlightInput::speedMultiplier).
#pragma once

namespace stereonav {

// Seconds in which what is ahead is reached at full input.
constexpr double kReachSeconds = 4.0;
// Bounds of the speed, as shares of the base speed.
constexpr double kSlowestShare = 0.02, kFastestShare = 4.0;

// Returns metres a second, from kSlowestShare to kFastestShare of the base; the base itself where the depth
// tells nothing: the sky, NaN. depthAhead: view depth in the middle of the picture, metres; base: metres a
// second, > 0.
double speedFor(double depthAhead, double base);

constexpr double kSpeedSeconds = 0.5;  // for 63 % of a change of speed
// Returns the speed, metres a second, on its way to the wanted one, dt seconds later: by their logarithms,
// 63 % of the way in kSpeedSeconds, in closed form, so that edges that pass through the picture's middle are
// no jolts. Where one of them is not above 0 and finite the other counts; dt below 0 or NaN is nothing.
double dampedSpeed(double now, double wanted, double dt);

}  // namespace stereonav
