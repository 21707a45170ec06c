// The computed viewpoint and flight over grounds whose height is a formula.
#include "terrain/scene/scene_flight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

namespace stereonav {
namespace {

Heightfield groundOf(int width, int height, double spacing, const std::function<float(int, int)>& h) {
    std::vector<float> heights;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) heights.push_back(h(i, j));
    return Heightfield(width, height, {spacing, spacing}, std::move(heights), "test ground");
}

Heightfield hills() {
    return groundOf(200, 150, 30, [](int i, int j) {
        return static_cast<float>(400 * std::sin(i * 0.11) * std::cos(j * 0.07) + 60 * std::sin(i * 0.9 + j));
    });
}

TEST(DefaultFlight, LastsAsLongAsItSays) {
    const RecordedPath path = defaultFlight(hills(), 2);
    EXPECT_EQ(path.startTime(), 0.0);
    EXPECT_NEAR(path.duration(), kDefaultFlightSeconds, 1e-9);
}

TEST(DefaultFlight, StaysAboveTheGroundBetweenSamplesToo) {
    const Heightfield ground = hills();
    for (const double clearance : {0.0, 2.0, 500.0}) {
        const RecordedPath path = defaultFlight(ground, clearance);
        for (int k = 0; k <= 20000; ++k) {
            const glm::dvec3 p = path.at(path.duration() * k / 20000).position;
            ASSERT_GE(p.z, ground.heightAt({p.x, p.y}) + clearance) << "moment " << k;
            ASSERT_TRUE(ground.contains({p.x, p.y}));
        }
    }
}

TEST(DefaultFlight, HasEvenSpeedAndNoJerks) {
    const RecordedPath path = defaultFlight(hills(), 2);
    const int steps = 480;
    const double dt = path.duration() / steps;
    double slowest = 1e300, fastest = 0;
    for (int k = 0; k < steps; ++k) {
        const Pose a = path.at(k * dt), b = path.at((k + 1) * dt);
        const double speed = glm::length(b.position - a.position) / dt;
        slowest = std::min(slowest, speed);
        fastest = std::max(fastest, speed);
        // No turn faster than 30 degrees a second.
        ASSERT_LT(std::acos(std::min(1.0, glm::dot(a.forward(), b.forward()))), 0.52 * dt) << "step " << k;
        ASSERT_LT(std::acos(std::min(1.0, glm::dot(a.up(), b.up()))), 0.52 * dt) << "step " << k;
    }
    EXPECT_LT(fastest / slowest, 1.05);
}

TEST(DefaultFlight, LooksAheadSlightlyDownAndBanksIntoTheTurn) {
    const RecordedPath path = defaultFlight(hills(), 2);
    for (double t = 0.5; t < 23.5; t += 0.25) {
        const glm::dvec3 way = path.at(t + 0.1).position - path.at(t - 0.1).position;
        const Pose pose = path.at(t);
        EXPECT_GT(glm::dot(glm::normalize(glm::dvec2(way)), glm::normalize(glm::dvec2(pose.forward()))),
                  0.85);
        const PoseAngles angles = anglesOf(pose);
        EXPECT_LT(angles.pitch, 0.05) << t;
        EXPECT_GT(angles.pitch, -0.5) << t;
        // Counter-clockwise: the left side goes down, by 2 to 20 degrees.
        EXPECT_LT(angles.roll, -0.03) << t;
        EXPECT_GT(angles.roll, -0.35) << t;
    }
}

TEST(DefaultFlight, IsTheSameEveryTime) {
    const RecordedPath a = defaultFlight(hills(), 2), b = defaultFlight(hills(), 2);
    ASSERT_EQ(a.samples().size(), b.samples().size());
    for (std::size_t k = 0; k < a.samples().size(); ++k) {
        ASSERT_EQ(a.samples()[k].time, b.samples()[k].time);
        ASSERT_EQ(a.samples()[k].pose.position, b.samples()[k].pose.position);
        ASSERT_EQ(a.samples()[k].pose.orientation, b.samples()[k].pose.orientation);
    }
}

TEST(DefaultStartPose, FacesTheSummitFromLowGround) {
    // One mountain, off the middle, on a plain that rises to the east.
    const Heightfield ground = groundOf(101, 101, 50, [](int i, int j) {
        const double d2 = (i - 60) * (i - 60) + (j - 45) * (j - 45);
        return static_cast<float>(2000 * std::exp(-d2 / 200) + 5 * i);
    });
    const Pose pose = defaultStartPose(ground, 3, -0.2);
    const glm::dvec2 place(pose.position);
    EXPECT_TRUE(ground.contains(place));
    EXPECT_GE(pose.position.z, ground.heightAt(place) + 50);
    EXPECT_LT(place.x, 0.0) << "stands on the high side";
    const glm::dvec2 toSummit = glm::normalize(ground.worldFromGrid({60, 45}) - place);
    EXPECT_NEAR(glm::dot(glm::normalize(glm::dvec2(pose.forward())), toSummit), 1.0, 1e-6);
    EXPECT_NEAR(anglesOf(pose).pitch, -0.2, 1e-9);
    EXPECT_NEAR(anglesOf(pose).roll, 0.0, 1e-9);
}

}  // namespace
}  // namespace stereonav
