// The computed viewpoint and flight over grounds at the edge of what a heightfield can be.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "terrain/scene/scene_flight.h"

namespace stereonav {
namespace {

struct Extreme {
    const char* name;
    int width, height;
    double spacing;
    float (*h)(int i, int j, std::mt19937& random);
};

float uniform(std::mt19937& random) {
    return static_cast<float>(random()) / 4294967296.0f;
}

const Extreme kExtremes[] = {
    {"flat", 64, 64, 30, [](int, int, std::mt19937&) { return 0.0f; }},
    {"flat and far up", 64, 64, 30, [](int, int, std::mt19937&) { return 1e7f; }},
    {"two by two", 2, 2, 30, [](int i, int j, std::mt19937&) { return float(i * 3 + j); }},
    {"two by a thousand", 2, 1000, 1, [](int, int, std::mt19937& r) { return uniform(r); }},
    {"range 1e-6 m", 50, 50, 30, [](int, int, std::mt19937& r) { return 1e-6f * uniform(r); }},
    {"range 1e6 m", 50, 50, 30, [](int, int, std::mt19937& r) { return 1e6f * uniform(r); }},
    {"spikes", 200, 200, 1, [](int, int, std::mt19937& r) { return r() % 50 == 0 ? 1e5f : 0.0f; }},
    {"deep pits", 100, 100, 10, [](int, int, std::mt19937& r) { return r() % 9 == 0 ? -1e6f : 0.0f; }},
    {"cliff", 100, 100, 10, [](int i, int, std::mt19937&) { return i < 50 ? 0.0f : 9000.0f; }},
    {"tiny spacing", 40, 40, 1e-6, [](int, int, std::mt19937& r) { return 1e-6f * uniform(r); }},
    {"huge spacing", 40, 40, 1e7, [](int, int, std::mt19937& r) { return 100 * uniform(r); }},
    {"holes", 80, 80, 30,
     [](int i, int j, std::mt19937& r) {
         const bool hole = (i / 10 + j / 10) % 2 == 1;
         return hole ? std::numeric_limits<float>::quiet_NaN() : 900 * uniform(r);
     }},
};

Heightfield groundOf(const Extreme& e) {
    std::mt19937 random(11);
    std::vector<float> heights;
    for (int j = 0; j < e.height; ++j)
        for (int i = 0; i < e.width; ++i) heights.push_back(e.h(i, j, random));
    return Heightfield(e.width, e.height, {e.spacing, e.spacing}, std::move(heights), e.name);
}

bool isSound(const Pose& pose) {
    const glm::dquat& q = pose.orientation;
    return std::isfinite(pose.position.x + pose.position.y + pose.position.z) &&
           std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1) < 1e-9;
}

// Returns whether a pose is clear of the ground, where there is one, up to the rounding of numbers as large
// as its heights.
bool isClear(const Pose& pose, const Heightfield& ground, double clearance) {
    const double h = ground.heightAt({pose.position.x, pose.position.y});
    return std::isnan(h) || pose.position.z >= h + clearance - 1e-12 * std::abs(h);
}

TEST(SceneFlightExtremes, FlightStaysClear) {
    for (const Extreme& e : kExtremes) {
        const Heightfield ground = groundOf(e);
        for (const double clearance : {0.0, 5.0}) {
            const RecordedPath path = defaultFlight(ground, clearance);
            EXPECT_NEAR(path.duration(), kDefaultFlightSeconds, 1e-9) << e.name;
            for (int k = 0; k <= 5000; ++k) {
                const Pose pose = path.at(path.duration() * k / 5000);
                ASSERT_TRUE(isSound(pose)) << e.name << " at " << k;
                ASSERT_TRUE(isClear(pose, ground, clearance)) << e.name << " at " << k;
            }
        }
    }
}

TEST(SceneFlightExtremes, StartPoseStaysClear) {
    for (const Extreme& e : kExtremes) {
        const Heightfield ground = groundOf(e);
        const Pose pose = defaultStartPose(ground, 5.0, -0.15);
        EXPECT_TRUE(isSound(pose)) << e.name;
        EXPECT_TRUE(isClear(pose, ground, 5.0)) << e.name;
        EXPECT_TRUE(ground.contains({pose.position.x, pose.position.y})) << e.name;
    }
}

}  // namespace
}  // namespace stereonav
