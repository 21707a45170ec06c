// The first view of an object from outside: from a side that shows much of it, upright, with the whole object
// in the picture. Found from samples of its surface.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "engine/camera/orbit.h"

namespace stereonav {

// A sample of a surface.
struct SurfaceSample {
    glm::dvec3 place{0.0};   // world, metres
    glm::vec3 normal{0.0f};  // unit normal pointing out of the object; 0 where it is not known
};

// The picture that shows the object.
struct ViewWanted {
    double verticalFov = 0.7;  // radians
    double aspect = 16.0 / 9;  // width by height
    // Preference for a view from the south, where a patient's front and a glTF mesh's front are; 0: no side
    // is preferred.
    double front = 0;
    double least = 1e-6;  // radius for an object that is a point, metres, > 0
};

struct FirstView {
    // Orbit of the first view: from `turn` on it the object fills kFirstFill of the picture.
    Orbit orbit;
    double turn = 0;  // radians, as poseOn() takes it
    // The same orbit, or one farther away, from which the whole object is seen from all sides.
    Orbit flight;
    double radius = 0;  // radius of a ball around the samples, metres, > 0

    Pose pose() const { return poseOn(orbit, turn); }
};

// Share of the picture's shorter side that the object's projection fills in its longer direction.
constexpr double kFirstFill = 0.78;

// Finds the view; empty without samples and for places that are not finite. The result does not depend on the
// number of threads. Tries about 40 directions, each in a pass over the samples.
std::optional<FirstView> firstViewOf(const std::vector<SurfaceSample>& samples, const ViewWanted& wanted);

}  // namespace stereonav
