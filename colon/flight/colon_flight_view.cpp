#include "colon/flight/colon_flight_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace stereonav {

glm::dquat FlightView::orientation() const {
    using glm::angleAxis;
    const glm::dquat turned = angleAxis(-yaw, glm::dvec3(0, 1, 0)) * angleAxis(pitch, glm::dvec3(1, 0, 0)) *
                              angleAxis(-roll, glm::dvec3(0, 0, 1));
    return glm::normalize(base * turned);
}

FlightView FlightView::facing(const glm::dvec3& direction, double share) const {
    const glm::dvec3 forward = base * glm::dvec3(0, 0, -1);
    const glm::dvec3 across = glm::cross(forward, direction);
    const double sine = glm::length(across), angle = std::atan2(sine, glm::dot(forward, direction));
    // Straight back there are many shortest arcs: turn about the head's own up.
    const glm::dvec3 axis = sine > 1e-9 ? across / sine : base * glm::dvec3(0, 1, 0);
    FlightView turned = *this;
    turned.base = glm::normalize(glm::angleAxis(angle * share, axis) * base);
    return turned;
}

FlightView between(const FlightView& a, const FlightView& b, double t) {
    return {glm::normalize(glm::slerp(a.base, b.base, t)), glm::mix(a.yaw, b.yaw, t),
            glm::mix(a.pitch, b.pitch, t), glm::mix(a.roll, b.roll, t)};
}

double pathBetween(const FlightView& a, const FlightView& b) {
    // The sine, not the cosine: exact for small angles, and 0 for equal views.
    const glm::dquat turn = glm::conjugate(a.base) * b.base;
    const double sine = glm::length(glm::dvec3(turn.x, turn.y, turn.z));
    return 2 * std::asin(std::min(sine, 1.0)) + std::abs(b.yaw - a.yaw) + std::abs(b.pitch - a.pitch) +
           std::abs(b.roll - a.roll);
}

}  // namespace stereonav
