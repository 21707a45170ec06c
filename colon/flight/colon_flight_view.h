// The direction in which the viewer of a colon flight looks: a base that follows the travel, and the user's
// own turning added to it.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace stereonav {

struct FlightView {
    glm::dquat base = glm::dquat(1, 0, 0, 0);  // worldFromCamera
    double yaw = 0, pitch = 0, roll = 0;       // radians, on top of the base: signs of FlightInput's rates

    glm::dquat orientation() const;
    glm::dvec3 right() const { return orientation() * glm::dvec3(1, 0, 0); }
    // Returns the same view with everything in the base.
    FlightView settled() const { return {orientation(), 0, 0, 0}; }
    // Returns a view whose base is turned by `share` of the way towards a unit direction, along the shortest
    // arc, without roll.
    FlightView facing(const glm::dvec3& direction, double share) const;
};

// Returns the view on the way from a (t = 0) to b (t = 1).
FlightView between(const FlightView& a, const FlightView& b, double t);
// Returns an upper bound of the angle in radians through which the head turns from a to b by between().
double pathBetween(const FlightView& a, const FlightView& b);

}  // namespace stereonav
