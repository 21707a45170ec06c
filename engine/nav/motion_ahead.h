// Predicts the eyes' pose a moment ahead, for pictures that take a moment to make.
#pragma once

#include "engine/camera/pose.h"

namespace stereonav {

class MotionAhead {
public:
    static constexpr double kFarthest = 0.15;  // seconds: nobody knows what the user does later

    // Notes that the eyes went from one pose to another in dt seconds.
    void step(const Pose& before, const Pose& after, double dt);
    // Returns the pose `seconds` later, at most kFarthest. free: metres to the nearest surface; the eyes move
    // at most half of them.
    Pose from(const Pose& now, double seconds, double free) const;

private:
    glm::dvec3 mVelocity{0.0};  // metres a second
    glm::dvec3 mTurning{0.0};   // axis times radians a second, world
};

}  // namespace stereonav
