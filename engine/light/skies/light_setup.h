// The light for baking a scene, and the surface that it falls on: all colours are linear RGB.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "engine/light/skies/light_probe.h"
#include "engine/math/luminance.h"

namespace stereonav {

// A light that shines evenly in all directions from a place.
struct PointLight {
    glm::dvec3 position{0.0};   // world, metres
    glm::vec3 intensity{0.0f};  // W/sr in units of the probe: irradiance at distance d is intensity / d^2
    // Metres: at smaller distances the light counts as being this far away, so that a light on the surface
    // stays finite.
    double radius = 1e-3;
};

// Returns the weight with which one of many lights is chosen: the luminance of its intensity.
inline double lightWeight(const PointLight& light) {
    return luminance(glm::dvec3(light.intensity));
}

// All light of a bake, and the surface that it falls on.
struct LightSetup {
    std::shared_ptr<const LightProbe> probe;  // may be null
    // The same radiance from all directions, in addition to the probe.
    glm::vec3 sky{0.0f};
    std::vector<PointLight> lights;  // hard shadows
    glm::vec3 albedo{0.7f};          // 0..1, linear: that of the diffuse surface
    // Metres at which distant light (probe and sky) begins: a ray that has met nothing by then sees it, so
    // that closed cavities get light too. 0: infinitely far away.
    double reach = 0;
    int bounces = 2;  // 0: direct light alone; at most 8
};

}  // namespace stereonav
