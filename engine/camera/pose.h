// The position and orientation of a viewer's head. World: metres, right-handed, x east, y north, z up,
// relative to the scene's own origin. Camera: x right, y up, looking along -z (like cameras of glTF and
// OpenGL), so that the identity orientation looks straight down with north up.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace stereonav {

// A head's place and orientation.
struct Pose {
    glm::dvec3 position{0.0};                         // world, metres
    glm::dquat orientation = glm::dquat(1, 0, 0, 0);  // worldFromCamera, unit

    // The camera's axes in the world, of length 1.
    glm::dvec3 right() const { return orientation * glm::dvec3(1, 0, 0); }
    glm::dvec3 up() const { return orientation * glm::dvec3(0, 1, 0); }
    glm::dvec3 forward() const { return orientation * glm::dvec3(0, 0, -1); }
};

// Returns the pose with these angles. heading: clockwise from north seen from above; pitch: upwards from the
// horizon; roll: clockwise as the viewer sees it (the right side goes down). All radians, any finite value.
Pose poseFromAngles(const glm::dvec3& position, double heading, double pitch, double roll);

// A pose's orientation as angles, defined as in poseFromAngles().
struct PoseAngles {
    double heading, pitch, roll;  // radians; heading in [0, 2 pi), pitch in [-pi/2, pi/2]
};
PoseAngles anglesOf(const Pose& pose);

}  // namespace stereonav
