#include "terrain/cast/equidistant_caster.h"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>

#include "engine/math/constants.h"

namespace stereonav {
namespace {

// The part of the ray over the ground's extent; for a rising ray the part below the highest sample, for a
// straight falling ray the part above the lowest.
struct Part {
    double begin, end;
};

Part overGround(const Heightfield& ground, const glm::dvec3& origin, const glm::dvec3& direction, double tMin,
                const EarthBend& bend) {
    Part part{tMin, kInfinity};
    const glm::dvec2 low = ground.originWorld();
    const glm::dvec2 high = ground.worldFromGrid({ground.width() - 1, ground.height() - 1});
    for (int axis = 0; axis < 2; ++axis) {
        const double d = direction[axis];
        if (d == 0) {
            if (origin[axis] < low[axis] || origin[axis] > high[axis]) return {1, 0};
            continue;
        }
        const double a = (low[axis] - origin[axis]) / d, b = (high[axis] - origin[axis]) / d;
        part.begin = std::max(part.begin, std::min(a, b));
        part.end = std::min(part.end, std::max(a, b));
    }
    if (direction.z > 0) part.end = std::min(part.end, (ground.maxHeight() - origin.z) / direction.z);
    if (direction.z < 0 && bend.fall == 0)
        part.end = std::min(part.end, (ground.minHeight() - origin.z) / direction.z + 1);
    return part;
}

}  // namespace

double castEquidistant(const Heightfield& ground, const glm::dvec3& origin, const glm::dvec3& direction,
                       double tMin, double step, const EarthBend& bend) {
    const Part part = overGround(ground, origin, direction, tMin, bend);
    for (double k = std::ceil((part.begin - tMin) / step);; ++k) {
        const double t = tMin + k * step;
        if (!(t <= part.end + step)) return kInfinity;
        const glm::dvec3 p = bend.placeOf(origin + t * direction);
        if (ground.contains(glm::dvec2(p)) && p.z <= ground.heightAt(glm::dvec2(p))) return t;
    }
}

}  // namespace stereonav
