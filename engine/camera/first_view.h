// Where a viewer begins who looks at an object from outside: a side that shows much of it, upright, and all
// of it in the picture. Found from samples of its surface.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "engine/camera/orbit.h"

namespace stereonav {

// A piece of a surface.
struct SurfaceSample {
    glm::dvec3 place{0.0};   // world, metres
    glm::vec3 normal{0.0f};  // out of the object; unit, or 0 where it is not known
};

// The picture that an object is to be seen in.
struct ViewWanted {
    double verticalFov = 0.7;  // radians
    double aspect = 16.0 / 9;  // width by height
    // How much a view from the south is preferred, where a patient's front and a glTF mesh's are; 0: no side
    // is.
    double front = 0;
    double least = 1e-6;  // radius for an object that is a point, metres, > 0
};

struct FirstView {
    Orbit orbit;        // on which the first view lies: at `turn`, it is filled to kFirstFill
    double turn = 0;    // radians, as poseOn() takes it
    Orbit flight;       // the same orbit, or one further away, on which the object is whole from all sides
    double radius = 0;  // radius of a ball around the samples, metres, > 0

    Pose pose() const { return poseOn(orbit, turn); }
};

// Share of the picture's shorter side that the object's projection fills in its longer direction.
constexpr double kFirstFill = 0.78;

// Finds the view; nothing without samples and for places that are not finite. The same on any number of
// threads. Some 40 directions are looked at, each a pass over the samples.
std::optional<FirstView> firstViewOf(const std::vector<SurfaceSample>& samples, const ViewWanted& wanted);

}  // namespace stereonav
