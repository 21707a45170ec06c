// What a homogeneous slab does to light, in closed form: the truth of optical_depth_rows_test.cpp and
// medium_sweep_rows_test.cpp.
#pragma once

#include <algorithm>
#include <cmath>

namespace stereonav::test {

constexpr double kEyeCosine = 0.7, kLightCosine = 0.8, kThick = 0.3;  // kThick in metres

// Mean of exp(-t) over [0, z].
inline double meanOfExp(double z) {
    return z == 0 ? 1 : -std::expm1(-z) / z;
}

// Returns what a slab of optical depths x (eye) and y (light) sends to the eye of a light of 1, from the
// integral of exp(-t) over both ways (docs/volume_light.md, V5 and V6 for a single slab).
inline double shareOf(double x, double y, bool forward) {
    if (forward) return x * meanOfExp(x + y);
    return x * std::exp(-std::min(x, y)) * meanOfExp(std::abs(x - y));
}

}  // namespace stereonav::test
