// The guided and the free flight in lumens whose distances are closed forms.
#include "colon/flight/colon_flight.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "engine/base/error.h"
#include "engine/math/constants.h"
#include "tests/support/analytic_lumen.h"

namespace stereonav {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
using std::numbers::pi;

ColonFlight flightIn(const AnalyticLumen& lumen, double separation = 0.004, double clearance = 0.002) {
    return ColonFlight(lumen.freeDistance(), lumen.line, lumen.home, {clearance, 0.03, separation});
}

FlightInput wish(double forward, double right = 0, double up = 0) {
    FlightInput input;
    input.forward = forward;
    input.right = right;
    input.up = up;
    return input;
}

void fly(ColonFlight& flight, const FlightInput& input, double seconds, double dt = 0.01) {
    const int steps = static_cast<int>(std::lround(seconds / dt));
    for (int k = 0; k < steps; ++k) flight.step(input, dt);
}

double angleTo(const ColonFlight& flight, const glm::dvec3& direction) {
    return std::acos(std::clamp(glm::dot(flight.pose().forward(), direction), -1.0, 1.0));
}

TEST(ColonFlight, GuidedFlightGoesToTheEndAndBack) {
    for (const AnalyticLumen& lumen :
         {straightTube(), torus(), foldedTube(), flexure(), interrupted(), throat(0.0025)}) {
        ColonFlight flight = flightIn(lumen);
        ASSERT_EQ(flight.modeName(flight.mode()), "guided");
        fly(flight, wish(1), 2 * lumen.line.length() / 0.03 + 5, 0.05);
        EXPECT_LT(glm::distance(flight.pose().position, lumen.line.points.back().position), 0.003)
            << lumen.name;
        fly(flight, wish(-1), 2 * lumen.line.length() / 0.03 + 5, 0.05);
        EXPECT_LT(glm::distance(flight.pose().position, lumen.line.points.front().position), 0.003)
            << lumen.name;
    }
}

TEST(ColonFlight, GoesOnFromAnyPlaceThatSteeringLedTo) {
    for (const AnalyticLumen& lumen : {torus(), foldedTube(), flexure(), interrupted(), throat(0.003)}) {
        std::mt19937_64 random(3);
        const auto key = [&random] { return std::uniform_real_distribution<double>(-1, 1)(random); };
        for (int start = 0; start < 20; ++start) {
            ColonFlight flight = flightIn(lumen);
            fly(flight, wish(1), lumen.line.length() / 0.03 * start / 20, 0.05);
            flight.setMode(start % 2 ? ColonFlight::Free : ColonFlight::Guided);
            for (int k = 0; k < 8; ++k) fly(flight, wish(key(), key(), key()), 1, 0.05);
            flight.setMode(ColonFlight::Guided);
            fly(flight, wish(1), 2 * lumen.line.length() / 0.03 + 5, 0.05);
            EXPECT_LT(glm::distance(flight.pose().position, lumen.line.points.back().position), 0.003)
                << lumen.name << ", start " << start;
        }
    }
}

TEST(ColonFlight, StraightFlightHasTheSpeedThatWasSet) {
    ColonFlight flight = flightIn(straightTube());
    fly(flight, wish(1), 4);
    // s(t) = v (t - T (1 - exp(-t / T))), T = 0.25 s: exact in a straight tube.
    EXPECT_NEAR(flight.pose().position.y, 0.03 * (4 - 0.25 * (1 - std::exp(-16.0))), 1e-9);
    EXPECT_NEAR(glm::length(glm::dvec2(flight.pose().position.x, flight.pose().position.z)), 0, 1e-12);
}

// Returns where the same wishes lead in steps of some milliseconds.
glm::dvec3 flownIn(const AnalyticLumen& lumen, int mode, int milliseconds) {
    ColonFlight flight = flightIn(lumen);
    flight.setMode(mode);
    for (int ms = 0; ms < 6000; ms += milliseconds) {
        FlightInput input = wish(ms < 4000 ? 1 : -0.5, ms < 2000 ? 0.6 : 0, ms >= 3000 ? -0.4 : 0.1);
        input.yawRate = ms < 3000 ? 0.3 : -0.2;
        input.pitchRate = 0.05;
        flight.step(input, milliseconds / 1000.0);
    }
    return flight.pose().position;
}

TEST(ColonFlight, FliesTheSameWayAtAnyFrameRate) {
    for (const AnalyticLumen& lumen : {straightTube(), torus()})
        for (const int mode : {0, 1}) {
            const glm::dvec3 truth = flownIn(lumen, mode, 1);
            EXPECT_GT(glm::distance(truth, lumen.home.position), 0.01) << lumen.name;
            for (const int ms : {2, 5, 16, 40, 100, 200}) {
                // 16 does not divide 6000: the wishes change up to 16 ms later, 0.5 mm of flight.
                const double tolerance = ms == 16 ? 0.0010 : 0.0004;
                EXPECT_LT(glm::distance(flownIn(lumen, mode, ms), truth), tolerance)
                    << lumen.name << ", mode " << mode << ", " << ms << " ms";
            }
        }
}

TEST(ColonFlight, TheWallPushesOffButDoesNotSwing) {
    const AnalyticLumen lumen = straightTube(0.012);
    ColonFlight flight = flightIn(lumen);
    fly(flight, wish(1), 3);
    fly(flight, wish(0, 1), 3);
    const double pressed = flight.clearanceNow() - 0.002;
    EXPECT_LT(pressed, 0.0005) << "steering to the side does not come near to the wall";
    double before = pressed;
    int falls = 0;
    for (int k = 0; k < 1000; ++k) {
        flight.step(wish(0), 0.01);
        const double room = flight.clearanceNow() - 0.002;
        if (k > 200 && room < before - 1e-9) ++falls;
        before = room;
    }
    EXPECT_GT(before, pressed + 0.0005) << "not pushed off";
    EXPECT_EQ(falls, 0) << "went back to the wall without a wish";
}

// Two walls 0.4 mm of room apart, both pushing hard: the camera comes to rest between them.
TEST(ColonFlight, ComesToRestBetweenOppositeWallsInLongSteps) {
    for (const double dt : {0.001, 0.01, 0.1, 1.0}) {
        AnalyticLumen lumen = straightTube();
        lumen.distance = [](const glm::dvec3& p) { return 0.0044 - std::abs(p.x); };
        ColonFlight flight = flightIn(lumen, 0.004);
        fly(flight, wish(0.5, 1), 1, dt);
        fly(flight, wish(0), 4, dt);
        glm::dvec3 before = flight.pose().position;
        for (int k = 0; k < 50; ++k) {
            flight.step(wish(0), dt);
            ASSERT_LT(glm::distance(flight.pose().position, before), 1e-6 + 1e-4 * dt) << dt << " s";
            before = flight.pose().position;
            ASSERT_LE(std::abs(before.x), 0.0024);
        }
    }
}

TEST(ColonFlight, FreeFlightSlidesAlongTheWall) {
    ColonFlight flight = flightIn(straightTube());
    flight.setMode(ColonFlight::Free);
    flight.turnBy(pi / 4, 0);
    fly(flight, wish(1), 6);
    EXPECT_GT(flight.pose().position.y, 0.06) << "stopped at the wall";
    EXPECT_GT(flight.pose().position.x, 0.01) << "never came to the wall";
    EXPECT_LT(flight.clearanceNow(), 0.006);
    EXPECT_GE(flight.clearanceNow(), 0.002 - 1e-12);
    const glm::dvec3 before = flight.pose().position;
    fly(flight, wish(0), 2);
    const glm::dvec3 rest = flight.pose().position;
    fly(flight, wish(0), 5);
    EXPECT_LT(glm::distance(flight.pose().position, rest), 1e-5)
        << "the wall moves who does not want to move";
    EXPECT_LT(glm::distance(before, rest), 0.01);
}

TEST(ColonFlight, TheViewFollowsTheLineAndKeepsWhatTheUserTurned) {
    const AnalyticLumen lumen = torus();
    ColonFlight ahead = flightIn(lumen), back = flightIn(lumen);
    back.turnBy(pi, 0);
    double worst = 0;
    for (int k = 0; k < 400; ++k) {
        ahead.step(wish(1), 0.01);
        back.step(wish(1), 0.01);
        ASSERT_LT(glm::distance(ahead.pose().position, back.pose().position), 1e-6) << k;
        worst = std::max(worst, std::abs(glm::dot(ahead.pose().forward(), back.pose().forward()) + 1));
        const glm::dvec3 p = ahead.pose().position;
        const glm::dvec3 tangent = glm::normalize(glm::dvec3(-p.y, p.x, 0));
        ASSERT_LT(angleTo(ahead, tangent), 0.5) << k;
        // A torus lies in a plane: the head stays upright without anything that levels it.
        ASSERT_NEAR(ahead.pose().up().z, 1, 1e-6) << k;
    }
    EXPECT_LT(worst, 1e-9) << "looking back is looking back all the way";
    EXPECT_GT(glm::distance(ahead.pose().position, lumen.home.position), 0.05);
}

TEST(ColonFlight, TurnsBothWaysInBothModes) {
    for (const int mode : {0, 1}) {
        ColonFlight flight = flightIn(straightTube());
        flight.setMode(mode);
        flight.turnBy(0.5, 0);
        EXPECT_NEAR(anglesOf(flight.pose()).heading, 0.5, 1e-9) << "right is clockwise from above";
        flight.turnBy(-0.5, 0.25);
        EXPECT_NEAR(anglesOf(flight.pose()).pitch, 0.25, 1e-9) << "up";
        flight.turnBy(0, -0.25);
        FlightInput roll;
        roll.rollRate = 0.5;
        fly(flight, roll, 1);
        EXPECT_NEAR(anglesOf(flight.pose()).roll, 0.5 * (1 - 0.08), 1e-4) << "right side down";
        flight.goHome();
        EXPECT_NEAR(anglesOf(flight.pose()).roll, 0, 1e-9) << "home is level";
        flight.turnBy(0, 100);
        EXPECT_NEAR(anglesOf(flight.pose()).pitch, pi / 2, 1e-6);
    }
}

TEST(ColonFlight, StandingStillTheViewStays) {
    ColonFlight flight = flightIn(torus());
    flight.setPose(lookingAlong(flight.pose().position, glm::normalize(glm::dvec3(1, -1, 0.5))));
    const Pose before = flight.pose();
    fly(flight, wish(0), 3);
    EXPECT_EQ(flight.pose().position, before.position);
    EXPECT_GT(std::abs(glm::dot(flight.pose().orientation, before.orientation)), 1 - 1e-12);
}

TEST(ColonFlight, EyesTurnInPlacesTooNarrowForEveryTurn) {
    // A slit: 2 * 3 mm between the walls, eyes 4 mm apart, 2 mm clearance: the head's rule wants 4 mm.
    AnalyticLumen lumen = straightTube();
    lumen.distance = [](const glm::dvec3& p) { return 0.003 - std::abs(p.x); };
    lumen.line = {};
    lumen.home = poseFromAngles({0, 0, 0}, 0, 0, pi / 2);  // the eyes one above the other
    ColonFlight flight = flightIn(lumen);
    EXPECT_EQ(flight.pose().position, glm::dvec3(0));
    EXPECT_EQ(flight.modeCount(), 1);
    fly(flight, wish(1), 2);
    EXPECT_GT(flight.pose().position.y, 0.05) << "the slit is as wide as the eyes need";
    FlightInput roll;
    roll.rollRate = -1;
    for (int k = 0; k < 300; ++k) {
        flight.step(roll, 0.01);
        const Pose pose = flight.pose();
        for (const double side : {-0.002, 0.002})
            ASSERT_GE(lumen.distance(pose.position + side * pose.right()), 0.002 - 1e-12) << k;
    }
    // Each eye may be 1 mm off the middle: sin(60 degrees) of tilt stays, and the roll stops there.
    EXPECT_NEAR(std::abs(flight.pose().right().x), 0.5, 0.1);
}

TEST(ColonFlight, JumpsBetweenSegmentsAndNeverLiesInTissue) {
    const AnalyticLumen lumen = interrupted();
    ColonFlight flight = flightIn(lumen, 0.002);
    glm::dvec3 before = flight.pose().position;
    int jumps = 0;
    for (int k = 0; k < 1000; ++k) {
        flight.step(wish(1), 0.02);
        const glm::dvec3 p = flight.pose().position;
        ASSERT_GE(lumen.distance(p), 0.002) << k;
        if (glm::distance(p, before) > 0.01) ++jumps;
        before = p;
    }
    EXPECT_EQ(jumps, 1);
    EXPECT_GT(before.y, 0.19);
}

TEST(ColonFlight, SaysWhatItKeepsInANarrowPart) {
    const AnalyticLumen lumen = throat(0.0025);
    ColonFlight flight = flightIn(lumen, 0.002);
    EXPECT_EQ(flight.allowedClearance(), 0.002);
    double least = 1;
    for (int k = 0; k < 700; ++k) {
        flight.step(wish(1), 0.01);
        least = std::min(least, flight.allowedClearance());
        ASSERT_GE(flight.clearanceNow(), flight.allowedClearance() - 1e-12) << k;
        ASSERT_GE(flight.clearanceNow(), 0.0005) << k;
    }
    EXPECT_LT(least, 0.0015) << "the throat leaves 1.5 mm beside the eyes";
    EXPECT_GT(flight.pose().position.y, 0.12);
    EXPECT_EQ(flight.allowedClearance(), 0.002);
}

TEST(ColonFlight, PlacesOutsideAreMovedInside) {
    const AnalyticLumen lumen = straightTube();
    for (const int mode : {0, 1}) {
        ColonFlight flight = flightIn(lumen);
        flight.setMode(mode);
        for (const glm::dvec3& p : {glm::dvec3(0.05, 0.1, 0), glm::dvec3(0, -0.1, 0.3),
                                    glm::dvec3(0.019, 0.2, 0), glm::dvec3(1e6, 0, 0)}) {
            flight.setPose({p, lumen.home.orientation});
            EXPECT_GE(flight.clearanceNow(), 0.002 - 1e-12) << p.x << " " << p.y;
        }
        flight.setPose({{0.019, 0.2, 0}, lumen.home.orientation});
        EXPECT_LT(glm::distance(flight.pose().position, glm::dvec3(0.016, 0.2, 0)), 0.001)
            << "no further than needed";
    }
    AnalyticLumen bare = lumen;
    bare.line = {};
    ColonFlight flight = flightIn(bare);
    flight.setPose({{0.025, 0.1, 0.003}, lumen.home.orientation});
    EXPECT_GE(flight.clearanceNow(), 0.002);
    const glm::dvec3 before = flight.pose().position;
    flight.setPose({{5, 5, 5}, lumen.home.orientation});
    EXPECT_EQ(flight.pose().position, before) << "nothing near: stays";
}

TEST(ColonFlight, WithoutALineThereIsOneMode) {
    AnalyticLumen lumen = straightTube();
    for (const std::size_t points : {std::size_t{0}, std::size_t{1}}) {
        lumen.line.points.resize(points);
        ColonFlight flight = flightIn(lumen);
        EXPECT_EQ(flight.modeCount(), 1);
        EXPECT_EQ(flight.mode(), 0);
        EXPECT_EQ(flight.modeName(0), "free");
        EXPECT_EQ(flight.modeName(1), "");
        flight.setMode(1);
        EXPECT_EQ(flight.mode(), 0);
        fly(flight, wish(1), 3);
        EXPECT_GT(flight.pose().position.y, 0.05);
    }
}

TEST(ColonFlight, NonsenseChangesNothing) {
    const FlightInput all{1, 1, 1, 1, 1, 1, 1},
        none{kNotANumber, kNotANumber, kNotANumber, kNotANumber, kNotANumber, kNotANumber, kNotANumber},
        most{kInfinity, -kInfinity, kInfinity, kInfinity, -kInfinity, kInfinity, kInfinity};
    for (const int mode : {0, 1}) {
        ColonFlight flight = flightIn(torus());
        flight.setMode(mode);
        const Pose before = flight.pose();
        for (const double dt : {-1.0, 0.0, kNotANumber, -kInfinity}) flight.step(all, dt);
        flight.step(none, 0.5);
        flight.turnBy(kNotANumber, kNotANumber);
        for (const int unknown : {-1, 2, 77}) flight.setMode(unknown);
        EXPECT_EQ(flight.mode(), mode);
        EXPECT_EQ(flight.pose().position, before.position);
        EXPECT_GT(std::abs(glm::dot(flight.pose().orientation, before.orientation)), 1 - 1e-12);
        for (int k = 0; k < 20; ++k) {
            flight.step(most, kInfinity);
            const Pose pose = flight.pose();
            ASSERT_TRUE(std::isfinite(pose.position.x + pose.position.y + pose.position.z));
            ASSERT_NEAR(glm::length(pose.orientation), 1, 1e-9);
            ASSERT_GE(flight.clearanceNow(), 0.002 - 1e-12);
        }
    }
}

std::string refusal(const std::function<void()>& what) {
    try {
        what();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(ColonFlight, RefusesSettingsThatMeanNothing) {
    const AnalyticLumen lumen = straightTube();
    const auto with = [&](const ColonFlightSetting& setting, Pose home) {
        return refusal([&] { ColonFlight flight(lumen.freeDistance(), lumen.line, home, setting); });
    };
    using testing::HasSubstr;
    EXPECT_THAT(with({0, 0.03, 0}, lumen.home), HasSubstr("clearance: expected a number above 0, got 0"));
    EXPECT_THAT(with({0.002, kNotANumber, 0}, lumen.home),
                HasSubstr("speed: expected a number above 0, got nan"));
    EXPECT_THAT(with({0.002, 0.03, -1}, lumen.home), HasSubstr("expected a number of at least 0, got -1"));
    Pose lost = lumen.home;
    lost.position.x = kNotANumber;
    EXPECT_THAT(with({0.002, 0.03, 0}, lost), HasSubstr("pose: expected finite numbers"));
    EXPECT_EQ(with({0.002, 0.03, 0}, lumen.home), "");
    EXPECT_THAT(with({0.05, 0.03, 0}, lumen.home), HasSubstr("")) << "a clearance that nothing leaves";
    const auto solid = [](const glm::dvec3&, double) { return 0.0; };
    EXPECT_THAT(refusal([&] {
                    ColonFlight(solid, lumen.line, lumen.home, {0.002, 0.03, 0});
                }),
                HasSubstr("start pose: expected room for the eyes"));
    ColonFlight flight = flightIn(lumen);
    EXPECT_THROW(flight.setPose(lost), Error);
}

}  // namespace
}  // namespace stereonav
