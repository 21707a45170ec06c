// Poses and angles: directions that follow from the definitions, and the way back.
#include "engine/camera/pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "engine/math/constants.h"

namespace stereonav {
namespace {

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-12) {
    EXPECT_LT(glm::distance(a, b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(Pose, IdentityLooksDownWithNorthUp) {
    const Pose pose;
    expectNear(pose.forward(), {0, 0, -1});
    expectNear(pose.up(), {0, 1, 0});
    expectNear(pose.right(), {1, 0, 0});
}

TEST(Pose, HeadingIsClockwiseFromNorth) {
    expectNear(poseFromAngles({}, 0, 0, 0).forward(), {0, 1, 0});
    expectNear(poseFromAngles({}, kPi / 2, 0, 0).forward(), {1, 0, 0});
    expectNear(poseFromAngles({}, kPi, 0, 0).forward(), {0, -1, 0});
    expectNear(poseFromAngles({}, kPi / 2, 0, 0).right(), {0, -1, 0});
    expectNear(poseFromAngles({}, 1.2, 0, 0).up(), {0, 0, 1});
}

TEST(Pose, PitchIsUpwards) {
    const Pose pose = poseFromAngles({1, 2, 3}, 0, 0.3, 0);
    expectNear(pose.forward(), {0, std::cos(0.3), std::sin(0.3)});
    EXPECT_EQ(pose.position, glm::dvec3(1, 2, 3));
}

TEST(Pose, RollTakesTheRightSideDown) {
    const Pose pose = poseFromAngles({}, 0, 0, 0.3);
    expectNear(pose.right(), {std::cos(0.3), 0, -std::sin(0.3)});
    expectNear(pose.forward(), {0, 1, 0});
}

TEST(Pose, AnglesComeBack) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> heading(0, 2 * kPi), pitch(-1.5, 1.5), roll(-3.1, 3.1);
    for (int k = 0; k < 1000; ++k) {
        const double h = heading(random), p = pitch(random), r = roll(random);
        const PoseAngles angles = anglesOf(poseFromAngles({}, h, p, r));
        ASSERT_NEAR(angles.heading, h, 1e-9);
        ASSERT_NEAR(angles.pitch, p, 1e-9);
        ASSERT_NEAR(angles.roll, r, 1e-9);
    }
}

// Heading and roll are one there; the angles returned must still make the same pose.
TEST(Pose, StraightUpAndDown) {
    for (const double pitch : {-kPi / 2, kPi / 2})
        for (const double heading : {0.0, 1.0, 4.0}) {
            const Pose pose = poseFromAngles({}, heading, pitch, 0.5);
            const PoseAngles angles = anglesOf(pose);
            const Pose again = poseFromAngles({}, angles.heading, angles.pitch, angles.roll);
            expectNear(again.forward(), pose.forward(), 1e-6);
            expectNear(again.up(), pose.up(), 1e-6);
            EXPECT_NEAR(angles.roll, 0, 1e-12);
        }
}

TEST(Pose, AxesAreRightHandedAndOrthonormal) {
    const Pose pose = poseFromAngles({}, 0.7, -0.4, 2.0);
    expectNear(glm::cross(pose.right(), pose.up()), -pose.forward());
    EXPECT_NEAR(glm::length(pose.orientation), 1, 1e-14);
}

}  // namespace
}  // namespace stereonav
