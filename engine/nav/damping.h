// Exponential damping in closed form: exact for steps of any length, so nothing to go unstable.
#pragma once

#include <cmath>

namespace stereonav {

// Brings `rate` (a number or vector, per second) towards `wanted`, 63 % of the way in `time` seconds; returns
// its integral over dt seconds.
template <typename T>
T damped(T& rate, const T& wanted, double time, double dt) {
    const double left = std::exp(-dt / time);
    const T sum = wanted * dt + (rate - wanted) * (time * (1 - left));
    rate = wanted + (rate - wanted) * left;
    return sum;
}

}  // namespace stereonav
