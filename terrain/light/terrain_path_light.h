// Light on the ground by plain path tracing, one place at a time: the truth that baked light is measured
// against. Knows neither horizons nor harmonics; the sun is a disc that is sampled, the sky a function.
#pragma once

#include <functional>

#include "terrain/ground/ground_rays.h"
#include "terrain/light/sun_and_sky.h"

namespace stereonav {

// Light at a place, linear.
struct PathLight {
    glm::dvec3 mean{0.0};  // irradiance / pi
    double variance = 0;   // estimate, of the mean's luminance
};

// How paths are traced.
struct PathLightSetting {
    double albedo = 0.3;  // 0..1, of the ground that light bounces from
    int bounces = 2;
    int paths = 1024;  // a multiple of 16
    std::uint64_t seed = 1;
};

// Traces the light at a place of the ground: world, metres. sky: radiance, linear, for unit directions above
// the horizontal. Normals are smoothed as in shading, at the place and wherever a path meets the ground.
PathLight tracePathLight(const GroundRays& rays, const glm::dvec2& place, const SunAndSky& light,
                         const std::function<glm::vec3(const glm::dvec3&)>& sky,
                         const PathLightSetting& setting);

}  // namespace stereonav
