#include "terrain/cast/specular.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "terrain/light/sun_and_sky.h"

namespace stereonav {

Specular::Specular(const TerrainLook& look, const glm::vec3& sunlight)
    : mStrength(look.specular), mToSun(directionToSun(look.sunAzimuth, look.sunElevation)) {
    if (!active()) return;
    mColor = mStrength * static_cast<float>(sunUp(mToSun.z)) * sunlight;
    mPower.resize(kEntries + 1);
    for (int k = 0; k <= kEntries; ++k)
        mPower[k] = std::pow(static_cast<float>(k) / kEntries, look.shininess);
}

float Specular::power(float cosine) const {
    const float at = std::clamp(cosine, 0.0f, 1.0f) * kEntries;
    const int k = std::min(static_cast<int>(at), kEntries - 1);
    return mPower[k] + (mPower[k + 1] - mPower[k]) * (at - static_cast<float>(k));
}

glm::vec3 Specular::highlight(const glm::dvec3& normal, const glm::dvec3& toEye) const {
    const glm::dvec3 sum = mToSun + toEye;
    const double length = glm::length(sum);
    if (!(length > 0) || !(glm::dot(normal, mToSun) > 0)) return glm::vec3(0.0f);
    return mColor * power(static_cast<float>(glm::dot(normal, sum) / length));
}

}  // namespace stereonav
