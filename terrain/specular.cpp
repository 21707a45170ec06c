#include "terrain/specular.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace stereonav {

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
