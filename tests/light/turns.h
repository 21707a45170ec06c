// Rotations for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <random>

namespace stereonav::test {

// Rodrigues' formula; axis of any length.
inline glm::dmat3 about(const glm::dvec3& axis, double angle) {
    const glm::dvec3 a = glm::normalize(axis);
    const glm::dmat3 cross(0, a.z, -a.y, -a.z, 0, a.x, a.y, -a.x, 0);
    return glm::dmat3(1.0) + std::sin(angle) * cross + (1 - std::cos(angle)) * (cross * cross);
}

inline glm::dmat3 randomTurn(std::mt19937& random) {
    std::normal_distribution<double> normal;
    const double x = normal(random), y = normal(random), z = normal(random);
    return about({x, y, z}, std::uniform_real_distribution<double>(-3.1, 3.1)(random));
}

inline double distance(const glm::dmat3& a, const glm::dmat3& b) {
    double most = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) most = std::max(most, std::abs(a[c][r] - b[c][r]));
    return most;
}

}  // namespace stereonav::test
