// Together 100,000 random steering steps, from 1 to 1,000 ms long: no eye ever comes nearer to the
// wall than the clearance allowed, whatever the lumen.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "tests/support/analytic_lumen.h"
#include "tests/support/stability_row.h"

namespace stereonav {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kShare = 20;  // sanitized, one step in so many
#else
constexpr int kShare = 1;
#endif

constexpr double kRounding = 1e-12;  // metres

double uniform(std::mt19937_64& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

// Keys that are held for a while, both ways, with a wish for speed now and then, and nonsense.
void changeWish(FlightInput& input, std::mt19937_64& random) {
    const auto key = [&] { return random() % 3 == 0 ? 0.0 : uniform(random, -1.3, 1.3); };
    switch (random() % 8) {
        case 0:
            input.forward = key();
            break;
        case 1:
            input.forward = random() % 4 == 0 ? -1 : 1;
            break;
        case 2:
            input.right = key();
            break;
        case 3:
            input.up = key();
            break;
        case 4:
            input.yawRate = 3 * key();
            break;
        case 5:
            input.pitchRate = 3 * key();
            break;
        case 6:
            input.rollRate = 3 * key();
            break;
        default:
            input.speedMultiplier = random() % 50 == 0 ? 1e9 : random() % 4 == 0 ? uniform(random, 0, 8) : 1;
    }
    if (random() % 997 == 0) input.forward = std::numeric_limits<double>::quiet_NaN();
    if (random() % 997 == 0) input = {};
}

struct Seen {
    double leastFree = 1e9;     // metres, of an eye
    double leastOver = 1e9;     // metres above the clearance allowed
    double leastAllowed = 1e9;  // metres
    double travelled = 0, seconds = 0;
};

// Both eyes and the head by the lumen's own distance.
double freeOfEyes(const AnalyticLumen& lumen, const Pose& pose, double half) {
    double least = lumen.distance(pose.position);
    for (const double side : {-half, half})
        least = std::min(least, lumen.distance(pose.position + side * pose.right()));
    return least;
}

void steer(ColonFlight& flight, const FlightInput& input, double dt, std::mt19937_64& random) {
    if (random() % 40 == 0) flight.turnBy(uniform(random, -2, 2), uniform(random, -1, 1));
    if (random() % 300 == 0) flight.setMode(static_cast<int>(random() % 2));
    if (random() % 5000 == 0) flight.goHome();
    if (random() % 2000 == 0) {
        Pose pose = flight.pose();
        for (int axis = 0; axis < 3; ++axis) pose.position[axis] += uniform(random, -0.03, 0.03);
        flight.setPose(pose);
    }
    flight.step(input, dt);
}

Seen steerAtRandom(const AnalyticLumen& lumen, const ColonFlightSetting& setting, int steps,
                   bool longSteps = false, const std::string& id = "") {
    ColonFlight flight(lumen.freeDistance(), lumen.line, lumen.home, setting);
    std::mt19937_64 random(42);
    FlightInput input;
    Seen seen;
    test::StabilityRow row("clearance/" + (id.empty() ? lumen.name : id),
                           lumen.name + ", steered at random in steps of 1 ms to 1 s",
                           "an eye nearer to the wall than allowed", kRounding, "m");
    const auto start = std::chrono::steady_clock::now();
    steps /= kShare;
    for (int k = 0; k < steps; ++k) {
        const double dt = longSteps ? uniform(random, 0.001, 1) : std::pow(10.0, uniform(random, -3, 0));
        if (random() % 3 == 0) changeWish(input, random);
        const glm::dvec3 before = flight.pose().position;
        steer(flight, input, dt, random);
        const Pose pose = flight.pose();
        const double free = freeOfEyes(lumen, pose, setting.largestSeparation / 2);
        const double allowed = flight.allowedClearance();
        seen.travelled += glm::distance(before, pose.position);
        seen.leastFree = std::min(seen.leastFree, free);
        seen.leastAllowed = std::min(seen.leastAllowed, allowed);
        seen.leastOver = std::min(seen.leastOver, free - allowed);
        row.saw(allowed - free);
        EXPECT_GE(free, allowed - kRounding) << lumen.name << ", step " << k << " of " << dt << " s";
        EXPECT_LT(std::abs(glm::length(pose.orientation) - 1), 1e-9) << lumen.name << ", step " << k;
        if (testing::Test::HasFailure()) break;
    }
    seen.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::printf(
        "%-24s eyes %.1f mm apart: %d steps, %.0f m flown; nearest to the wall %.4f mm, asked for %.4f, "
        "least allowed %.4f; %.1f s\n",
        lumen.name.c_str(), setting.largestSeparation * 1e3, steps, seen.travelled, seen.leastFree * 1e3,
        setting.clearance * 1e3, seen.leastAllowed * 1e3, seen.seconds);
    return seen;
}

TEST(ColonFlightClearance, IsKeptInTubes) {
    for (const AnalyticLumen& lumen : {straightTube(), torus(), flexure()}) {
        const Seen seen = steerAtRandom(lumen, {0.002, 0.03, 0.004}, 20000);
        EXPECT_EQ(seen.leastAllowed, 0.002) << lumen.name;
        EXPECT_GE(seen.leastFree, 0.002 - kRounding) << lumen.name;
        EXPECT_LT(seen.leastFree, 0.0025) << lumen.name << ": the wall was never come near to";
    }
}

TEST(ColonFlightClearance, IsKeptAtNarrowFolds) {
    const Seen seen = steerAtRandom(foldedTube(), {0.002, 0.03, 0.003}, 15000);
    EXPECT_LT(seen.leastFree, 0.0025) << "the wall was never come near to";
}

TEST(ColonFlightClearance, IsKeptInLongSteps) {
    steerAtRandom(foldedTube(0.02, 0.008), {0.002, 0.03, 0.004}, 5000, true, "long steps");
}

TEST(ColonFlightClearance, NeverReachesTheWallWhereTheLumenIsNarrower) {
    for (const double least : {0.004, 0.0025, 0.001}) {
        const AnalyticLumen lumen = throat(least);
        const Seen seen = steerAtRandom(lumen, {0.003, 0.03, 0.002}, 5000, false,
                                        "throat " + test::shortNumber(1e3 * least) + " mm");
        EXPECT_GT(seen.leastFree, 0.2 * 0.8 * 0.003) << least;
    }
}

TEST(ColonFlightClearance, IsKeptBetweenSegments) {
    const Seen seen = steerAtRandom(interrupted(), {0.002, 0.03, 0.002}, 10000);
    EXPECT_GE(seen.leastFree, 0.002 - kRounding);
}

// Poses are checked above; this checks the way between them: a wall without thickness across the tube.
TEST(ColonFlightClearance, AThinWallIsNeverPassed) {
    AnalyticLumen lumen = straightTube();
    lumen.distance = [tube = lumen.distance](const glm::dvec3& p) {
        return std::min(tube(p), std::abs(p.y - 0.1));
    };
    for (const int mode : {0, 1}) {
        ColonFlight flight(lumen.freeDistance(), lumen.line, lumen.home, {0.0005, 0.03, 0.004});
        flight.setMode(mode);
        std::mt19937_64 random(7);
        FlightInput input;
        double farthest = 0;
        for (int k = 0; k < 2000 / kShare; ++k) {
            changeWish(input, random);
            // Guided, the flight jumps to the line's other part when it is asked to go there.
            if (mode == 0) input.forward = std::min(input.forward, 0.0);
            if (random() % 2) input.speedMultiplier = ColonFlight::kMostMultiplier;
            flight.step(input, uniform(random, 0.001, 1));
            const Pose pose = flight.pose();
            for (const double side : {-0.002, 0.0, 0.002}) {
                const double y = pose.position.y + side * pose.right().y;
                ASSERT_LT(y, 0.1) << "mode " << mode << ", step " << k;
                farthest = std::max(farthest, y);
            }
        }
        if (mode == 1) {
            EXPECT_GT(farthest, 0.099) << "the wall was never come near to";
        }
    }
}

}  // namespace
}  // namespace stereonav
