// Flights through keyframes: smooth, through each of them, of any signs and times; and keyframes of a flight.
#include "engine/camera/keyframes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "engine/base/error.h"

namespace stereonav {
namespace {

double keyTurn(const Pose& a, const Pose& b) {
    const glm::dquat turn = glm::conjugate(a.orientation) * b.orientation;
    return 2 * std::asin(std::min(1.0, glm::length(glm::dvec3(turn.x, turn.y, turn.z))));
}

double keyWay(const Pose& a, const Pose& b) {
    return glm::distance(a.position, b.position);
}

Keyframes someKeyframes(unsigned seed, int count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    Keyframes keys;
    double time = 3;
    for (int k = 0; k < count; ++k) {
        Pose pose = poseFromAngles({50 * unit(random), 50 * unit(random), 5 * unit(random)}, 3 * unit(random),
                                   unit(random), 0.3 * unit(random));
        if (k % 2) pose.orientation = -pose.orientation;
        keys.push_back({time, pose});
        time += 1.5 + unit(random);
    }
    return keys;
}

TEST(KeyframeFlight, GoesThroughEachKeyframeAtItsTime) {
    for (const bool ease : {true, false}) {
        const Keyframes keys = someKeyframes(1, 9);
        const RecordedPath path = pathThrough(keys, ease);
        EXPECT_EQ(path.startTime(), 3);
        for (const PathSample& key : keys) {
            EXPECT_LT(keyWay(path.at(key.time), key.pose), 1e-9);
            EXPECT_LT(keyTurn(path.at(key.time), key.pose), 1e-7);
        }
        for (std::size_t k = 1; k < path.samples().size(); ++k)
            EXPECT_GT(path.samples()[k].time, path.samples()[k - 1].time);
    }
}

TEST(KeyframeFlight, SpeedsHaveNoSteps) {
    for (unsigned seed = 1; seed < 20; ++seed) {
        const Keyframes keys = someKeyframes(seed, 8);
        const KeyframeCurve curve(keys, true);
        constexpr double h = 1e-6;  // step within a turn as sharp as a hand
        for (const PathSample& key : keys) {
            const Pose here = curve.at(key.time), before = curve.at(key.time - h),
                       after = curve.at(key.time + h);
            const glm::dvec3 slow = (here.position - before.position) / h,
                             fast = (after.position - here.position) / h;
            if (key.time == keys.front().time || key.time == keys.back().time) continue;
            EXPECT_LT(glm::distance(slow, fast), 0.03 * (1 + glm::length(slow))) << seed;
            EXPECT_NEAR(keyTurn(here, before) / h, keyTurn(here, after) / h, 0.02) << seed;
        }
        EXPECT_LT(keyWay(curve.at(curve.startTime()), curve.at(curve.startTime() + 0.001)), 1e-3) << "eased";
        EXPECT_LT(keyTurn(curve.at(curve.endTime()), curve.at(curve.endTime() - 0.001)), 1e-4);
    }
}

TEST(KeyframeFlight, IsEvenWhereKeyframesAreEvenlyTimed) {
    // Far apart, near and far apart again on a line, at an even speed: the flight keeps it.
    Keyframes keys;
    for (const double x : {0.0, 10.0, 11.0, 12.0, 40.0, 41.0, 60.0})
        keys.push_back({x / 2, poseFromAngles({x, 0, 0}, 0, 0, 0)});
    const KeyframeCurve curve(keys, false);
    for (double t = 0; t < 29.9; t += 0.1)
        EXPECT_NEAR(keyWay(curve.at(t), curve.at(t + 0.1)), 0.2, 0.002) << t;
}

// Keyframes of an even acceleration, unevenly timed: through the middle one the flight goes, and turns, as
// fast as it does. The difference over both sides, each weighted by the time of the other, is exact for
// parabolas.
TEST(KeyframeFlight, GoesAndTurnsThroughAKeyframeAsFastAsItsNeighboursSay) {
    const auto poseAt = [](double t) { return poseFromAngles({3 * t * t, 0, 0}, 0.1 * t * t, 0, 0); };
    for (const auto& [before, after] : {std::pair(1.0, 1.0), {1.0, 2.0}, {2.0, 1.0}, {0.5, 1.75}}) {
        const double first = 4 - before, last = 4 + after;
        const KeyframeCurve curve({{first, poseAt(first)}, {4, poseAt(4)}, {last, poseAt(last)}}, false);
        constexpr double h = 1e-4;
        EXPECT_NEAR(keyWay(curve.at(4 - h), curve.at(4 + h)) / (2 * h), 2 * 3 * 4.0, 1e-2) << before;
        EXPECT_NEAR(keyTurn(curve.at(4 - h), curve.at(4 + h)) / (2 * h), 2 * 0.1 * 4.0, 1e-3) << before;
        // At the ends it keeps the mean of its piece.
        EXPECT_NEAR(keyWay(curve.at(first), curve.at(first + h)) / h, 3 * (4 + first), 1e-1) << before;
        EXPECT_NEAR(keyWay(curve.at(last - h), curve.at(last)) / h, 3 * (4 + last), 1e-1) << before;
    }
}

TEST(KeyframeFlight, NeverTurnsBackOnALineAndStopsWhereKeyframesAreEqual) {
    Keyframes keys;
    const double places[] = {0, 1, 1, 1, 100, 101, 101, 300};
    for (int k = 0; k < 8; ++k)
        keys.push_back({k * 1.0, poseFromAngles({places[k], 0, 0}, 0.2 * (k > 2), 0, 0)});
    const KeyframeCurve curve(keys, true);
    double before = -1;
    for (double t = 0; t <= 7; t += 0.003) {
        const double x = curve.at(t).position.x;
        EXPECT_GE(x, before - 1e-12) << t;
        before = x;
    }
    EXPECT_NEAR(curve.at(1.5).position.x, 1, 1e-12);
    EXPECT_NEAR(curve.at(5.5).position.x, 101, 1e-12);
    EXPECT_NEAR(curve.length(), 300, 1e-9);
    // No overshoot of the turn, which takes one step.
    for (double t = 0; t <= 7; t += 0.003) {
        const double heading = anglesOf(curve.at(t)).heading;
        EXPECT_TRUE(heading < 0.2 + 1e-9 || heading > 2 * std::numbers::pi - 1e-9) << t << " " << heading;
    }
}

TEST(KeyframeFlight, OfTheFewestAndOfWhatIsNone) {
    const Pose a = poseFromAngles({0, 0, 0}, 0, 0, 0), b = poseFromAngles({0, 0, 9}, 1, 0, 0);
    const RecordedPath two = pathThrough({{0, a}, {2, b}});
    EXPECT_LT(keyWay(two.at(1), poseFromAngles({0, 0, 4.5}, 0, 0, 0)), 1e-9);
    EXPECT_NEAR(anglesOf(two.at(1)).heading, 0.5, 1e-9);
    const RecordedPath equal = pathThrough({{0, a}, {2, a}, {3, a}});
    for (const PathSample& sample : equal.samples()) {
        EXPECT_EQ(sample.pose.position, a.position);
        EXPECT_LT(keyTurn(sample.pose, a), 1e-9);
    }
    EXPECT_THROW(pathThrough({}), Error);
    EXPECT_THROW(pathThrough({{0, a}}), Error);
    EXPECT_THROW(pathThrough({{0, a}, {0, b}}), Error);
    EXPECT_THROW(pathThrough({{1, a}, {0, b}}), Error);
    EXPECT_THROW(pathThrough({{0, a}, {std::nan(""), b}}), Error);
    Pose bad = b;
    bad.position.x = std::nan("");
    EXPECT_THROW(pathThrough({{0, a}, {1, bad}}), Error);
    bad = b;
    bad.orientation = glm::dquat(0, 0, 0, 0);
    EXPECT_THROW(pathThrough({{0, a}, {1, bad}}), Error);
    // Opposite signs of one rotation are no turn; a half turn is one.
    Pose minus = a;
    minus.orientation = -minus.orientation;
    const RecordedPath signs = pathThrough({{0, a}, {1, minus}, {2, a}});
    for (const PathSample& sample : signs.samples()) EXPECT_LT(keyTurn(sample.pose, a), 1e-7);
    const RecordedPath half = pathThrough({{0, a}, {1, poseFromAngles({0, 0, 0}, std::numbers::pi, 0, 0)}});
    EXPECT_NEAR(keyTurn(half.at(0.5), a), std::numbers::pi / 2, 1e-6);
}

TEST(KeyframeFlight, OfTinyAndOfHugeTimes) {
    const Pose a = poseFromAngles({0, 0, 0}, 0, 0, 0), b = poseFromAngles({1e6, 0, 0}, 1, 0, 0);
    for (const double seconds : {1e-12, 1e-3, 1e5, 1e15}) {
        const RecordedPath path = pathThrough({{0, a}, {seconds, b}, {3 * seconds, a}});
        EXPECT_LE(path.samples().size(), 1'000'002u);
        EXPECT_NEAR(path.duration(), 3 * seconds, 1e-9 * seconds);
        for (std::size_t k = 0; k < path.samples().size(); k += 97)
            ASSERT_TRUE(
                std::isfinite(path.samples()[k].pose.position.x + path.samples()[k].pose.orientation.w));
    }
    const RecordedPath early = pathThrough({{-1e9, a}, {-1e9 + 1, b}});
    EXPECT_EQ(early.startTime(), -1e9);
}

TEST(KeyframeList, InsertsAndRemoves) {
    const Pose a = poseFromAngles({0, 0, 0}, 0, 0, 0), b = poseFromAngles({1, 0, 0}, 0, 0, 0);
    Keyframes keys;
    EXPECT_EQ(insertKeyframe(keys, {2, a}), 0u);
    EXPECT_EQ(insertKeyframe(keys, {5, a}), 1u);
    EXPECT_EQ(insertKeyframe(keys, {3, b}), 1u);
    EXPECT_EQ(insertKeyframe(keys, {-1, a}), 0u);
    EXPECT_EQ(keys[2].pose.position, b.position);
    const Keyframes before = keys;
    EXPECT_THROW(insertKeyframe(keys, {std::nan(""), a}), Error);
    EXPECT_THROW(insertKeyframe(keys, {5, a}), Error);
    EXPECT_THROW(removeKeyframe(keys, 4), Error);
    ASSERT_EQ(keys.size(), before.size());
    for (std::size_t k = 0; k < keys.size(); ++k) EXPECT_EQ(keys[k].time, before[k].time);
    removeKeyframe(keys, 0);
    EXPECT_EQ(keys.front().time, 2);
    EXPECT_EQ(keys.size(), 3u);
}

TEST(KeyframeList, TimesByTheWayAndTheTurn) {
    const std::vector<Pose> poses{poseFromAngles({0, 0, 0}, 0, 0, 0), poseFromAngles({30, 0, 0}, 0, 0, 0),
                                  poseFromAngles({30, 0, 0}, 1, 0, 0), poseFromAngles({30, 0, 0}, 1, 0, 0)};
    const Keyframes keys = timedKeyframes(poses, 10);
    ASSERT_EQ(keys.size(), 4u);
    EXPECT_EQ(keys[0].time, 0);
    EXPECT_NEAR(keys[1].time, 3, 1e-9);
    EXPECT_NEAR(keys[2].time, 5, 1e-6);
    EXPECT_NEAR(keys[3].time, 5.1, 1e-6);
    EXPECT_TRUE(timedKeyframes({}, 1).empty());
    for (const double bad : {0.0, -1.0, std::nan("")}) EXPECT_THROW(timedKeyframes(poses, bad), Error);
}

TEST(KeyframesOfAPath, AreFewAndWithinTheError) {
    std::vector<PathSample> list;
    for (int k = 0; k <= 1800; ++k) {
        const double t = k / 60.0, way = 0.2 * t + 0.3 * std::sin(0.5 * t);
        Pose pose = poseFromAngles({200 * std::sin(way), 200 * std::cos(way), 20 * std::sin(0.4 * t)},
                                   way + 1.5, 0.1 * std::sin(t), 0);
        if (k % 3) pose.orientation = -pose.orientation;
        list.push_back({10 + t, pose});
    }
    const RecordedPath path(list, "test");
    std::size_t before = list.size();
    for (const auto& [metres, degrees] : {std::pair(0.05, 0.1), {0.5, 1.0}, {5.0, 10.0}}) {
        const double radians = degrees * std::numbers::pi / 180;
        const Keyframes keys = keyframesOf(path, metres, radians);
        EXPECT_LT(keys.size(), before);
        before = keys.size();
        const KeyframeCurve curve(keys, false);
        for (const PathSample& sample : path.samples()) {
            ASSERT_LE(keyWay(curve.at(sample.time), sample.pose), metres);
            ASSERT_LE(keyTurn(curve.at(sample.time), sample.pose), radians);
        }
        EXPECT_EQ(keys.front().time, 10);
        EXPECT_EQ(keys.back().time, 40);
    }
    EXPECT_LT(before, 25u);
}

TEST(KeyframesOfAPath, OfNoiseAreAllOfThem) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::vector<PathSample> list;
    for (int k = 0; k < 300; ++k)
        list.push_back(
            {k / 60.0, poseFromAngles({unit(random), unit(random), unit(random)}, unit(random), 0, 0)});
    EXPECT_GT(keyframesOf(RecordedPath(list, "test"), 1e-9, 1e-9).size(), 290u);
    const Pose a;
    EXPECT_EQ(keyframesOf(RecordedPath({{0, a}, {1, a}, {2, a}}, "test"), 1e-9, 1e-9).size(), 2u);
    EXPECT_THROW(keyframesOf(RecordedPath(), 1, 1), Error);
    for (const double bad : {0.0, -1.0, std::nan("")}) {
        EXPECT_THROW(keyframesOf(RecordedPath({{0, a}, {1, a}}, "test"), bad, 1), Error);
        EXPECT_THROW(keyframesOf(RecordedPath({{0, a}, {1, a}}, "test"), 1, bad), Error);
    }
}

}  // namespace
}  // namespace stereonav
