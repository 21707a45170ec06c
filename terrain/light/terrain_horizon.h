// The horizon of each baked sample: by azimuth, the elevation above which it sees the sky. Exact on the
// mesh of ground_rays.h up to the byte's step (terrain/ground/ground_horizon.h).
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "terrain/ground/ground_horizon.h"
#include "terrain/light/terrain_light.h"

namespace stereonav {

// Returns the unit direction over the plan, metres, of plane `a` of `azimuths`.
glm::dvec2 azimuthDirection(double a, int azimuths);

// Returns the unit normal of a height sample, as shading has it; upright where the sample is unknown.
glm::dvec3 sampleNormal(const Heightfield& ground, int i, int j);

// Bakes one row of samples: horizon[a * planeSize + i], sines times 255. Samples in holes get 0. each: called
// before every few samples, as a row may take long; may throw.
void bakeHorizonRow(
    const GroundHorizon& ground, const LightGrid& grid, int row, int azimuths, std::uint8_t* horizon,
    std::size_t planeSize, const std::function<void()>& each = [] {});

}  // namespace stereonav
