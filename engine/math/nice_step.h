// Step sizes of an axis for people to read.
#pragma once

#include <cmath>

namespace stereonav {

// Returns the smallest of 1, 2 or 5 times a power of ten of which at most six fit into `range` (> 0).
inline double niceStep(double range) {
    const double raw = range / 6, power = std::pow(10.0, std::floor(std::log10(raw)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (raw <= factor * power) return factor * power;
    return 10 * power;
}

}  // namespace stereonav
