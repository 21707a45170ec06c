// Where the eyes will be in a moment: steady flights are told exactly, and nobody is led into a wall.
#include "engine/nav/motion_ahead.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace stereonav {
namespace {

constexpr double kFree = std::numeric_limits<double>::infinity();

Pose turningPose(double t) {  // two metres a second to the east, 0.4 radians a second clockwise
    return poseFromAngles({2 * t, 5, 1}, 0.4 * t, -0.2, 0);
}

TEST(MotionAhead, TellsASteadyFlight) {
    for (const double dt : {0.004, 0.016, 0.1}) {
        MotionAhead motion;
        const double until = 1;
        for (double t = dt; t < until + dt / 2; t += dt) motion.step(turningPose(t - dt), turningPose(t), dt);
        for (const double ahead : {0.0, 0.05, 0.15}) {
            const Pose told = motion.from(turningPose(until), ahead, kFree), is = turningPose(until + ahead);
            EXPECT_LT(glm::distance(told.position, is.position), 1e-6) << dt << " " << ahead;
            EXPECT_GT(std::abs(glm::dot(told.orientation, is.orientation)), 1 - 1e-9) << dt << " " << ahead;
        }
    }
}

TEST(MotionAhead, GoesNoFurtherThanASeventhOfASecond) {
    MotionAhead motion;
    for (int n = 1; n <= 100; ++n) motion.step(turningPose(0.01 * (n - 1)), turningPose(0.01 * n), 0.01);
    const Pose far = motion.from(turningPose(1), 5, kFree);
    EXPECT_NEAR(far.position.x, 2 + 2 * MotionAhead::kFarthest, 1e-6);
    EXPECT_EQ(motion.from(turningPose(1), -1, kFree).position, turningPose(1).position);
}

TEST(MotionAhead, UsesHalfOfTheRoomThatThereIs) {
    MotionAhead motion;
    for (int n = 1; n <= 100; ++n) motion.step(turningPose(0.01 * (n - 1)), turningPose(0.01 * n), 0.01);
    EXPECT_NEAR(motion.from(turningPose(1), 0.1, 0.02).position.x, 2.01, 1e-9);
    EXPECT_EQ(motion.from(turningPose(1), 0.1, -1).position, turningPose(1).position) << "inside a wall";
}

// A mouse moves in jumps, and what stood still stays where it is.
TEST(MotionAhead, SmoothsJumpsAndComesToRest) {
    MotionAhead motion;
    EXPECT_EQ(motion.from(turningPose(1), 0.1, kFree).position, turningPose(1).position)
        << "nothing is known";
    Pose now;
    const auto step = [&](double metres) {
        Pose next = now;
        next.position.x += metres;
        motion.step(now, next, 0.01);
        now = next;
    };
    for (int n = 0; n < 200; ++n) step(n % 5 == 0 ? 0.05 : 0);  // a metre a second
    const double ahead = motion.from(now, 0.1, kFree).position.x - now.position.x;
    EXPECT_NEAR(ahead, 0.1, 0.05);
    for (int n = 0; n < 60; ++n) step(0);
    EXPECT_NEAR(motion.from(now, 0.1, kFree).position.x, now.position.x, 1e-6);
    const Pose before = motion.from(now, 0.1, kFree);
    motion.step(now, turningPose(9), 0);  // no time passed
    EXPECT_EQ(motion.from(now, 0.1, kFree).position, before.position);
}

// The short way round, where a pose's quaternion has changed its sign.
TEST(MotionAhead, TurnsTheShortWay) {
    MotionAhead motion;
    Pose before = turningPose(0), after = turningPose(0.01);
    after.orientation = -after.orientation;
    for (int n = 0; n < 100; ++n) motion.step(before, after, 0.01);
    const Pose told = motion.from(before, 0.1, 0), is = turningPose(0.1);
    EXPECT_GT(std::abs(glm::dot(told.orientation, is.orientation)), 1 - 1e-6);
}

}  // namespace
}  // namespace stereonav
