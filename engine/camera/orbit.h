// A flight on a circle around an object, looking at its middle.
#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "engine/camera/pose.h"
#include "engine/camera/recorded_path.h"

namespace stereonav {

// A circle around a place, on which the viewer looks at that place.
struct Orbit {
    glm::dvec3 middle{0.0};  // world, metres
    double distance = 1;     // metres, > 0
    double pitch = 0;        // radians; negative looks down from above
};

// turn: radians, clockwise seen from above; at 0 the viewer looks northwards.
Pose poseOn(const Orbit& orbit, double turn);

// Returns a flight once around, beginning at the turn `from`. name: for messages, such as "the flight around
// the mesh".
RecordedPath flightAround(const Orbit& orbit, const std::string& name, double from = 0);

}  // namespace stereonav
