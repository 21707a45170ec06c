// A square root for constant expressions, in which std::sqrt is not allowed.
#pragma once

namespace stereonav {

// Returns the square root of x, 0 to 1e30.
constexpr double constantRoot(double x) {
    double root = x > 1 ? x : 1;
    for (int n = 0; n < 64; ++n) root = 0.5 * (root + x / root);
    return root;
}

}  // namespace stereonav
