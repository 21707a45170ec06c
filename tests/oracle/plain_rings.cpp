#include "tests/oracle/plain_rings.h"

#include <algorithm>
#include <cmath>

#include "engine/math/constants.h"

namespace stereonav {
namespace {

double exitOf(const Heightfield& ground, const glm::dvec3& origin, const glm::dvec3& direction) {
    const glm::dvec2 low = ground.originWorld(),
                     high = ground.worldFromGrid({ground.width() - 1, ground.height() - 1});
    double exit = kInfinity;
    for (int k = 0; k < 2; ++k)
        if (direction[k] != 0)
            exit = std::min(exit, ((direction[k] > 0 ? high[k] : low[k]) - origin[k]) / direction[k]);
    return exit;
}

GroundHit entryInto(const Heightfield& ground, const glm::dvec2& world, double t) {
    const glm::dvec2 at = ground.gridFromWorld(world);
    GroundHit hit;
    hit.t = t;
    hit.i = std::clamp(static_cast<int>(std::floor(at.x)), 0, ground.width() - 2);
    hit.j = std::clamp(static_cast<int>(std::floor(at.y)), 0, ground.height() - 2);
    hit.u = std::clamp(at.x - hit.i, 0.0, 1.0);
    hit.v = std::clamp(at.y - hit.j, 0.0, 1.0);
    return hit;
}

}  // namespace

RingHit castPlainRings(const GroundRings& rings, const glm::dvec3& origin, const glm::dvec3& direction,
                       double tMin, const EarthBend& bend) {
    double border = -kInfinity;
    for (int n = 0; n < static_cast<int>(rings.rings.size()); ++n) {
        const Heightfield& ground = rings.rings[n]->ground;
        const double start = std::max(tMin, border);
        if (!(start < kInfinity)) break;
        const glm::dvec3 place = bend.placeOf(origin + start * direction);
        if (n > 0 && tMin <= border && ground.contains(glm::dvec2(place)) &&
            place.z < ground.heightAt(glm::dvec2(place)))
            return {n, entryInto(ground, glm::dvec2(place), start)};
        const GroundHit hit = castPlain(ground, origin, direction, start, bend);
        if (hit.t < kInfinity) return {n, hit};
        border = std::max(border, exitOf(ground, origin, direction));
    }
    return {static_cast<int>(rings.rings.size()) - 1, {kInfinity, 0, 0, 0, 0}};
}

}  // namespace stereonav
