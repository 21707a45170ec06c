// The light above a terrain for a place of the sun: its own, and the sky's in harmonics. A plain model
// without weather, fitted to the scene's look: with the sun 45 degrees high, level open ground gets white
// light of strength 1, the share `ambient` of it from the sky.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/light/skies/sky_map.h"
#include "terrain/read/scene_file.h"

namespace stereonav {

// Radiance by direction above the horizontal, mirrored below it, in even harmonics (terrain_light.h) of the
// largest order.
struct SkyRadiance {
    std::vector<glm::vec3> harmonics;  // coefficients of radiance, linear
    glm::vec3 level{0.0f};             // irradiance / pi on open level ground, linear
};
// radiance: linear, for unit directions above the horizontal.
SkyRadiance skyRadiance(const std::function<glm::vec3(const glm::dvec3&)>& radiance);
SkyRadiance skyRadiance(const SkyMap& sky);

constexpr double kSunRadius = 0.00465;  // radians

// Returns the share of a disc above the horizontal, 0..1, by the sine of its middle's elevation. radius:
// radians.
double sunUp(double sine, double radius = kSunRadius);

// The light of a place of the sun. Colours are linear.
struct SunAndSky {
    glm::dvec3 toSun{0, 0, 1};  // unit
    glm::vec3 sun{0.0f};        // irradiance / pi of a surface that faces the sun
    // Transmittance of the air for the sun, relative to that for a sun 45 degrees high; 0 once it has set.
    glm::vec3 sunThroughAir{0.0f};
    SkyRadiance sky;
    double sunRadius = kSunRadius;  // radians; edges of shadows are at least a step of the baked horizon soft

    glm::vec3 level() const;  // both on open level ground, irradiance / pi
};

// Returns a unit direction; radians, azimuth clockwise from north.
glm::dvec3 directionToSun(double azimuth, double elevation);

// Returns the light under a look's sun. sky: how it looks; how bright it is follows from the model. Below the
// horizon the sun sends nothing, and the sky fades until 6 degrees below.
SunAndSky sunAndSky(const TerrainLook& look, const SkyRadiance& sky);

// Returns the factor on light for display: level ground stays as bright as at 45 degrees while the sun sinks,
// by a factor of 4 at most; then it gets dark.
float exposureOf(const SunAndSky& light);

}  // namespace stereonav
