// Speed by depth: its bounds, what tells nothing, and damping that does not depend on the steps.
#include "engine/nav/depth_speed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace stereonav {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(DepthSpeed, GoesWithTheDepthWithinItsBounds) {
    EXPECT_DOUBLE_EQ(speedFor(400, 100), 100);
    EXPECT_DOUBLE_EQ(speedFor(200, 100), 50);
    for (const double base : {0.03, 100.0}) {
        EXPECT_DOUBLE_EQ(speedFor(0, base), kSlowestShare * base);
        EXPECT_DOUBLE_EQ(speedFor(-5, base), kSlowestShare * base);
        EXPECT_DOUBLE_EQ(speedFor(1e300, base), kFastestShare * base);
    }
    double before = 0;
    for (double depth = 0; depth < 2000; depth += 1) {
        EXPECT_GE(speedFor(depth, 100), before);
        before = speedFor(depth, 100);
    }
}

TEST(DepthSpeed, TheSkyTellsNothing) {
    for (const double depth : {kInfinity, -kInfinity, std::nan("")}) EXPECT_EQ(speedFor(depth, 70), 70);
}

TEST(DepthSpeed, DampsTheSameInAnySteps) {
    const double once = dampedSpeed(10, 1000, 1);
    double speed = 10;
    for (int k = 0; k < 100; ++k) speed = dampedSpeed(speed, 1000, 0.01);
    EXPECT_NEAR(speed, once, 1e-9 * once);
    EXPECT_NEAR(dampedSpeed(10, 1000, kSpeedSeconds), 1000 * std::pow(0.01, std::exp(-1)), 1e-9 * 1000);
    EXPECT_NEAR(dampedSpeed(10, 1000, 1e9), 1000, 1e-9);
    EXPECT_EQ(dampedSpeed(10, 1000, 0), 10);
    EXPECT_EQ(dampedSpeed(10, 1000, -1), 10);
    EXPECT_EQ(dampedSpeed(10, 1000, std::nan("")), 10);
    EXPECT_EQ(dampedSpeed(0, 1000, 1), 1000);
    EXPECT_EQ(dampedSpeed(10, std::nan(""), 1), 10);
    EXPECT_EQ(dampedSpeed(10, kInfinity, 1), 10);
}

}  // namespace
}  // namespace stereonav
