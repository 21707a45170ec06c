// Flights to a goal over ground and in the open: they arrive, at rest, in bounded time, and are smooth.
#include "engine/nav/flight_to.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "engine/base/error.h"
#include "engine/nav/navigator.h"

namespace stereonav {
namespace {
using std::numbers::pi;
using State = FlightTo::State;

constexpr double kFrame = 1.0 / 60;

double goalPlain(const glm::dvec2&) {
    return 0;
}
// A ridge across the way, 600 m high.
double goalRidge(const glm::dvec2& p) {
    return 600 * std::exp(-p.y * p.y / (2 * 150 * 150));
}
// A cliff, as steep as a sample allows.
double goalCliff(const glm::dvec2& p) {
    return std::clamp(p.y * 40, 0.0, 400.0);
}

Navigator over(const GroundHeight& ground, const Pose& home) {
    FlightSetting setting;
    setting.clearance = 2;
    setting.speed = 100;
    return Navigator(ground, home, setting);
}

double angleOf(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat turn = glm::conjugate(a) * b;
    return 2 * std::asin(std::min(1.0, glm::length(glm::dvec3(turn.x, turn.y, turn.z))));
}

struct Flown {
    State state = State::Flying;
    std::vector<Pose> poses;
    double seconds = 0;
};

Flown flown(FlightTo to, Flight& flight, double dt = kFrame) {
    Flown result;
    result.poses.push_back(flight.pose());
    while (result.state == State::Flying && result.seconds < 20) {
        result.state = to.step(flight, dt);
        result.seconds += dt;
        result.poses.push_back(flight.pose());
    }
    return result;
}

TEST(FlightTo, ArrivesAtThePoseInBoundedTime) {
    const Pose home = poseFromAngles({0, -1000, 50}, 0, 0, 0);
    for (const double far : {0.0, 1e-6, 1.0, 100.0, 5e3, 1e6}) {
        Navigator flight = over(goalPlain, home);
        const Pose goal = poseFromAngles({far, -1000 + far, 80}, 2.5, -0.4, 0);
        const FlightTo to = FlightTo::pose(flight, goal);
        EXPECT_GE(to.duration(), kShortestFlightTo);
        EXPECT_LE(to.duration(), kLongestFlightTo);
        const Flown way = flown(to, flight);
        EXPECT_EQ(way.state, State::Arrived) << far;
        EXPECT_NEAR(way.seconds, to.duration(), kFrame + 1e-9) << far;
        EXPECT_LT(glm::distance(flight.pose().position, goal.position), 1e-6 + 1e-12 * far) << far;
        EXPECT_LT(angleOf(flight.pose().orientation, goal.orientation), 1e-7) << far;
        EXPECT_EQ(flight.velocity(), glm::dvec3(0.0));
    }
}

TEST(FlightTo, TakesLongerForALongerWayAndAWiderTurn) {
    Navigator flight = over(goalPlain, poseFromAngles({0, 0, 50}, 0, 0, 0));
    const auto seconds = [&](double far, double heading) {
        return FlightTo::pose(flight, poseFromAngles({0, far, 50}, heading, 0, 0)).duration();
    };
    EXPECT_LT(seconds(10, 0), seconds(100, 0));
    EXPECT_LT(seconds(100, 0), seconds(1000, 0));
    EXPECT_LT(seconds(0, 0.1), seconds(0, 3));
    EXPECT_EQ(seconds(0, 0), kShortestFlightTo);
}

TEST(FlightTo, BeginsAndEndsSmoothly) {
    Navigator flight = over(goalPlain, poseFromAngles({0, 0, 50}, 0, 0, 0));
    const Flown way = flown(FlightTo::pose(flight, poseFromAngles({0, 2000, 50}, 1, 0, 0)), flight);
    std::vector<double> steps;
    for (std::size_t k = 1; k < way.poses.size(); ++k)
        steps.push_back(glm::distance(way.poses[k].position, way.poses[k - 1].position));
    const double most = *std::max_element(steps.begin(), steps.end());
    EXPECT_LT(steps.front(), 0.001 * most);
    EXPECT_LT(steps.back(), 0.001 * most);
    for (std::size_t k = 1; k < steps.size(); ++k)
        EXPECT_LT(std::abs(steps[k] - steps[k - 1]), 0.04 * most) << k;
}

TEST(FlightTo, KeepsTheClearanceOverARidgeWithoutAKink) {
    for (const auto& ground : {goalRidge, goalCliff}) {
        Navigator flight = over(ground, poseFromAngles({0, -1500, 30}, 0, 0, 0));
        const Pose goal = poseFromAngles({100, 1500, ground({100, 1500}) + 30}, 0, 0, 0);
        const Flown way = flown(FlightTo::pose(flight, goal), flight);
        EXPECT_EQ(way.state, State::Arrived);
        double highest = 0, sharpest = 0;
        for (std::size_t k = 1; k + 1 < way.poses.size(); ++k) {
            const glm::dvec3 p = way.poses[k].position;
            EXPECT_GE(p.z, ground(glm::dvec2(p)) + 2 - 1e-9);
            highest = std::max(highest, p.z);
            const glm::dvec3 a = p - way.poses[k - 1].position, b = way.poses[k + 1].position - p;
            if (glm::length(a) > 1 && glm::length(b) > 1)
                sharpest = std::max(sharpest,
                                    std::acos(std::min(1.0, glm::dot(glm::normalize(a), glm::normalize(b)))));
        }
        EXPECT_GT(highest, ground({50, 0}) > 500 ? 600 : 400);
        EXPECT_LT(sharpest, 0.2);
    }
}

TEST(FlightTo, AGoalInTheGroundIsRaised) {
    Navigator flight = over(goalRidge, poseFromAngles({0, -1500, 30}, 0, 0, 0));
    const Flown way = flown(FlightTo::pose(flight, poseFromAngles({0, 0, 10}, 0, 0, 0)), flight);
    EXPECT_EQ(way.state, State::Arrived);
    EXPECT_NEAR(flight.pose().position.z, 602, 1e-9);
}

TEST(FlightTo, OverGroundTheGoalsHeightIsKept) {
    for (const double height : {20.0, 500.0}) {
        Navigator flight = over(goalPlain, poseFromAngles({0, -1500, 30}, 0, 0, 0));
        flight.setMode(FlightMode::FollowGround);
        EXPECT_EQ(flown(FlightTo::pose(flight, poseFromAngles({0, 0, height}, 0, 0, 0)), flight).state,
                  State::Arrived);
        EXPECT_EQ(flight.mode(), 1);
        for (int k = 0; k < 10; ++k) flight.step({}, 1);
        EXPECT_NEAR(flight.pose().position.z, height, 1e-6);
    }
}

TEST(FlightTo, FliesTheSameInStepsOfAnyLength) {
    std::vector<Pose> ends;
    for (const double dt : {0.005, 1.0 / 60, 0.3, 30.0}) {
        Navigator flight = over(goalRidge, poseFromAngles({0, -1500, 30}, 0, 0, 0));
        FlightTo to = FlightTo::pose(flight, poseFromAngles({0, 1500, 40}, 1, 0.1, 0));
        double time = 0;
        for (; time < 2.4 - 1e-9 && dt < 1; time += dt) to.step(flight, std::min(dt, 2.4 - time));
        if (dt > 1) to.step(flight, 2.4);
        ends.push_back(flight.pose());
    }
    for (const Pose& end : ends) {
        EXPECT_LT(glm::distance(end.position, ends.front().position), 1e-6);
        EXPECT_LT(angleOf(end.orientation, ends.front().orientation), 1e-7);
    }
}

TEST(FlightTo, StandsStillForNoTime) {
    Navigator flight = over(goalPlain, poseFromAngles({0, 0, 50}, 0, 0, 0));
    FlightTo to = FlightTo::pose(flight, poseFromAngles({0, 500, 50}, 0, 0, 0));
    for (const double dt : {0.0, -1.0, std::nan("")}) EXPECT_EQ(to.step(flight, dt), State::Flying);
    EXPECT_EQ(flight.pose().position, glm::dvec3(0, 0, 50));
    EXPECT_EQ(to.step(flight, 1e300), State::Arrived);
}

TEST(FlightTo, RefusesWhatIsNoPlace) {
    Navigator flight = over(goalPlain, poseFromAngles({0, 0, 50}, 0, 0, 0));
    const double inf = std::numeric_limits<double>::infinity();
    for (const double bad : {std::nan(""), inf, -inf, 1e10}) {
        EXPECT_THROW(FlightTo::pose(flight, {{0, bad, 0}, glm::dquat(1, 0, 0, 0)}), Error);
        EXPECT_THROW(poseLookingAt({bad, 0, 0}, 1, Pose()), Error);
        EXPECT_THROW(poseLookingAt({0, 0, 0}, bad, Pose()), Error);
    }
    EXPECT_THROW(FlightTo::pose(flight, {{0, 0, 0}, glm::dquat(0, 0, 0, 0)}), Error);
    EXPECT_THROW(FlightTo::pose(flight, {{0, 0, 0}, glm::dquat(std::nan(""), 0, 0, 0)}), Error);
    EXPECT_THROW(poseLookingAt({0, 0, 0}, 0, Pose()), Error);
    EXPECT_THROW(FlightTo::along(flight, 1), Error) << "no line";
}

TEST(PoseLookingAt, LooksAtThePointFromTheSideItWasSeenFrom) {
    for (const glm::dvec3 from :
         {glm::dvec3(10, 20, 30), glm::dvec3(-5, 0, 0), glm::dvec3(0, 0, 7), glm::dvec3(0, 0, -7)}) {
        const glm::dvec3 point(1e-3 * from.x, 0, 1);
        const Pose pose = poseLookingAt(point, 3, poseFromAngles(from, 1.2, 0.3, 0.4));
        EXPECT_LT(glm::distance(pose.position + 3.0 * pose.forward(), point), 1e-9);
        EXPECT_GT(glm::dot(glm::normalize(from - point), glm::normalize(pose.position - point)), 1 - 1e-9);
        EXPECT_NEAR(pose.right().z, 0, 1e-9) << "level";
    }
    const Pose there = poseLookingAt({1, 2, 3}, 2, poseFromAngles({1, 2, 3}, 0.5, 0.1, 0));
    EXPECT_NEAR(anglesOf(there).heading, 0.5, 1e-9);
    EXPECT_LT(glm::distance(there.position + 2.0 * there.forward(), glm::dvec3(1, 2, 3)), 1e-9);
}

TEST(PoseBetween, LevelHeadsStayLevelAndTurnTheShorterWay) {
    const Pose a = poseFromAngles({0, 0, 0}, 6.0, 0.9, 0), b = poseFromAngles({2, 0, 0}, 0.4, -0.9, 0);
    for (double t = 0; t <= 1; t += 0.125) {
        const PoseAngles angles = anglesOf(poseBetween(a, b, t));
        EXPECT_NEAR(angles.roll, 0, 1e-9);
        EXPECT_NEAR(std::remainder(angles.heading - (6.0 + t * (0.4 + 2 * pi - 6.0)), 2 * pi), 0, 1e-9);
    }
    const Pose rolled = poseFromAngles({0, 0, 0}, 1, 0, 1), back{{0, 0, 0}, -rolled.orientation};
    EXPECT_LT(angleOf(poseBetween(rolled, back, 0.5).orientation, rolled.orientation), 1e-7);
}

}  // namespace
}  // namespace stereonav
