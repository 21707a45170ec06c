// The plain cell walk over ground in rings: the oracle for the kernels' (kernel_rings.h).
#pragma once

#include "terrain/cast/plain_caster.h"
#include "terrain/ground/ground_rings.h"

namespace stereonav {

struct RingHit {
    int ring = 0;   // index, finest first
    GroundHit hit;  // in that ring's ground
};

// First t >= tMin at which origin + t * direction (world) meets a ring's surface, or the step up to the next
// ring's where it enters that. direction: any length, not zero. bend: of the ground, as the ray sees it.
RingHit castPlainRings(const GroundRings& rings, const glm::dvec3& origin, const glm::dvec3& direction,
                       double tMin, const EarthBend& bend = {});

}  // namespace stereonav
