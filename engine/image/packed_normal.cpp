#include "engine/image/packed_normal.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace stereonav {

std::uint32_t packNormal(const glm::dvec3& n) {
    const double sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    double x = n.x / sum, y = n.y / sum;
    if (n.z < 0) {
        const double foldedX = std::copysign(1 - std::abs(y), x), foldedY = std::copysign(1 - std::abs(x), y);
        x = foldedX;
        y = foldedY;
    }
    const auto bits = [](double p) {
        return static_cast<std::uint32_t>(std::lround((p * 0.5 + 0.5) * 65535));
    };
    return bits(x) | bits(y) << 16;
}

glm::dvec3 unpackNormal(std::uint32_t packed) {
    const double x = (packed & 0xffffu) / 65535.0 * 2 - 1, y = (packed >> 16) / 65535.0 * 2 - 1;
    glm::dvec3 n(x, y, 1 - std::abs(x) - std::abs(y));
    if (n.z < 0) {
        n.x = std::copysign(1 - std::abs(y), x);
        n.y = std::copysign(1 - std::abs(x), y);
    }
    return glm::normalize(n);
}

}  // namespace stereonav
