// The air between an eye and what it sees: light is lost with the distance, and the air's own takes its
// place. A plain fog, or the air of a physical sky.
#pragma once

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "terrain/light/atmosphere.h"
#include "terrain/read/scene_file.h"

namespace stereonav {

class Fog {
public:
    Fog() = default;  // none
    explicit Fog(const TerrainLook& look)
        : mPerMetre(look.fogDistance > 0 && !look.physicalSky ? 1 / look.fogDistance : 0.0),
          mColor(look.fogColor),
          mAir(look.physicalSky ? std::make_shared<const Atmosphere>(look) : nullptr) {}

    bool any() const { return mPerMetre > 0 || mAir; }
    const Atmosphere* air() const { return mAir.get(); }
    // Returns the linear colour that the eye sees of what lies at eye + t * direction (world, metres), whose
    // own colour is `linear`; any brightness.
    glm::vec3 seen(const glm::vec3& linear, const glm::dvec3& eye, const glm::dvec3& direction,
                   double t) const {
        if (mAir) {
            const AirSeen seen = mAir->along(eye, direction, t);
            return glm::vec3(seen.through * glm::dvec3(linear) + seen.light);
        }
        if (mPerMetre == 0) return linear;
        return glm::mix(mColor, linear,
                        static_cast<float>(std::exp(-t * glm::length(direction) * mPerMetre)));
    }

private:
    double mPerMetre = 0;    // extinction, 1/metre
    glm::vec3 mColor{0.0f};  // linear
    std::shared_ptr<const Atmosphere> mAir;
};

}  // namespace stereonav
