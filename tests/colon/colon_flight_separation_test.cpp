// The slow control of the eye separation: limits, steadiness, and the same result at any frame rate.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "colon/flight/colon_flight.h"
#include "engine/base/error.h"
#include "engine/math/constants.h"

namespace stereonav {
namespace {

using Setting = SeparationControl::Setting;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(SeparationControl, StepResponseIsMonotone) {
    for (const double depth : {0.008, 0.09}) {
        SeparationControl control(Setting(), 0.001, 0.03);
        double before = control.separation();
        for (int k = 0; k < 3000; ++k) {
            control.step(1, depth, 0.01);
            const double now = control.separation();
            ASSERT_LE(depth > 0.03 ? before : now, depth > 0.03 ? now : before) << k;
            ASSERT_NEAR(now / control.zeroParallax(), 1.0 / 30, 1e-9) << "comfort share, step " << k;
            before = now;
        }
        EXPECT_NEAR(before, depth / 30, 1e-5 * depth) << "arrives";
        EXPECT_NEAR(control.zeroParallax(), depth, 1e-4 * depth);
    }
}

TEST(SeparationControl, FollowsExponentiallyInLogarithms) {
    // Within a factor of two: ln s goes to its target with a time of `seconds`.
    SeparationControl control(Setting(), 0.001, 0.03);
    const double target = 0.03 * 1.5;
    for (int k = 1; k <= 40; ++k) {
        control.step(1, target, 0.1);
        const double left = std::log(1.5) * std::exp(-0.1 * k / 2);
        ASSERT_NEAR(std::log(target / control.zeroParallax()), left, 1e-9) << k;
    }
    // Far away: a doubling in `seconds`.
    SeparationControl far(Setting(), 0.0002, 0.006);
    far.step(kInfinity, 5, 1);
    far.step(kInfinity, 5, 1);
    EXPECT_NEAR(far.zeroParallax(), 0.012, 1e-9);
}

TEST(SeparationControl, FollowsTheFreeDistance) {
    SeparationControl control(Setting(), 0.002, 0.06);
    for (int k = 0; k < 60; ++k) control.step(0.005, 0.5, 1);
    EXPECT_NEAR(control.zeroParallax(), 0.015, 1e-6) << "three free distances";
    EXPECT_NEAR(control.separation(), 0.0005, 1e-7);
}

TEST(SeparationControl, NeverJumpsWhateverItIsTold) {
    const Setting setting;
    std::mt19937_64 random(5);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    SeparationControl control(setting, 0.001, 0.03);
    for (int k = 0; k < 100000; ++k) {
        const double odd[] = {0, -1, kNaN, kInfinity, -kInfinity, 1e300, 1e-300};
        const double free = random() % 5 == 0 ? odd[random() % 7] : uniform(0, 0.05);
        const double depth = random() % 5 == 0 ? odd[random() % 7] : std::exp(uniform(-12, 5));
        const double dt = random() % 10 == 0 ? odd[random() % 7] : std::pow(10, uniform(-4, 1));
        const double separation = control.separation(), plane = control.zeroParallax();
        control.step(free, depth, dt);
        const double time = dt > 0 ? std::min(dt, 1.0) : 0.0;
        const double most = std::log(2) / setting.seconds * time + 1e-9;
        ASSERT_LE(std::abs(std::log(control.separation() / separation)), most) << k;
        ASSERT_LE(std::abs(std::log(control.zeroParallax() / plane)), most) << k;
        ASSERT_GE(control.separation(), setting.smallest) << k;
        ASSERT_LE(control.separation(), setting.largest) << k;
        ASSERT_GE(control.zeroParallax(), 0.0002 * 30 - 1e-12) << k;
        ASSERT_LE(control.zeroParallax(), SeparationControl::kFarthestZeroParallax) << k;
    }
}

TEST(SeparationControl, IsTheSameAtAnyFrameRate) {
    const auto after = [](int milliseconds) {
        SeparationControl control(Setting(), 0.0003, 0.009);
        for (int ms = 0; ms < 12000; ms += milliseconds)
            control.step(ms < 6000 ? 0.05 : 0.004, ms < 6000 ? 0.2 : 0.02, milliseconds / 1000.0);
        return control.separation();
    };
    const double truth = after(1);
    for (const int ms : {2, 10, 16, 100, 250, 1000})
        EXPECT_NEAR(after(ms) / truth, 1, ms == 16 ? 0.01 : 1e-9) << ms << " ms";
}

TEST(SeparationControl, StartsWithinTheLimits) {
    EXPECT_EQ(SeparationControl(Setting(), kNaN, kNaN).separation(), 0.0002);
    EXPECT_EQ(SeparationControl(Setting(), 0, 0).separation(), 0.0002);
    EXPECT_EQ(SeparationControl(Setting(), 5, 1).separation(), 0.004);
    EXPECT_EQ(SeparationControl(Setting(), 5, kInfinity).zeroParallax(), 10);
    EXPECT_NEAR(SeparationControl(Setting(), 5, 0).zeroParallax(), 0.006, 1e-12);
    SeparationControl same({0.5, 0.001, 0.001, 1}, 0.001, 0.01);
    same.step(1, 1, 1);
    EXPECT_EQ(same.separation(), 0.001) << "smallest = largest";
}

TEST(SeparationControl, RefusesSettingsThatMeanNothing) {
    for (const Setting& bad :
         {Setting{0, 1e-4, 1e-3, 1}, Setting{kNaN, 1e-4, 1e-3, 1}, Setting{1, 0, 1, 1},
          Setting{1, 2e-3, 1e-3, 1}, Setting{1, 1e-4, kInfinity, 1}, Setting{1, 1e-4, 1e-3, 0}})
        EXPECT_THROW(SeparationControl(bad, 0.001, 0.03), Error);
}

}  // namespace
}  // namespace stereonav
