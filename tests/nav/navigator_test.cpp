// The navigator: clearance whatever is done, the same flight at any frame rate, motion by closed forms.
#include "engine/nav/navigator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "engine/base/error.h"

namespace stereonav {
namespace {
using std::numbers::pi;

double flatGround(const glm::dvec2&) {
    return 0.0;
}

// A bed of spikes: tents of random height over every lattice point, 10 m apart, up to 400 m.
double spikyGround(const glm::dvec2& p) {
    const glm::dvec2 g = p / 10.0, cell = glm::floor(g + 0.5);
    const auto i = static_cast<std::int64_t>(cell.x), j = static_cast<std::int64_t>(cell.y);
    std::uint64_t h = static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15ull ^ static_cast<std::uint64_t>(j);
    h = (h ^ h >> 31) * 0xbf58476d1ce4e5b9ull;
    const double height = 400.0 * static_cast<double>(h >> 11) / 9007199254740992.0;
    const double away = std::max(std::abs(g.x - cell.x), std::abs(g.y - cell.y));
    return height * (1 - 2 * away);
}

Pose above(double z, double heading = 0, double pitch = 0) {
    return poseFromAngles({0, 0, z}, heading, pitch, 0);
}

FlightInput randomInput(std::mt19937& random) {
    std::uniform_real_distribution<double> share(-1.0, 1.0), speed(0.0, 30.0);
    FlightInput input;
    input.forward = share(random);
    input.right = share(random);
    input.up = share(random) - 0.4;
    input.yawRate = 3 * share(random);
    input.pitchRate = 3 * share(random);
    input.rollRate = 3 * share(random);
    input.speedMultiplier = speed(random);
    return input;
}

bool isFinite(const Pose& pose) {
    const auto& p = pose.position;
    const auto& q = pose.orientation;
    return std::isfinite(p.x + p.y + p.z + q.w + q.x + q.y + q.z);
}

TEST(Navigator, NeverComesBelowTheClearance) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> logStep(std::log(0.001), std::log(1.0));
    FlightSetting setting;
    setting.clearance = 3;
    setting.groundStep = 5;
    setting.speed = 10;
    Navigator nav(spikyGround, above(100), setting);
    FlightInput input;
    for (int k = 0; k < 100000; ++k) {
        if (k % 20 == 0) input = randomInput(random);
        if (k % 500 == 0) nav.setMode(k % 1000 == 0 ? FlightMode::FollowGround : FlightMode::Free);
        nav.step(input, std::exp(logStep(random)));
        const glm::dvec3 p = nav.pose().position;
        ASSERT_TRUE(isFinite(nav.pose())) << "step " << k;
        ASSERT_GE(p.z, spikyGround(glm::dvec2(p)) + 3) << "step " << k;
        ASSERT_LE(glm::length(glm::dvec2(nav.velocity())), 10 * 30 * std::sqrt(2.0) + 1e-9);
    }
}

TEST(Navigator, LongStepsDoNotTunnelThroughARidge) {
    // A wall 300 m high and 20 m wide across the way; a step of a second is 100 m long.
    const auto wall = [](const glm::dvec2& p) { return std::max(0.0, 300 - 30 * std::abs(p.y - 250)); };
    double highest = 0;
    FlightSetting setting;
    setting.groundStep = 2;
    Navigator nav(
        [&](const glm::dvec2& p) {
            const double h = wall(p);
            highest = std::max(highest, h);
            return h;
        },
        above(20), setting);
    FlightInput input;
    input.forward = 1;
    for (int k = 0; k < 6; ++k) nav.step(input, 1.0);
    EXPECT_GT(nav.pose().position.y, 400);
    EXPECT_GT(highest, 300 - 30 * 2) << "the ridge was not looked at";
    EXPECT_GE(nav.pose().position.z, 300 - 30 * 2) << "went through the ridge instead of over it";
}

// The same wishes in steps of n times 1/1000 s.
Pose flown(int millisecondsAStep, FlightMode mode, const GroundHeight& ground) {
    Navigator nav(ground, above(300, 0.3), FlightSetting());
    nav.setMode(mode);
    for (int ms = 0; ms < 6000; ms += millisecondsAStep) {
        FlightInput input;
        input.forward = ms < 4000 ? 1.0 : -0.5;
        input.right = 0.25;
        input.up = ms < 2000 ? 0.2 : 0.0;
        input.yawRate = ms < 3000 ? 0.8 : -0.4;
        input.pitchRate = ms < 1000 ? -0.1 : 0.05;
        input.rollRate = 0.1;
        nav.step(input, millisecondsAStep / 1000.0);
    }
    return nav.pose();
}

TEST(Navigator, FliesTheSameWayAtAnyFrameRate) {
    const GroundHeight hills = [](const glm::dvec2& p) {
        return 40 * std::sin(p.x / 90) * std::cos(p.y / 70);
    };
    for (const FlightMode mode : {FlightMode::Free, FlightMode::FollowGround}) {
        const Pose truth = flown(1, mode, hills);
        for (const int ms : {2, 4, 8, 20, 50, 100, 250, 500, 1000}) {
            const Pose pose = flown(ms, mode, hills);
            // After some 400 m the rest comes from substeps that begin elsewhere.
            EXPECT_LT(glm::length(pose.position - truth.position), 0.05) << ms << " ms";
            EXPECT_GT(std::abs(glm::dot(pose.orientation, truth.orientation)), 1 - 1e-9) << ms << " ms";
        }
    }
}

TEST(Navigator, StraightFlightIsTheClosedForm) {
    // v(t) = s (1 - exp(-t / T)), x(t) = s (t - T (1 - exp(-t / T))) with T = 0.25 s.
    for (const double dt : {0.001, 0.016, 0.5}) {
        Navigator nav(flatGround, above(50), FlightSetting());
        FlightInput input;
        input.forward = 1;
        const int steps = static_cast<int>(std::lround(2.0 / dt));
        for (int k = 0; k < steps; ++k) nav.step(input, dt);
        const double t = steps * dt, left = std::exp(-t / 0.25);
        EXPECT_NEAR(nav.velocity().y, 100 * (1 - left), 1e-9);
        EXPECT_NEAR(nav.pose().position.y, 100 * (t - 0.25 * (1 - left)), 1e-9);
        EXPECT_NEAR(nav.pose().position.x, 0, 1e-12);
        EXPECT_NEAR(nav.pose().position.z, 50, 1e-12);
    }
}

TEST(Navigator, ComesToRestWithoutWishes) {
    Navigator nav(flatGround, above(50), FlightSetting());
    FlightInput input;
    input.forward = 1;
    input.yawRate = 1;
    for (int k = 0; k < 100; ++k) nav.step(input, 0.01);
    for (int k = 0; k < 500; ++k) nav.step(FlightInput(), 0.01);
    EXPECT_LT(glm::length(nav.velocity()), 1e-6);
    const Pose rest = nav.pose();
    nav.step(FlightInput(), 0.5);
    EXPECT_LT(glm::length(nav.pose().position - rest.position), 1e-6);
}

TEST(Navigator, ForwardIsWhereTheViewerLooks) {
    Navigator nav(flatGround, above(500, 0.7, 0.4), FlightSetting());
    const glm::dvec3 before = nav.pose().position, forward = nav.pose().forward();
    FlightInput input;
    input.forward = 1;
    nav.step(input, 1);
    EXPECT_NEAR(glm::dot(glm::normalize(nav.pose().position - before), forward), 1, 1e-12);
    input = {};
    input.right = 1;
    nav.goHome();
    const glm::dvec3 right = nav.pose().right();
    nav.step(input, 1);
    EXPECT_NEAR(glm::dot(glm::normalize(nav.pose().position - before), right), 1, 1e-12);
}

TEST(Navigator, TurnsBothWays) {
    Navigator nav(flatGround, above(50), FlightSetting());
    nav.turnBy(0.5, -0.25);
    EXPECT_NEAR(anglesOf(nav.pose()).heading, 0.5, 1e-12);
    EXPECT_NEAR(anglesOf(nav.pose()).pitch, -0.25, 1e-12);
    FlightInput input;
    input.rollRate = 0.5;
    for (int k = 0; k < 50; ++k) nav.step(input, 0.02);
    // 1 s at 0.5 rad/s, less what the damping of 0.08 s costs.
    EXPECT_NEAR(anglesOf(nav.pose()).roll, 0.5 * (1 - 0.08), 1e-4);
    nav.turnBy(0, 100);
    EXPECT_NEAR(anglesOf(nav.pose()).pitch, pi / 2, 1e-6);
    nav.turnBy(0, -100);
    EXPECT_NEAR(anglesOf(nav.pose()).pitch, -pi / 2, 1e-6);
}

TEST(Navigator, FollowsTheGroundAtItsHeight) {
    // Gentle waves of 20 m: at 100 m/s and 50 m above them.
    const GroundHeight waves = [](const glm::dvec2& p) { return 10 * std::sin(p.y / 400); };
    FlightSetting setting;
    setting.followHeight = 50;
    Navigator nav(waves, above(0), setting);
    nav.setMode(FlightMode::FollowGround);
    EXPECT_EQ(nav.followHeight(), 50);
    FlightInput input;
    input.forward = 1;
    for (int k = 0; k < 300; ++k) nav.step(input, 0.02);
    for (int k = 0; k < 2000; ++k) {
        nav.step(input, 0.02);
        ASSERT_NEAR(nav.heightAboveGround(), 50, 6) << "step " << k;
    }
    input.up = 1;
    for (int k = 0; k < 50; ++k) nav.step(input, 0.02);
    EXPECT_NEAR(nav.followHeight(), 50 * std::exp(0.8), 1e-6);
}

TEST(Navigator, FollowingOverACliffIsSmooth) {
    const GroundHeight cliff = [](const glm::dvec2& p) { return p.y > 500 && p.y < 1500 ? 200.0 : 0.0; };
    Navigator nav(cliff, above(50), FlightSetting());
    nav.setMode(FlightMode::FollowGround);
    FlightInput input;
    input.forward = 1;
    double before = nav.velocity().z;
    for (int k = 0; k < 2000; ++k) {
        const double speedBefore = before;
        nav.step(input, 0.01);
        before = nav.velocity().z;
        const glm::dvec3 p = nav.pose().position;
        ASSERT_GE(p.z, cliff(glm::dvec2(p)) + 2);
        // At the edge itself the clearance may lift.
        if (p.y < 499 || p.y > 501) {
            ASSERT_LT(std::abs(before - speedBefore), 0.01 * 2000) << "jerk at " << p.y;
        }
    }
    EXPECT_NEAR(nav.pose().position.z, 50, 1);
}

TEST(Navigator, KeepsThePresentHeightWhenItStartsToFollow) {
    Navigator nav(flatGround, above(320), FlightSetting());
    nav.setMode(FlightMode::FollowGround);
    EXPECT_NEAR(nav.followHeight(), 320, 1e-9);
    nav.step(FlightInput(), 1);
    EXPECT_NEAR(nav.pose().position.z, 320, 1e-9);
}

TEST(Navigator, FliesOverHolesAndOddGround) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    Navigator nav([](const glm::dvec2& p) { return p.y > 10 ? kNaN : 0.0; }, above(30), FlightSetting());
    FlightInput input;
    input.forward = 1;
    input.up = -0.2;
    for (const FlightMode mode : {FlightMode::FollowGround, FlightMode::Free}) {
        nav.setMode(mode);
        for (int k = 0; k < 20; ++k) nav.step(input, 0.1);
        ASSERT_TRUE(isFinite(nav.pose()));
    }
    EXPECT_EQ(nav.heightAboveGround(), std::numeric_limits<double>::infinity());
    nav.setMode(FlightMode::FollowGround);
    EXPECT_TRUE(std::isfinite(nav.followHeight()));
}

TEST(Navigator, GoesHomeAtRestAndAboveTheGround) {
    Navigator nav(flatGround, above(-500, 1, 0.2), FlightSetting());
    EXPECT_EQ(nav.pose().position.z, 2.0) << "a home below the ground is lifted";
    FlightInput input;
    input.forward = input.yawRate = 1;
    nav.step(input, 1);
    nav.goHome();
    EXPECT_EQ(nav.pose().position, glm::dvec3(0, 0, 2));
    EXPECT_EQ(nav.velocity(), glm::dvec3(0));
    EXPECT_NEAR(anglesOf(nav.pose()).heading, 1, 1e-12);
}

TEST(Navigator, NonsenseInputsChangeNothing) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(),
                     kInf = std::numeric_limits<double>::infinity();
    Navigator nav(flatGround, above(50), FlightSetting());
    const Pose before = nav.pose();
    nav.step({1, 1, 1, 1, 1, 1, 1}, -1);
    nav.step({1, 1, 1, 1, 1, 1, 1}, 0);
    nav.step({1, 1, 1, 1, 1, 1, 1}, kNaN);
    nav.step({kNaN, kNaN, kNaN, kNaN, kNaN, kNaN, kNaN}, 0.5);
    nav.turnBy(kNaN, kNaN);
    EXPECT_EQ(nav.pose().position, before.position);
    EXPECT_EQ(nav.pose().orientation, before.orientation);
    nav.step({kInf, -kInf, kInf, kInf, kInf, kInf, kInf}, kInf);
    EXPECT_TRUE(isFinite(nav.pose()));
    EXPECT_LE(nav.pose().position.y, FlightSetting().groundStep * Navigator::kMostLooks);
}

TEST(Navigator, RefusesSettingsThatMeanNothing) {
    const auto refused = [](FlightSetting setting) {
        try {
            Navigator nav(flatGround, above(10), setting);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    FlightSetting setting;
    setting.clearance = 0;
    EXPECT_THAT(refused(setting), testing::HasSubstr("clearance: expected a number above 0, got 0"));
    setting = {};
    setting.speed = std::nan("");
    EXPECT_THAT(refused(setting), testing::HasSubstr("speed: expected a number above 0, got nan"));
    setting = {};
    setting.groundStep = -1;
    EXPECT_THAT(refused(setting), testing::HasSubstr("ground step: expected a number above 0, got -1"));
    Pose lost = above(10);
    lost.position.x = std::nan("");
    EXPECT_THROW(Navigator(flatGround, lost, FlightSetting()), Error);
}

}  // namespace
}  // namespace stereonav
