// A look at the whole of a medium, with light over the viewer's shoulder.
#pragma once

#include <glm/geometric.hpp>

#include "engine/camera/stereo_rig.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"
#include "engine/medium/model/medium.h"

namespace stereonav {

struct WholeMedium {
    Pose pose;
    Lens lens;
    double distance = 0;  // metres from the eye to the middle
    glm::dvec3 light;     // direction of the light
};

inline WholeMedium wholeMedium(const Medium& medium, int size) {
    constexpr double kHeading = 0.6, kPitch = -0.3;
    const double whole = glm::length(medium.bounds().high - medium.bounds().low);
    const Pose middle = poseFromAngles(medium.bounds().center(), kHeading, kPitch, 0);
    WholeMedium look;
    look.distance = 1.6 * whole;
    look.pose = poseFromAngles(middle.position - look.distance * middle.forward(), kHeading, kPitch, 0);
    look.lens.width = look.lens.height = size;
    look.lens.verticalFov = 0.5;
    look.lens.nearDepth = 1e-3 * whole;
    look.light = glm::normalize(look.pose.forward() + 0.5 * look.pose.right() - 0.6 * look.pose.up());
    return look;
}

// Returns the light as a picture over black.
inline Plane<PackedColor> shown(const Plane<glm::vec4>& light) {
    Plane<PackedColor> picture(light.width(), light.height());
    for (int y = 0; y < light.height(); ++y)
        for (int x = 0; x < light.width(); ++x) picture.at(x, y) = packColor(glm::vec3(light.at(x, y)));
    return picture;
}

}  // namespace stereonav
