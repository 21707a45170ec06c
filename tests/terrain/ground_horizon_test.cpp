// How steeply ground rises around a sample, against rays cast over its mesh.
#include "terrain/ground/ground_horizon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "engine/math/constants.h"
#include "terrain/ground/ground_rays.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

// Returns whether a ray from a sample at that sine of elevation meets the mesh.
bool blocked(const GroundRays& rays, int i, int j, const glm::dvec2& direction, double sine) {
    const Heightfield& ground = rays.ground();
    const glm::dvec2 world = ground.worldFromGrid({i, j});
    RayPacket packet{};
    packet.originX[0] = static_cast<float>(world.x);
    packet.originY[0] = static_cast<float>(world.y);
    packet.originZ[0] = static_cast<float>(ground.sample(i, j) - rays.centreHeight() + rays.lift());
    const double across = std::sqrt(1 - sine * sine);
    packet.directionX[0] = static_cast<float>(direction.x * across);
    packet.directionY[0] = static_cast<float>(direction.y * across);
    packet.directionZ[0] = static_cast<float>(sine);
    return rays.occluded(packet, 1) != 0;
}

// Directions that lead along the grid's lines and diagonals, and such that do not. Rays start a little above
// the ground, and along an edge of a hole, or of the ground, they pass or do not.
TEST(GroundHorizon, IsWhatRaysClear) {
    for (const std::string& kind : test::groundKinds()) {
        SCOPED_TRACE(kind);
        const Heightfield ground = test::makeGround(kind, 47, 38, 11);
        const GroundRays rays(ground);
        const GroundHorizon horizon(ground);
        int looked = 0, other = 0;
        for (int j = 1; j < 37; j += 2)
            for (int i = 1; i < 46; i += 3)
                for (const double turn : {0.0, 0.3, 0.9, kPi / 2, 2.2, 3.1, kPi, 4.0, 1.5 * kPi, 5.7}) {
                    if (!std::isfinite(ground.sample(i, j))) continue;
                    const auto exact = [](double x) { return std::abs(x) < 1e-12 ? 0.0 : x; };
                    const glm::dvec2 direction(exact(std::cos(turn)), exact(std::sin(turn)));
                    const double rise = horizon.steepest(i, j, direction),
                                 sine = rise / std::hypot(1.0, rise);
                    ASSERT_GE(rise, 0);
                    constexpr double kOff = 2e-3;
                    ++looked;
                    other += sine + kOff < 1 && blocked(rays, i, j, direction, sine + kOff);
                    other += sine > 2 * kOff && !blocked(rays, i, j, direction, sine - kOff);
                }
        EXPECT_GT(looked, 1000);
        EXPECT_LE(other, kind == "holed" ? looked / 200 : 0) << "of " << looked;
    }
}

TEST(GroundHorizon, AtTheBorderAndOverTheSmallestGround) {
    // Higher to the east by 10 m each 20 m, and by 30 m each 10 m to the north.
    const Heightfield ground(3, 2, {20, 10}, {0, 10, 20, 30, 40, 50}, "slope");
    const GroundHorizon horizon(ground);
    EXPECT_DOUBLE_EQ(horizon.steepest(0, 0, {1, 0}), 0.5);
    EXPECT_DOUBLE_EQ(horizon.steepest(0, 0, {0, 1}), 3);
    EXPECT_DOUBLE_EQ(horizon.steepest(0, 1, {1, 0}), 0.5);
    EXPECT_DOUBLE_EQ(horizon.steepest(2, 0, {0, 1}), 3) << "along the eastern border";
    for (const glm::dvec2 out : {glm::dvec2(-1, 0), {0, -1}, {-0.6, 0.8}})
        EXPECT_EQ(horizon.steepest(0, 0, out), 0) << out.x;
    EXPECT_EQ(horizon.steepest(2, 1, {1, 0}), 0);
    EXPECT_DOUBLE_EQ(horizon.steepest(1, 0, {-0.6, 0.8}), 0.8 * 3 - 0.6 * 0.5);
}

TEST(GroundHorizon, HeightsAndSpacingsOfAnySize) {
    for (const double height : {1e-30, 1.0, 1e30, 8e37})
        for (const double spacing : {1e-3, 1.0, 1e7}) {
            std::vector<float> heights(25, static_cast<float>(-height));
            heights[14] = static_cast<float>(height);  // (4, 2)
            const Heightfield ground(5, 5, glm::dvec2(spacing), std::move(heights), "spike");
            const double rise = GroundHorizon(ground).steepest(0, 2, {1, 0});
            EXPECT_NEAR(rise, 2 * double(float(height)) / (4 * spacing), 1e-9 * rise)
                << height << " " << spacing;
        }
}

// Along a grid line between cells of which one side is open.
TEST(GroundHorizon, AnEdgeOfAHoleIsSeenFromBothSides) {
    const float none = std::numeric_limits<float>::quiet_NaN();
    const auto riseAlongTheMiddle = [](std::vector<float> heights) {
        const Heightfield ground(4, 3, {1, 1}, std::move(heights), "half open");
        return GroundHorizon(ground).steepest(0, 1, {1, 0});
    };
    EXPECT_DOUBLE_EQ(riseAlongTheMiddle({none, none, none, none, 0, 0, 6, 0, 0, 0, 0, 0}), 3);
    EXPECT_DOUBLE_EQ(riseAlongTheMiddle({0, 0, 0, 0, 0, 0, 6, 0, none, none, none, none}), 3);
}

}  // namespace
}  // namespace stereonav
