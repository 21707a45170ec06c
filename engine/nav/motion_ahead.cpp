#include "engine/nav/motion_ahead.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace stereonav {
namespace {

constexpr double kSmoothing = 0.05;  // seconds: a mouse moves in jumps
constexpr double kStill = 1e-9;      // radians

glm::dvec3 turnOf(const glm::dquat& before, const glm::dquat& after) {
    glm::dquat turn = after * glm::conjugate(before);
    if (turn.w < 0) turn = -turn;
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const double sine = glm::length(axis);
    return sine > kStill ? axis / sine * (2 * std::atan2(sine, turn.w)) : glm::dvec3(0.0);
}

}  // namespace

void MotionAhead::step(const Pose& before, const Pose& after, double dt) {
    if (!(dt > 0)) return;
    const double share = 1 - std::exp(-dt / kSmoothing);
    mVelocity += share * ((after.position - before.position) / dt - mVelocity);
    mTurning += share * (turnOf(before.orientation, after.orientation) / dt - mTurning);
}

Pose MotionAhead::from(const Pose& now, double seconds, double free) const {
    const double ahead = std::clamp(seconds, 0.0, kFarthest);
    Pose pose = now;
    glm::dvec3 way = ahead * mVelocity;
    const double length = glm::length(way), most = std::max(0.5 * free, 0.0);
    if (length > most) way *= most / length;  // never of what has no walls: that is infinite
    pose.position += way;
    const double angle = ahead * glm::length(mTurning);
    if (angle > kStill)
        pose.orientation = glm::normalize(glm::angleAxis(angle, glm::normalize(mTurning)) * now.orientation);
    return pose;
}

}  // namespace stereonav
