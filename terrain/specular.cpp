#include "terrain/specular.h"

#include <algorithm>
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

Specular::Specular(const TerrainLook& look) : mStrength(look.specular) {
    const double c = std::cos(look.sunElevation);
    mToSun = {c * std::sin(look.sunAzimuth), c * std::cos(look.sunAzimuth), std::sin(look.sunElevation)};
    if (!active()) return;
    mPower.resize(kEntries + 1);
    for (int k = 0; k <= kEntries; ++k)
        mPower[k] = std::pow(static_cast<float>(k) / kEntries, look.shininess);
}

float Specular::power(float cosine) const {
    const float at = std::clamp(cosine, 0.0f, 1.0f) * kEntries;
    const int k = std::min(static_cast<int>(at), kEntries - 1);
    return mPower[k] + (mPower[k + 1] - mPower[k]) * (at - static_cast<float>(k));
}

PackedColor Specular::shade(PackedColor base, const glm::dvec3& normal, const glm::dvec3& toEye) const {
    const glm::dvec3 sum = mToSun + toEye;
    const double length = glm::length(sum);
    if (!(length > 0) || !(glm::dot(normal, mToSun) > 0)) return base;
    const float highlight = mStrength * power(static_cast<float>(glm::dot(normal, sum) / length));
    return packColor(unpackColor(base) + glm::vec3(highlight));
}

}  // namespace stereonav
