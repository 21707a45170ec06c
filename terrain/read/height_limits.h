// The range of heights that the program can hold: floats, in metres.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/error.h"

namespace stereonav {

// Larger than the Earth's radius, so that no ground is higher; casters are tested up to this.
constexpr double kMostHeight_m = 1e7;

// Throws Error that names `file` where heights from low to high, times the vertical scale, are beyond
// kMostHeight_m, or too small for floats. low, high: metres.
inline void checkScaledHeights(const std::string& file, double low, double high, double verticalScale) {
    constexpr double kLeast_m = 1e-30;  // below 1.2e-38 floats lose digits
    const double most = std::max(std::abs(low), std::abs(high));
    const auto fail = [&](const char* expected, const char* advice) {
        throw Error(
            file, "vertical scale",
            fmt::format("expected {}, got {:.6g} to {:.6g} m times {:g}", expected, low, high, verticalScale),
            advice);
    };
    if (!(most * verticalScale <= kMostHeight_m))
        fail("heights within 10,000 km", "give a smaller --vertical-scale");
    if (most > 0 && most * verticalScale < kLeast_m)
        fail("heights that are not lost beside 0", "give a larger --vertical-scale");
}

}  // namespace stereonav
