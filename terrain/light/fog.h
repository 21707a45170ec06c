// The air between an eye and what it sees: light is lost with the distance, and the fog's own takes its
// place.
#pragma once

#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "terrain/read/scene_file.h"

namespace stereonav {

class Fog {
public:
    Fog() = default;  // none
    explicit Fog(const TerrainLook& look)
        : mPerMetre(look.fogDistance > 0 ? 1 / look.fogDistance : 0.0), mColor(look.fogColor) {}

    bool any() const { return mPerMetre > 0; }
    // linear: of what is `distance` metres away along the ray; any brightness.
    glm::vec3 seen(const glm::vec3& linear, double distance) const {
        if (!any()) return linear;
        return glm::mix(mColor, linear, static_cast<float>(std::exp(-distance * mPerMetre)));
    }

private:
    double mPerMetre = 0;    // extinction
    glm::vec3 mColor{0.0f};  // linear
};

}  // namespace stereonav
