// An exact quadrature over the sphere for polynomials of degree 31 and less: 16 Gauss-Legendre nodes in z by
// 33 equal angles. Nodes by Newton's method on the library's Legendre polynomials.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>

namespace stereonav::test {

// visit(direction, weight); the weights sum to 4 pi.
template <typename Visit>
void integrateOverSphere(Visit&& visit) {
    constexpr int kNodes = 16, kAngles = 33;
    for (int a = 0; a < kNodes; ++a) {
        double z = std::cos(std::numbers::pi * (a + 0.75) / (kNodes + 0.5)), slope = 1;
        for (int step = 0; step < 20; ++step) {
            const double value = std::legendre(kNodes, z);
            slope = kNodes * (z * value - std::legendre(kNodes - 1, z)) / (z * z - 1);
            z -= value / slope;
        }
        const double weight = 2 / ((1 - z * z) * slope * slope) * 2 * std::numbers::pi / kAngles;
        const double radius = std::sqrt(1 - z * z);
        for (int b = 0; b < kAngles; ++b) {
            const double azimuth = 2 * std::numbers::pi * b / kAngles;
            visit(glm::dvec3(radius * std::cos(azimuth), radius * std::sin(azimuth), z), weight);
        }
    }
}

}  // namespace stereonav::test
