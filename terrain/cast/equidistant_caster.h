// The ray casting of Wan et al. 2004, section 2.1, kept for comparison: the ray is sampled at equal distances
// until a sample lies below the ground. It can miss what is thinner than a step, and its depth is too large
// by up to one step.
#pragma once

#include <glm/vec3.hpp>

#include "engine/math/earth_bend.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

// Returns the first parameter tMin + k * step at which origin + t * direction (world, metres) lies on or
// below the ground; infinite where the ray leaves the ground's extent before. step: in units of t, > 0. bend:
// the Earth's curvature for this ray.
double castEquidistant(const Heightfield& ground, const glm::dvec3& origin, const glm::dvec3& direction,
                       double tMin, double step, const EarthBend& bend = {});

}  // namespace stereonav
