// Centrelines of lumens whose axis is known in closed form, and of lumens with hardly any room for one.
#include "colon/centreline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "centreline_lumens.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

using test::distancesOf;
using test::lumenOf;
using test::lumenOfVoxels;
using test::Shape;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

Centreline lineOf(const LumenField& lumen, const CentrelineSetting& setting = {}) {
    Progress progress;
    return findCentreline(lumen, distancesOf(lumen.lumen), setting, progress);
}

double valueAt(const LumenField& lumen, const glm::dvec3& world) {
    const glm::dvec3 v = lumen.field.frame.voxelFromWorld(world);
    const glm::ivec3 low = glm::clamp(glm::ivec3(glm::floor(v)), glm::ivec3(0), lumen.field.frame.size - 1);
    const glm::dvec3 t = v - glm::dvec3(low);
    double sum = 0;
    for (int n = 0; n < 8; ++n) {
        const glm::ivec3 up(n & 1, n >> 1 & 1, n >> 2);
        const glm::dvec3 w = glm::mix(1.0 - t, t, glm::dvec3(up));
        sum += w.x * w.y * w.z * lumen.field.at(glm::min(low + up, lumen.field.frame.size - 1));
    }
    return sum;
}

// Inside, evenly spaced, radii never beyond the nearest outside voxel's centre.
void expectSound(const LumenField& lumen, const Centreline& line, double spacing) {
    ASSERT_FALSE(line.points.empty());
    for (std::size_t n = 0; n < line.points.size(); ++n) {
        const CentrelinePoint& p = line.points[n];
        const glm::ivec3 nearest(glm::round(lumen.lumen.frame.voxelFromWorld(p.position)));
        ASSERT_TRUE(lumen.lumen.frame.contains(nearest)) << n;
        EXPECT_EQ(lumen.lumen.at(nearest), p.segment) << n;
        EXPECT_LT(valueAt(lumen, p.position), lumen.isovalue) << n;
        EXPECT_GE(p.radius, 0) << n;
        if (n == 0 || line.points[n - 1].segment != p.segment) continue;
        EXPECT_NEAR(glm::length(p.position - line.points[n - 1].position), spacing, 0.2 * spacing) << n;
    }
}

double farthest(const Centreline& line, const std::function<double(const glm::dvec3&)>& away) {
    double most = 0;
    for (const CentrelinePoint& p : line.points) most = std::max(most, away(p.position));
    return most;
}

double capsule(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, double radius) {
    const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::length(p - a - t * (b - a)) - radius;
}

TEST(Centreline, OfAStraightTubeIsItsAxis) {
    const glm::dvec3 a(0.013, 0.0121, 0.012), b(0.031, 0.027, 0.082);
    const LumenField lumen =
        lumenOf([&](const glm::dvec3& p) { return capsule(p, a, b, 0.008); }, glm::dvec3(0.0),
                glm::dvec3(0.045, 0.04, 0.095), glm::dvec3(8e-4, 8e-4, 7e-4));
    const Centreline line = lineOf(lumen);
    expectSound(lumen, line, 0.001);
    EXPECT_LT(farthest(line, [&](const glm::dvec3& p) { return capsule(p, a, b, 0); }), 0.0006);
    EXPECT_NEAR(line.length(), glm::length(b - a), 0.004);
    EXPECT_LT(line.points.front().position.z, line.points.back().position.z);
    for (const CentrelinePoint& p : line.points) {  // conservative: up to a voxel and a quarter too small
        EXPECT_LT(p.radius, 0.0081);
        EXPECT_GT(p.radius, 0.007);
    }
}

TEST(Centreline, OfATorusArcIsItsCircle) {
    constexpr double kBend = 0.03, kTube = 0.01;  // three quarters of a circle around y
    const auto circle = [&](const glm::dvec3& p) {
        const double angle = std::clamp(std::atan2(p.z, p.x), -kPi / 2, kPi);
        return glm::dvec3(kBend * std::cos(angle), 0, kBend * std::sin(angle));
    };
    const LumenField lumen = lumenOf(
        [&](const glm::dvec3& p) {
            const bool gap = p.x < 0 && p.z < 0;
            const glm::dvec3 ends[] = {{-kBend, 0, 0}, {0, 0, -kBend}};
            if (gap) return std::min(glm::length(p - ends[0]), glm::length(p - ends[1])) - kTube;
            return glm::length(p - circle(p)) - kTube;
        },
        glm::dvec3(-0.042, -0.0121, -0.042), glm::dvec3(0.042, 0.0121, 0.042), glm::dvec3(9e-4, 8e-4, 1e-3));
    const Centreline line = lineOf(lumen);
    expectSound(lumen, line, 0.001);
    EXPECT_LT(farthest(line, [&](const glm::dvec3& p) { return glm::length(p - circle(p)); }), 0.001);
    EXPECT_NEAR(line.length(), 1.5 * kPi * kBend, 0.05 * 1.5 * kPi * kBend);
    EXPECT_LT(line.points.front().position.z, -0.02);  // the lower end first
}

// A winding axis y = A sin(w z), with bulges of the radius (haustra) where depth is not 0.
struct Winding {
    double amplitude = 0.015, wave = 2 * kPi / 0.08, tube = 0.007, depth = 0, bulges = 2 * kPi / 0.02;
    glm::dvec3 at(double z) const { return {0.0, amplitude * std::sin(wave * z), z}; }
    double nearest(const glm::dvec3& p) const {  // z of the nearest axis point
        double best = 0, least = 1e9;
        const double low = std::max(0.01, p.z - 0.03), high = std::min(0.15, p.z + 0.03);
        for (double z = std::min(low, 0.15); z <= std::max(high, 0.01); z += 0.0004)
            if (const double d = glm::length(p - at(z)); d < least) {
                least = d;
                best = z;
            }
        return best;
    }
    double distance(const glm::dvec3& p) const {
        const double z = nearest(p);
        return glm::length(p - at(z)) - tube - depth * 0.5 * (1 + std::sin(bulges * z));
    }
    LumenField lumen(const glm::dvec3& spacing) const {
        return lumenOf([&](const glm::dvec3& p) { return distance(p); }, {-0.014, -0.03, -0.004},
                       {0.014, 0.03, 0.164}, spacing);
    }
};

TEST(Centreline, OfAWindingTubeFollowsItsAxis) {
    const Winding tube;
    const LumenField lumen = tube.lumen(glm::dvec3(0.0008, 0.0008, 0.0007));
    const Centreline line = lineOf(lumen);
    expectSound(lumen, line, 0.001);
    const double away =
        farthest(line, [&](const glm::dvec3& p) { return glm::length(p - tube.at(tube.nearest(p))); });
    EXPECT_LT(away, 0.001);
    std::printf("winding tube: at most %.2f mm from its axis\n", away * 1e3);
}

TEST(Centreline, DoesNotWanderIntoHaustra) {
    Winding tube;
    tube.depth = 0.005;  // radius 7 to 12 mm
    const LumenField lumen = tube.lumen(glm::dvec3(0.0008, 0.0008, 0.0007));
    const Centreline line = lineOf(lumen);
    expectSound(lumen, line, 0.001);
    const double away =
        farthest(line, [&](const glm::dvec3& p) { return glm::length(p - tube.at(tube.nearest(p))); });
    EXPECT_LT(away, 0.0025);
    double axis = 0;
    for (double z = 0.01; z < 0.15 - 1e-9; z += 0.0002) axis += glm::length(tube.at(z + 0.0002) - tube.at(z));
    EXPECT_NEAR(line.length(), axis, 0.08 * axis);
    std::printf("haustra: at most %.2f mm from the axis; %.1f mm long, the axis %.1f mm\n", away * 1e3,
                line.length() * 1e3, axis * 1e3);
}

}  // namespace
}  // namespace stereonav
