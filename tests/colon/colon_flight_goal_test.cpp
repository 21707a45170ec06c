// Flights to a goal through lumens: along the line, turned round, straight, and around what is in the way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/nav/flight_to.h"
#include "tests/support/analytic_lumen.h"

namespace stereonav {
namespace {
using State = FlightTo::State;

constexpr ColonFlightSetting kGoalSetting{0.002, 0.03, 0.004};

ColonFlight flightThrough(const AnalyticLumen& lumen) {
    return ColonFlight(lumen.freeDistance(), lumen.line, lumen.home, kGoalSetting);
}

// Holds the clearance at every pose; returns how it ended.
State flyTo(FlightTo to, ColonFlight& flight, const AnalyticLumen& lumen, double* seconds = nullptr) {
    State state = State::Flying;
    double time = 0;
    while (state == State::Flying && time < 20) {
        state = to.step(flight, 1.0 / 60);
        time += 1.0 / 60;
        const Pose pose = flight.pose();
        for (const double side : {-0.002, 0.0, 0.002}) {
            const double free = lumen.distance(pose.position + side * pose.right());
            EXPECT_GE(free, std::min(0.002, flight.allowedClearance()) * 0.9) << lumen.name << time;
            if (free < 0.001) return State::Blocked;
        }
    }
    if (seconds) *seconds = time;
    return state;
}

TEST(ColonFlightGoal, GoesAlongTheLineAndBack) {
    for (const AnalyticLumen& lumen : {straightTube(), torus(), flexure(), foldedTube(0.02, 0.008)}) {
        ColonFlight flight = flightThrough(lumen);
        const double length = lumen.line.length();
        for (const double share : {0.5, 0.9, 0.1, 0.1, 0.6}) {
            const double before = flight.along().value();
            double seconds = 0;
            EXPECT_EQ(flyTo(FlightTo::along(flight, share * length), flight, lumen, &seconds), State::Arrived)
                << lumen.name << share;
            EXPECT_NEAR(flight.along().value(), share * length, 0.003) << lumen.name << share;
            EXPECT_LT(seconds, 7.5) << lumen.name << share;
            if (std::abs(share * length - before) > 0.01) {
                EXPECT_EQ(flight.goesBack(), share * length < before) << lumen.name << share;
            }
            // At rest; in a corner the wall still pushes sideways.
            const double stands = flight.along().value();
            flight.step({}, 1);
            EXPECT_NEAR(flight.along().value(), stands, 0.001) << lumen.name << share;
        }
    }
}

TEST(ColonFlightGoal, GoesToTheEndsAndBeyondNone) {
    const AnalyticLumen lumen = straightTube();
    ColonFlight flight = flightThrough(lumen);
    EXPECT_EQ(flyTo(FlightTo::along(flight, 0.3), flight, lumen), State::Arrived);
    EXPECT_NEAR(flight.along().value(), 0.3, 0.003);
    EXPECT_EQ(flyTo(FlightTo::along(flight, 0), flight, lumen), State::Arrived);
    EXPECT_NEAR(flight.along().value(), 0, 0.003);
    EXPECT_THROW(FlightTo::along(flight, std::nan("")), Error);
}

TEST(ColonFlightGoal, CrossesWhereTheLumenIsInterrupted) {
    const AnalyticLumen lumen = interrupted();
    ColonFlight flight = flightThrough(lumen);
    const double length = lumen.line.length();
    EXPECT_EQ(flyTo(FlightTo::along(flight, length - 0.03), flight, lumen), State::Arrived);
    EXPECT_NEAR(flight.along().value(), length - 0.03, 0.003);
    EXPECT_EQ(flyTo(FlightTo::along(flight, 0.02), flight, lumen), State::Arrived);
    EXPECT_NEAR(flight.along().value(), 0.02, 0.003);
}

TEST(ColonFlightGoal, TurningRoundTakesTheViewAndTheWay) {
    for (const AnalyticLumen& lumen : {straightTube(), torus()}) {
        ColonFlight flight = flightThrough(lumen);
        flight.step({1, 0, 0}, 1);
        flight.step({1, 0, 0}, 1);
        flight.step({1, 0, 0}, 1);
        const Pose before = flight.pose();
        const double along = flight.along().value();
        EXPECT_FALSE(flight.goesBack());
        EXPECT_TRUE(flight.turnRound());
        EXPECT_TRUE(flight.goesBack());
        double leastUp = 1;
        for (int k = 0; k < 130; ++k) {
            flight.step({}, 0.01);
            leastUp = std::min(leastUp, glm::dot(flight.pose().up(), before.up()));
        }
        EXPECT_LT(glm::dot(flight.pose().forward(), before.forward()), -0.9) << lumen.name;
        EXPECT_GT(leastUp, 0.9) << "no somersault";
        for (int k = 0; k < 100; ++k) flight.step({1, 0, 0}, 0.01);
        EXPECT_LT(flight.along().value(), along - 0.01) << lumen.name;
        EXPECT_TRUE(flight.turnRound());
        for (int k = 0; k < 130; ++k) flight.step({}, 0.01);
        for (int k = 0; k < 200; ++k) flight.step({1, 0, 0}, 0.01);
        EXPECT_GT(flight.along().value(), along) << lumen.name;
        EXPECT_GT(glm::dot(flight.pose().forward(), before.forward()), 0.5) << lumen.name;
        flight.turnRound();
        flight.goHome();
        EXPECT_FALSE(flight.goesBack());
    }
}

TEST(ColonFlightGoal, TurnedRoundTwiceInAHurryLooksWhereItDid) {
    const AnalyticLumen lumen = straightTube();
    ColonFlight flight = flightThrough(lumen);
    const Pose before = flight.pose();
    flight.turnRound();
    flight.step({}, 0.5);
    flight.turnRound();
    for (int k = 0; k < 200; ++k) flight.step({}, 0.01);
    EXPECT_GT(glm::dot(flight.pose().forward(), before.forward()), 0.9999);
}

TEST(ColonFlightGoal, FreeFlightsHaveNoWayToTurnRoundOn) {
    const AnalyticLumen lumen = straightTube();
    ColonFlight flight = flightThrough(lumen);
    flight.setMode(ColonFlight::Free);
    EXPECT_FALSE(flight.turnRound());
    EXPECT_FALSE(flight.along());
    EXPECT_EQ(flight.lineMode(), ColonFlight::Guided);
    ColonFlight open(lumen.freeDistance(), {}, lumen.home, kGoalSetting);
    EXPECT_FALSE(open.lineMode());
    EXPECT_TRUE(std::isnan(open.alongNear({0, 0, 0})));
    EXPECT_THROW(FlightTo::along(open, 0.1), Error);
}

TEST(ColonFlightGoal, FindsAPoseAroundTheCornerInBothModes) {
    const AnalyticLumen lumen = flexure();
    const double apart = 2 * 0.012 + 0.001;
    const Pose goal = lookingAlong({apart + 0.004, 0.03, 0.003}, glm::normalize(glm::dvec3(0.2, 1, 0.1)));
    for (const int mode : {int(ColonFlight::Guided), int(ColonFlight::Free)}) {
        ColonFlight flight = flightThrough(lumen);
        flight.setMode(mode);
        flight.setPose(lookingAlong({0, 0.02, 0}, {0, 1, 0}));
        double seconds = 0;
        EXPECT_EQ(flyTo(FlightTo::pose(flight, goal), flight, lumen, &seconds), State::Arrived) << mode;
        EXPECT_LT(glm::distance(flight.pose().position, goal.position), 0.0007) << mode;
        EXPECT_GT(glm::dot(flight.pose().forward(), goal.forward()), 0.999) << mode;
        EXPECT_EQ(flight.mode(), mode);
        EXPECT_LT(seconds, kLongestFlightTo + 3.1);
    }
}

TEST(ColonFlightGoal, APoseInTheWallIsComeNearTo) {
    const AnalyticLumen lumen = straightTube();
    ColonFlight flight = flightThrough(lumen);
    const Pose goal = lookingAlong({0.05, 0.2, 0}, {0, 1, 0});
    EXPECT_EQ(flyTo(FlightTo::pose(flight, goal), flight, lumen), State::Blocked);
    EXPECT_GT(flight.pose().position.y, 0.15);
}

// Outside: a ball in the way is flown around.
TEST(ColonFlightGoal, FliesAroundWhatIsInTheWay) {
    AnalyticLumen ball;
    ball.name = "ball";
    ball.distance = [](const glm::dvec3& p) { return glm::length(p) - 0.1; };
    ball.home = lookingAlong({0, -0.3, 0}, {0, 1, 0});
    ColonFlight flight(ball.freeDistance(), {}, ball.home, {0.002, 0.1, 0.004});
    const Pose goal = lookingAlong({0, 0.3, 0.02}, {0, -1, 0});
    EXPECT_EQ(flyTo(FlightTo::pose(flight, goal), flight, ball), State::Arrived);
    EXPECT_LT(glm::distance(flight.pose().position, goal.position), 0.002);
    EXPECT_GT(glm::dot(flight.pose().forward(), goal.forward()), 0.9999);
}

}  // namespace
}  // namespace stereonav
