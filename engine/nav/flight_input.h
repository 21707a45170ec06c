// Limits of a pilot's input, the same for every flight.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/nav/flight.h"

namespace stereonav {

// Returns the value within low to high; NaN counts as 0.
inline double clampedInput(double value, double low, double high) {
    return std::isnan(value) ? 0.0 : std::clamp(value, low, high);
}

// Returns the input with every value in its range. fastestTurn: radians per second, both ways.
inline FlightInput cleaned(const FlightInput& in, double fastestTurn, double mostMultiplier) {
    return {clampedInput(in.forward, -1, 1),
            clampedInput(in.right, -1, 1),
            clampedInput(in.up, -1, 1),
            clampedInput(in.yawRate, -fastestTurn, fastestTurn),
            clampedInput(in.pitchRate, -fastestTurn, fastestTurn),
            clampedInput(in.rollRate, -fastestTurn, fastestTurn),
            clampedInput(in.speedMultiplier, 0, mostMultiplier)};
}

}  // namespace stereonav
