#include "colon/instruments/polyp_view.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace stereonav {

Pose eyeBeside(const MeasuredPolyp& polyp, const LineOfSight& sight, double side) {
    const glm::dvec3 helper = std::abs(polyp.outward.z) < 0.8 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    const glm::dvec3 across = glm::normalize(glm::cross(polyp.outward, helper));
    const glm::dvec3 way = glm::normalize(polyp.outward + side * 0.7 * across);
    const double wanted = std::max(0.015, 2.5 * polyp.widest.length);
    // The sight is tested from a place in front of the tip, since the polyp's middle is inside its flesh.
    const glm::dvec3 from = polyp.middle + (0.6 * polyp.widest.length + 0.001) * way;
    const double room = 0.85 * sight.reach(from, way, wanted);
    const glm::dvec3 eye = from + room * way, look = glm::normalize(polyp.middle - eye);
    return poseFromAngles(eye, std::atan2(look.x, look.y), std::asin(std::clamp(look.z, -1.0, 1.0)), 0);
}

std::vector<glm::dvec3> widestOnWall(const MeasuredPolyp& polyp, const LineOfSight& sight, double isovalue) {
    constexpr int kPlaces = 32;
    const double step = 0.1 * sight.smallestSpacing();
    std::vector<glm::dvec3> places;
    for (int n = 0; n <= kPlaces; ++n) {
        const glm::dvec3 below =
            glm::mix(polyp.widest.from, polyp.widest.to, static_cast<double>(n) / kPlaces);
        for (double up = 0; up <= polyp.widest.length; up += step) {
            const glm::dvec3 place = below + up * polyp.outward;
            if (sight.valueAt(place) >= isovalue) continue;
            places.push_back(place);
            break;
        }
    }
    return places;
}

}  // namespace stereonav
