#include "engine/camera/pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stereonav {

Pose poseFromAngles(const glm::dvec3& position, double heading, double pitch, double roll) {
    using glm::angleAxis;
    using glm::dvec3;
    const double quarter = std::numbers::pi / 2;
    const glm::dquat q = angleAxis(-heading, dvec3(0, 0, 1)) * angleAxis(quarter + pitch, dvec3(1, 0, 0)) *
                         angleAxis(-roll, dvec3(0, 0, 1));
    return {position, glm::normalize(q)};
}

PoseAngles anglesOf(const Pose& pose) {
    const glm::dvec3 f = pose.forward(), r = pose.right(), u = pose.up();
    const double pitch = std::asin(std::clamp(f.z, -1.0, 1.0));
    const double horizontal = std::hypot(f.x, f.y);
    // Looking straight up or down the heading is that of the head's top (or its opposite) and there
    // is no roll apart from it.
    double heading, roll = 0.0;
    if (horizontal > 1e-9) {
        heading = std::atan2(f.x, f.y);
        roll = std::atan2(-r.z, u.z);
    } else {
        heading = f.z < 0 ? std::atan2(u.x, u.y) : std::atan2(-u.x, -u.y);
    }
    if (heading < 0) heading += 2 * std::numbers::pi;
    return {heading, pitch, roll};
}

}  // namespace stereonav
