// The chosen first view and its sun, over grounds whose height is a formula.
#include "terrain/scene/first_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "engine/base/parallel.h"
#include "engine/math/constants.h"

namespace stereonav {
namespace {

constexpr double kFov = 0.8;

Heightfield viewedGround(int width, int height, double spacing,
                         const std::function<double(double, double)>& h) {
    std::vector<float> heights;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i)
            heights.push_back(
                static_cast<float>(h((i - 0.5 * (width - 1)) * spacing, (j - 0.5 * (height - 1)) * spacing)));
    return Heightfield(width, height, {spacing, spacing}, std::move(heights), "test ground");
}

// Height of a place in the picture, -1 (bottom) to 1 (top).
double heightInPicture(const Pose& pose, const glm::dvec3& place) {
    const glm::dvec3 to = place - pose.position;
    return glm::dot(to, pose.up()) / glm::dot(to, pose.forward()) / std::tan(0.5 * kFov);
}
double widthInPicture(const Pose& pose, const glm::dvec3& place) {
    const glm::dvec3 to = place - pose.position;
    return glm::dot(to, pose.right()) / glm::dot(to, pose.forward()) / std::tan(0.5 * kFov) / (16.0 / 9);
}

// What holds over any ground.
void expectSound(const Heightfield& ground, double clearance, const FirstView& view) {
    const glm::dvec3 at = view.pose.position;
    ASSERT_TRUE(std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z));
    EXPECT_TRUE(ground.contains(glm::dvec2(at)));
    const double under = ground.heightAt(glm::dvec2(at));
    if (std::isfinite(under)) {
        EXPECT_GE(at.z, under + clearance);
    }
    const PoseAngles angles = anglesOf(view.pose);
    EXPECT_NEAR(angles.roll, 0, 1e-9);
    EXPECT_GE(view.sunElevation, 25 * kRadians - 1e-9);
    EXPECT_LE(view.sunElevation, 35 * kRadians + 1e-9);
    const double aside = std::abs(std::remainder(view.sunAzimuth - angles.heading, 2 * kPi));
    EXPECT_GE(aside, 60 * kRadians);
    EXPECT_LE(aside, 120 * kRadians);
}

TEST(FirstView, ShowsAHillWholeUnderSky) {
    const Heightfield ground = viewedGround(301, 301, 30, [](double x, double y) {
        return 1500 * std::exp(-((x - 400) * (x - 400) + (y + 300) * (y + 300)) / (2 * 1200.0 * 1200));
    });
    const FirstView view = chooseFirstView(ground, 7.5, kFov);
    expectSound(ground, 7.5, view);
    const glm::dvec3 summit(400, -300, 1500);
    EXPECT_GT(glm::length(glm::dvec2(view.pose.position - summit)), 1800) << "stands on the hill";
    EXPECT_NEAR(widthInPicture(view.pose, summit), 0, 0.2);
    EXPECT_GT(heightInPicture(view.pose, summit), 0.3) << "sky above it is more than a third";
    EXPECT_LT(heightInPicture(view.pose, summit), 0.9) << "its top is cut";
    // The hill rises against the sky: the eye is below its summit.
    EXPECT_LT(view.pose.position.z, 1500);
}

TEST(FirstView, LooksAlongFlatGroundToAThirdOfSky) {
    const Heightfield ground = viewedGround(200, 100, 10, [](double, double) { return 250; });
    const FirstView view = chooseFirstView(ground, 2.5, kFov);
    expectSound(ground, 2.5, view);
    // Between the directions to the horizon and to the ground's end the picture's sky begins.
    const double horizon = heightInPicture(
        view.pose,
        view.pose.position + 1e6 * glm::dvec3(glm::normalize(glm::dvec2(view.pose.forward())), 0.0));
    EXPECT_GT(horizon, 0.2);
    EXPECT_LT(horizon, 0.8);
}

TEST(FirstView, StandsOnNoSummitOfARange) {
    const Heightfield ground = viewedGround(400, 200, 30, [](double x, double y) {
        return 900 + 300 * std::sin(x / 500) * std::cos(y / 370) + 150 * std::sin(x / 190 + y / 230);
    });
    const FirstView view = chooseFirstView(ground, 7.5, kFov);
    expectSound(ground, 7.5, view);
    EXPECT_LT(anglesOf(view.pose).pitch, 0);
    EXPECT_GT(anglesOf(view.pose).pitch, -20 * kRadians);
}

// Most directions miss a ground of one row of cells.
TEST(FirstView, ShowsSomeOfANarrowStrip) {
    for (const int width : {2, 3, 20}) {
        const Heightfield ground = viewedGround(width, 400, 10, [](double x, double y) {
            return 200 * std::cos(y / 900) + 60 * std::sin(x + y / 130);
        });
        const FirstView view = chooseFirstView(ground, 2.5, kFov);
        expectSound(ground, 2.5, view);
        int shown = 0;
        for (int j = 0; j < ground.height(); ++j) {
            const glm::dvec3 place(ground.worldFromGrid({0.5 * (width - 1), double(j)}), ground.sample(0, j));
            shown += glm::dot(place - view.pose.position, view.pose.forward()) > 0 &&
                     std::abs(heightInPicture(view.pose, place)) < 1 &&
                     std::abs(widthInPicture(view.pose, place)) < 0.5;
        }
        EXPECT_GE(shown, 3) << width;
    }
}

TEST(FirstView, IsSoundOverAnyGround) {
    const auto hole = [](double x, double y) {
        return std::hypot(x, y) < 150 ? std::nan("") : 100 + 0.2 * x;
    };
    const auto oneCell = [](double x, double y) { return x >= 400 && y >= 400 ? 12.0 : std::nan(""); };
    const Heightfield grounds[] = {
        viewedGround(2, 2, 1, [](double, double) { return 0; }),
        viewedGround(3, 3, 1e-3, [](double x, double) { return x; }),
        viewedGround(3, 3, 10, [](double x, double y) { return x == 0 && y == 0 ? 50.0 : 0.0; }),
        viewedGround(2, 300, 30, [](double, double y) { return 10 * std::sin(y); }),
        viewedGround(60, 60, 1e7, [](double x, double) { return 1e-5 * x; }),
        viewedGround(60, 60, 30, [](double x, double y) { return x * y == 0 ? 3e37 : -3e37; }),
        viewedGround(101, 101, 10, hole),
        viewedGround(91, 91, 10, oneCell),
    };
    for (const Heightfield& ground : grounds) expectSound(ground, 0.01, chooseFirstView(ground, 0.01, kFov));
    for (const double fov : {0.02, 2.9}) expectSound(grounds[2], 2, chooseFirstView(grounds[2], 2, fov));
}

TEST(FirstView, IsTheSameForAnyNumberOfThreads) {
    const Heightfield ground = viewedGround(250, 330, 30, [](double x, double y) {
        return 500 * std::sin(x / 800) * std::cos(y / 900) + 0.1 * x;
    });
    const int threads = threadCount();
    setThreadCount(1);
    const FirstView one = chooseFirstView(ground, 5, kFov);
    setThreadCount(4);
    const FirstView four = chooseFirstView(ground, 5, kFov);
    setThreadCount(threads);
    EXPECT_EQ(one.pose.position, four.pose.position);
    EXPECT_EQ(one.pose.orientation, four.pose.orientation);
    EXPECT_EQ(one.sunAzimuth, four.sunAzimuth);
    EXPECT_EQ(one.sunElevation, four.sunElevation);
}

TEST(FirstView, SunOfAGivenPoseShowsItsRelief) {
    // Ridges from south to north: light along them shows nothing.
    const Heightfield ground =
        viewedGround(200, 200, 30, [](double x, double) { return 200 * std::sin(x / 150); });
    const Pose pose = poseFromAngles({0, -2500, 900}, 0, -0.3, 0);
    const FirstView view = chooseSun(ground, pose, kFov);
    EXPECT_EQ(view.pose.position, pose.position);
    EXPECT_GT(std::abs(std::sin(view.sunAzimuth)), std::sin(65 * kRadians));
    EXPECT_GT(view.sunElevation, 30 * kRadians) << "slopes of 50 degrees";
}

}  // namespace
}  // namespace stereonav
