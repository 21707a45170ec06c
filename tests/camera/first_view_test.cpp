// Where a viewer begins before an object: all of it in the picture, from a side that shows it.
#include "engine/camera/first_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/base/parallel.h"
#include "engine/math/constants.h"

namespace stereonav {
namespace {

constexpr double kFov = 40 * kRadians;

// A box of samples on its faces.
std::vector<SurfaceSample> boxOf(const glm::dvec3& half, const glm::dvec3& middle = glm::dvec3(0.0)) {
    constexpr int kSteps = 24;
    std::vector<SurfaceSample> samples;
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {-1, 1})
            for (int j = 0; j <= kSteps; ++j)
                for (int i = 0; i <= kSteps; ++i) {
                    glm::dvec3 at(0.0);
                    at[axis] = side;
                    at[(axis + 1) % 3] = 2.0 * i / kSteps - 1;
                    at[(axis + 2) % 3] = 2.0 * j / kSteps - 1;
                    glm::vec3 normal(0.0f);
                    normal[axis] = static_cast<float>(side);
                    samples.push_back({middle + half * at, normal});
                }
    return samples;
}
std::vector<SurfaceSample> ballOf(double radius, const glm::dvec3& middle) {
    std::vector<SurfaceSample> samples;
    for (int j = 0; j <= 60; ++j)
        for (int i = 0; i < 120; ++i) {
            const double tilt = kPi * j / 60, turn = 2 * kPi * i / 120;
            const glm::dvec3 normal(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn),
                                    std::cos(tilt));
            samples.push_back({middle + radius * normal, glm::vec3(normal)});
        }
    return samples;
}

// What a picture shows of the samples, in halves of its height from the middle.
struct Shown {
    glm::dvec2 low{kInfinity}, high{-kInfinity};
    double nearest = kInfinity;
    double longer() const { return 0.5 * std::max(high.x - low.x, high.y - low.y); }
};
Shown shownFrom(const Pose& pose, const std::vector<SurfaceSample>& samples) {
    Shown shown;
    for (const SurfaceSample& sample : samples) {
        const glm::dvec3 away = sample.place - pose.position;
        const double deep = glm::dot(away, pose.forward()), half = deep * std::tan(0.5 * kFov);
        const glm::dvec2 at(glm::dot(away, pose.right()) / half, glm::dot(away, pose.up()) / half);
        shown.low = glm::min(shown.low, at);
        shown.high = glm::max(shown.high, at);
        shown.nearest = std::min(shown.nearest, deep);
    }
    return shown;
}

ViewWanted wantedOf(double aspect, double front = 0) {
    ViewWanted wanted;
    wanted.verticalFov = kFov;
    wanted.aspect = aspect;
    wanted.front = front;
    return wanted;
}

TEST(FirstView, FillsTheShorterSideAndLiesInTheMiddle) {
    for (const double aspect : {16.0 / 9, 1.0, 0.4})
        for (const auto& samples : {boxOf({1, 2, 0.5}), boxOf({0.001, 0.001, 0.003}, {5, 6, 7}),
                                    ballOf(100, {1e5, -1e5, 50}), boxOf({1, 1, 0})}) {
            const std::optional<FirstView> view = firstViewOf(samples, wantedOf(aspect));
            ASSERT_TRUE(view);
            const Shown shown = shownFrom(view->pose(), samples);
            EXPECT_NEAR(shown.longer() / std::min(1.0, aspect), kFirstFill, 0.02) << aspect;
            EXPECT_NEAR(shown.low.x + shown.high.x, 0, 0.03);
            EXPECT_NEAR(shown.low.y + shown.high.y, 0, 0.03);
            EXPECT_GT(shown.nearest, 0);
            EXPECT_NEAR(view->pose().right().z, 0, 1e-12) << "upright";
        }
}

TEST(FirstView, IsFromTheSideThatShowsMost) {
    // A board: from its edge next to nothing is seen.
    const std::optional<FirstView> east = firstViewOf(boxOf({0.02, 1, 1}), wantedOf(1));
    ASSERT_TRUE(east);
    EXPECT_GT(std::abs(east->pose().forward().x), 0.6);
    const std::optional<FirstView> north = firstViewOf(boxOf({1, 0.02, 1}), wantedOf(1));
    ASSERT_TRUE(north);
    EXPECT_GT(std::abs(north->pose().forward().y), 0.6);
    // One that lies is seen from above.
    const std::optional<FirstView> lying = firstViewOf(boxOf({1, 1, 0.02}), wantedOf(1));
    ASSERT_TRUE(lying);
    EXPECT_LT(lying->pose().forward().z, -0.45);
    // Three faces of a cube, not one.
    const std::optional<FirstView> cube = firstViewOf(boxOf({1, 1, 1}), wantedOf(1));
    ASSERT_TRUE(cube);
    const glm::dvec3 forward = glm::abs(cube->pose().forward());
    EXPECT_GT(std::min({forward.x, forward.y, forward.z}), 0.15);
}

TEST(FirstView, ABallIsSeenFromTheFront) {
    const std::optional<FirstView> view = firstViewOf(ballOf(1, {0, 0, 0}), wantedOf(1, 0.12));
    ASSERT_TRUE(view);
    EXPECT_LT(std::min(view->turn, 2 * kPi - view->turn), 0.6);
}

TEST(FirstView, TheFlightAroundLosesNothing) {
    for (const double aspect : {16.0 / 9, 0.5}) {
        const auto samples = boxOf({3, 0.3, 0.5});
        const std::optional<FirstView> view = firstViewOf(samples, wantedOf(aspect));
        ASSERT_TRUE(view);
        EXPECT_GE(view->flight.distance, view->orbit.distance);
        for (int n = 0; n < 100; ++n) {
            const Shown shown = shownFrom(poseOn(view->flight, 0.0628 * n), samples);
            EXPECT_LE(std::max(-shown.low.x, shown.high.x), aspect);
            EXPECT_LE(std::max(-shown.low.y, shown.high.y), 1);
            EXPECT_GT(shown.nearest, 0);
        }
    }
}

TEST(FirstView, IsTheSameOnAnyNumberOfThreads) {
    const auto samples = boxOf({1, 0.7, 0.4});
    const int threads = threadCount();
    const std::optional<FirstView> many = firstViewOf(samples, wantedOf(1.5));
    setThreadCount(1);
    const std::optional<FirstView> one = firstViewOf(samples, wantedOf(1.5));
    setThreadCount(threads);
    ASSERT_TRUE(many && one);
    EXPECT_EQ(many->pose().position, one->pose().position);
    EXPECT_EQ(many->turn, one->turn);
}

TEST(FirstView, PointsNothingAndNonsense) {
    EXPECT_FALSE(firstViewOf({}, wantedOf(1)));
    EXPECT_FALSE(firstViewOf({{glm::dvec3(std::nan("")), {}}}, wantedOf(1)));
    EXPECT_FALSE(firstViewOf({{glm::dvec3(kInfinity), {}}, {glm::dvec3(0.0), {}}}, wantedOf(1)));
    EXPECT_FALSE(firstViewOf(boxOf({1, 1, 1}), wantedOf(0)));
    EXPECT_FALSE(firstViewOf(boxOf({1, 1, 1}), wantedOf(std::nan(""))));
    ViewWanted wanted = wantedOf(1);
    wanted.least = 0.25;
    const std::optional<FirstView> point = firstViewOf({{glm::dvec3(1, 2, 3), {}}}, wanted);
    ASSERT_TRUE(point);
    EXPECT_EQ(point->radius, 0.25);
    EXPECT_NEAR(glm::length(point->pose().position - glm::dvec3(1, 2, 3)), 0.25 / std::tan(0.5 * kFov), 1e-9);
    for (const double size : {1e-9, 1e12}) {
        const auto samples = boxOf(glm::dvec3(size));
        wanted.least = 1e-12;
        const std::optional<FirstView> view = firstViewOf(samples, wanted);
        ASSERT_TRUE(view) << size;
        EXPECT_NEAR(shownFrom(view->pose(), samples).longer(), kFirstFill, 0.02) << size;
    }
}

}  // namespace
}  // namespace stereonav
