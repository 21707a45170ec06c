// The plain cell walk: one ray, every cell it crosses, an exact hit in each, all in double precision. It is
// the oracle for the fast caster, and its fallback where single precision can not decide.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/math/earth_bend.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

struct GroundHit {
    double t = 0;         // ray parameter; infinity: no hit
    int i = 0, j = 0;     // the cell that is hit
    double u = 0, v = 0;  // position inside it, each in [0, 1]
};

// Returns the first t >= tMin at which origin + t * direction (world, metres) meets the bilinear surface,
// from either side. direction: any length, not zero. Cells with a hole have no surface. bend: the Earth's
// curvature for this ray.
GroundHit castPlain(const Heightfield& ground, const glm::dvec3& origin, const glm::dvec3& direction,
                    double tMin, const EarthBend& bend = {});

}  // namespace stereonav
