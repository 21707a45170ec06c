// Numbers that are used in many places.
#pragma once

#include <limits>
#include <numbers>

namespace stereonav {

constexpr double kPi = std::numbers::pi;
constexpr double kRadians = std::numbers::pi / 180;  // one degree in radians
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace stereonav
