// Edited paths: parts, smoothing and an even pace, of flights, of the shortest paths and of what is no path.
#include "engine/camera/path_edit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "engine/base/error.h"

namespace stereonav {
namespace {

using PoseAt = std::function<Pose(double)>;

RecordedPath recorded(double from, double seconds, int samples, const PoseAt& at) {
    std::vector<PathSample> list;
    for (int k = 0; k < samples; ++k) {
        const double t = seconds * k / (samples - 1);
        list.push_back({from + t, at(t)});
    }
    return RecordedPath(std::move(list), "test");
}

double turned(const Pose& a, const Pose& b) {
    const glm::dquat turn = glm::conjugate(a.orientation) * b.orientation;
    return 2 * std::asin(std::min(1.0, glm::length(glm::dvec3(turn.x, turn.y, turn.z))));
}

double apart(const Pose& a, const Pose& b) {
    return glm::distance(a.position, b.position);
}

// Returns a pose on a flight along a circle of 100 m, slow, fast and with a pause in the middle, turning with
// it.
Pose unevenCircle(double t) {
    const double way = t < 4 ? 0.02 * t * t : t < 7 ? 0.32 : 0.32 + 0.3 * (t - 7);
    return poseFromAngles({100 * std::sin(way), 100 * std::cos(way), 5}, way + 1.5, -0.1, 0);
}

double wayOf(const RecordedPath& path) {
    double way = 0;
    for (std::size_t k = 1; k < path.samples().size(); ++k)
        way += apart(path.samples()[k].pose, path.samples()[k - 1].pose);
    return way;
}

TEST(TrimmedPath, IsThatPart) {
    const RecordedPath path = recorded(3, 10, 601, unevenCircle), part = trimmed(path, 2.005, 8.5);
    EXPECT_EQ(part.startTime(), 0);
    EXPECT_NEAR(part.duration(), 6.495, 1e-12);
    for (double t = 0; t <= 6.495; t += 0.01) {
        EXPECT_LT(apart(part.at(t), path.at(3 + 2.005 + t)), 1e-9) << t;
        EXPECT_LT(turned(part.at(t), path.at(3 + 2.005 + t)), 1e-7) << t;
    }
    EXPECT_NEAR(trimmed(path, -5, 100).duration(), 10, 1e-12);
    EXPECT_NEAR(trimmed(path, 9.9999, 10).duration(), 1e-4, 1e-12);
    EXPECT_EQ(trimmed(path, 0.001, 0.002).samples().size(), 2u);
}

TEST(TrimmedPath, RefusesWhatIsNoPart) {
    const RecordedPath path = recorded(0, 10, 11, unevenCircle);
    const double inf = std::numeric_limits<double>::infinity();
    EXPECT_THROW(trimmed(path, 5, 5), Error);
    EXPECT_THROW(trimmed(path, 6, 5), Error);
    EXPECT_THROW(trimmed(path, 10, 12), Error);
    EXPECT_THROW(trimmed(path, -2, 0), Error);
    for (const double bad : {std::nan(""), inf, -inf}) {
        EXPECT_THROW(trimmed(path, bad, 5), Error);
        EXPECT_THROW(trimmed(path, 1, bad), Error);
    }
    EXPECT_THROW(trimmed(RecordedPath(), 0, 1), Error);
}

TEST(SmoothedPath, KeepsItsEndsItsDurationAndStraightFlights) {
    const auto straight = [](double t) { return poseFromAngles({3 * t, -t, 2}, 0.2 * t, 0, 0); };
    for (const double seconds : {0.01, 0.3, 2.0, 1e6}) {
        const RecordedPath path = recorded(1, 10, 301, straight), smooth = smoothed(path, seconds);
        EXPECT_EQ(smooth.startTime(), 0);
        EXPECT_NEAR(smooth.duration(), 10, 1e-9);
        EXPECT_EQ(smooth.samples().front().pose.position, path.samples().front().pose.position);
        EXPECT_EQ(smooth.samples().back().pose.position, path.samples().back().pose.position);
        for (double t = 0; t <= 10; t += 0.05) {
            EXPECT_LT(apart(smooth.at(t), path.at(1 + t)), 1e-6) << seconds << " " << t;
            EXPECT_LT(turned(smooth.at(t), path.at(1 + t)), 5e-4) << seconds << " " << t;
        }
    }
}

// A sine keeps exp(-(w sigma)^2 / 2) of its height under a Gaussian; four boxes are within 3 % of that.
TEST(SmoothedPath, IsAGaussian) {
    for (const double seconds : {0.1, 0.5, 1.0}) {
        const auto wave = [](double t) {
            return poseFromAngles({t, std::sin(2 * t), 0}, 0.1 * std::sin(2 * t), 0, 0);
        };
        const RecordedPath smooth = smoothed(recorded(0, 20 * std::numbers::pi, 6001, wave), seconds);
        const double kept = std::exp(-2 * seconds * seconds);
        for (double t = 10; t < 50; t += 0.37) {
            const Pose pose = smooth.at(t);
            EXPECT_NEAR(pose.position.y, kept * std::sin(2 * t), 0.032) << seconds << " " << t;
            EXPECT_NEAR(std::remainder(anglesOf(pose).heading, 2 * std::numbers::pi),
                        0.1 * kept * std::sin(2 * t), 0.0032);
        }
    }
}

TEST(SmoothedPath, QuartersNoiseAndKnowsNoSigns) {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0, 0.01);
    std::vector<PathSample> list;
    for (int k = 0; k < 1200; ++k) {
        Pose pose = poseFromAngles({k / 60.0 + noise(random), noise(random), noise(random)},
                                   0.01 * k + noise(random), noise(random), 0);
        if (random() % 2) pose.orientation = -pose.orientation;
        list.push_back({k / 60.0, pose});
    }
    const RecordedPath smooth = smoothed(RecordedPath(list, "test"), 0.3);
    double most = 0, mostTurn = 0;
    for (int k = 60; k < 1140; ++k) {
        const Pose wanted = poseFromAngles({k / 60.0, 0, 0}, 0.01 * k, 0, 0);
        most = std::max(most, apart(smooth.at(k / 60.0), wanted));
        mostTurn = std::max(mostTurn, turned(smooth.at(k / 60.0), wanted));
    }
    EXPECT_LT(most, 0.0075);
    EXPECT_LT(mostTurn, 0.0075);
}

TEST(SmoothedPath, OfTwoPosesAndOfEqualOnes) {
    const RecordedPath two(
        {{0, poseFromAngles({0, 0, 0}, 0, 0, 0)}, {1e-9, poseFromAngles({1, 0, 0}, 3, 0, 0)}}, "test");
    EXPECT_LT(apart(smoothed(two, 1).samples().back().pose, two.samples().back().pose), 1e-12);
    const RecordedPath still = recorded(5, 1e7, 50, [](double) {
        return poseFromAngles({1, 2, 3}, 1, 1, 1);
    });
    const RecordedPath smooth = smoothed(still, 100);
    EXPECT_LE(smooth.samples().size(), 100'001u);
    for (const PathSample& sample : smooth.samples()) {
        ASSERT_LT(apart(sample.pose, still.samples()[0].pose), 1e-9);
        ASSERT_LT(turned(sample.pose, still.samples()[0].pose), 1e-7);
    }
    EXPECT_EQ(smoothed(two, 0).samples().size(), 2u);
    for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()})
        EXPECT_THROW(smoothed(two, bad), Error);
    EXPECT_THROW(smoothed(RecordedPath(), 1), Error);
}

// Two straight stretches with a jump of 10 m between them within half a millisecond.
RecordedPath cutPath() {
    std::vector<PathSample> list;
    for (int k = 0; k <= 100; ++k) list.push_back({k / 10.0, poseFromAngles({0, k / 100.0, 0}, 0, 0, 0)});
    for (int k = 0; k <= 100; ++k)
        list.push_back({10.0005 + k / 10.0, poseFromAngles({10, k / 50.0, 0}, 1, 0, 0)});
    return RecordedPath(list, "test");
}

TEST(EditedPaths, CutsStayCut) {
    const RecordedPath path = cutPath();
    for (const RecordedPath& edited : {smoothed(path, 1), evenlyPaced(path), evenlyPaced(path, 0.5)}) {
        double between = 0;
        for (std::size_t k = 1; k < edited.samples().size(); ++k) {
            const double ax = edited.samples()[k - 1].pose.position.x,
                         bx = edited.samples()[k].pose.position.x;
            if (ax != bx) between += edited.samples()[k].time - edited.samples()[k - 1].time;
        }
        EXPECT_NEAR(between, 0.0005, 1e-9);
    }
    EXPECT_NEAR(evenlyPaced(path).duration(), path.duration(), 1e-6);
    EXPECT_NEAR(evenlyPaced(path, 0.5).duration(), 6.0005, 1e-6) << "3 m at half a metre a second";
}

TEST(EvenPace, IsEvenAlongTheSameWay) {
    const RecordedPath path = recorded(2, 12, 1201, unevenCircle), even = evenlyPaced(path);
    EXPECT_EQ(even.startTime(), 0);
    EXPECT_NEAR(even.duration(), 12, 1e-6);
    EXPECT_NEAR(wayOf(even), wayOf(path), 0.01);
    const double speed = wayOf(path) / 12;
    for (double t = 0; t + 0.1 <= 12; t += 0.1)
        EXPECT_NEAR(apart(even.at(t), even.at(t + 0.1)), 0.1 * speed, 0.002 * speed) << t;
    for (const PathSample& sample : even.samples()) {
        EXPECT_NEAR(glm::length(glm::dvec2(sample.pose.position)), 100, 0.01);
        // The view goes with the place.
        const double way = std::atan2(sample.pose.position.x, sample.pose.position.y);
        EXPECT_NEAR(std::remainder(anglesOf(sample.pose).heading - way - 1.5, 2 * std::numbers::pi), 0, 1e-6);
    }
    EXPECT_EQ(even.samples().back().pose.position, path.samples().back().pose.position);
    EXPECT_NEAR(evenlyPaced(path, 20).duration(), wayOf(path) / 20, 0.01);
}

TEST(EvenPace, TurningWhileStandingKeepsItsTime) {
    const auto at = [](double t) {
        const double way = t < 3 ? t : t < 8 ? 3 : 3 + 4 * (t - 8);
        return poseFromAngles({way, 0, 0}, t < 3 ? 0 : t < 8 ? 0.3 * (t - 3) : 1.5, 0, 0);
    };
    const RecordedPath path = recorded(0, 10, 1001, at);  // 11 m, of which 5 s of turning
    const RecordedPath even = evenlyPaced(path, 1.0);
    EXPECT_NEAR(even.duration(), 11 + 5, 0.05);
    EXPECT_NEAR(evenlyPaced(path).duration(), 10, 1e-6);
    double fastest = 0;
    for (std::size_t k = 1; k < even.samples().size(); ++k)
        fastest = std::max(fastest, turned(even.samples()[k].pose, even.samples()[k - 1].pose) /
                                        (even.samples()[k].time - even.samples()[k - 1].time));
    EXPECT_NEAR(fastest, 0.3, 0.01);
}

TEST(EvenPace, ATurnWhileMovingIsNotHurried) {
    // Almost standing (2 % of the pace) while it turns by 2 radians.
    const auto at = [](double t) {
        const double way = t < 4 ? 0.02 * t : 0.08 + (t - 4);
        return poseFromAngles({way, 0, 0}, t < 4 ? 0.5 * t : 2, 0, 0);
    };
    const RecordedPath even = evenlyPaced(recorded(0, 8, 801, at), 1.0);
    EXPECT_GE(even.duration(), 2 + 4 - 0.05) << "2 radians at one a second, then 4 m";
    EXPECT_LE(even.duration(), 2 + 4 + 0.1);
}

TEST(EvenPace, OfPathsThatDoNotMove) {
    const RecordedPath still = recorded(1, 4, 5, [](double) { return Pose(); });
    EXPECT_NEAR(evenlyPaced(still).duration(), 4, 1e-12);
    const RecordedPath turning = recorded(0, 4, 5, [](double t) {
        return poseFromAngles({0, 0, 0}, t, 0, 0);
    });
    EXPECT_NEAR(evenlyPaced(turning, 3).duration(), 4, 1e-12);
    const RecordedPath two({{0, Pose()}, {1e9, Pose{{1, 0, 0}, glm::dquat(1, 0, 0, 0)}}}, "test");
    EXPECT_NEAR(evenlyPaced(two, 1).duration(), 1, 1e-9);
    EXPECT_NEAR(evenlyPaced(two).duration(), 1e9, 1);
    for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
        EXPECT_THROW(evenlyPaced(two, bad), Error);
    EXPECT_THROW(evenlyPaced(RecordedPath()), Error);
}

}  // namespace
}  // namespace stereonav
