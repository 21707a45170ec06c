#include "engine/light/skies/sky_map.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/base/parallel.h"

namespace stereonav {

glm::vec3 SkyMap::directionOf(float px, float py) {
    glm::vec3 d(px, py, 1.0f - std::abs(px) - std::abs(py));
    if (d.z < 0) {
        d.x = std::copysign(1.0f - std::abs(py), px);
        d.y = std::copysign(1.0f - std::abs(px), py);
    }
    return glm::normalize(d);
}

SkyMap::SkyMap(int size, const std::function<glm::vec3(const glm::vec3&)>& radiance) : mMap(size, size) {
    parallelFor(size, [&](int j) {
        for (int i = 0; i < size; ++i) {
            const float px = (static_cast<float>(i) + 0.5f) / static_cast<float>(size) * 2 - 1;
            const float py = (static_cast<float>(j) + 0.5f) / static_cast<float>(size) * 2 - 1;
            mMap.at(i, j) = packColor(radiance(directionOf(px, py)));
        }
    });
}

glm::vec3 gradientSky(const glm::vec3& direction) {
    const glm::vec3 haze(0.60f, 0.68f, 0.76f), horizon(0.52f, 0.66f, 0.84f), zenith(0.10f, 0.25f, 0.58f);
    if (direction.z <= 0) return glm::mix(horizon, haze, std::min(1.0f, -8.0f * direction.z));
    return glm::mix(horizon, zenith, std::pow(direction.z, 0.6f));
}

}  // namespace stereonav
