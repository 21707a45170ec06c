// Light baked over heightfields against closed forms: planes, slopes, steps and valleys that are so long
// that they count as infinite.
#include "terrain/light/terrain_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "engine/base/parallel.h"
#include "engine/light/skies/spherical_harmonics.h"
#include "engine/math/constants.h"
#include "terrain/light/terrain_horizon.h"

namespace stereonav {
namespace {

using HeightAt = std::function<double(double x, double y)>;

Heightfield groundOfHeights(int width, int height, glm::dvec2 spacing, const HeightAt& at) {
    std::vector<float> heights;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i)
            heights.push_back(static_cast<float>(
                at((i - 0.5 * (width - 1)) * spacing.x, (j - 0.5 * (height - 1)) * spacing.y)));
    return Heightfield(width, height, spacing, std::move(heights), "test");
}

TerrainLight bakeGround(const Heightfield& ground, const TerrainLightSettings& settings) {
    Progress quiet;
    return bakeTerrainLight(ground, settings, quiet);
}

double full(const TerrainLight& light, int i, int j, int k) {
    const std::size_t at = k * light.grid.count() + static_cast<std::size_t>(j) * light.grid.width + i;
    return light.full[at] * transferUnit(k);
}

// Irradiance / pi under a sky of radiance 1.
double constantSky(const TerrainLight& light, int i, int j) {
    return full(light, i, j, 0) * std::sqrt(4 * kPi);
}

double openness(const TerrainLight& light, int i, int j) {
    return light.openness[static_cast<std::size_t>(j) * light.grid.width + i] / 255.0;
}

TEST(TerrainLight, LevelGroundSeesTheWholeSky) {
    const Heightfield ground = groundOfHeights(21, 17, {30, 20}, [](double, double) { return 812.5; });
    TerrainLightSettings settings;
    settings.order = 6;
    const TerrainLight light = bakeGround(ground, settings);
    ASSERT_EQ(light.openness.size(), 21u * 17u);
    for (const std::uint8_t o : light.openness) EXPECT_EQ(o, 255);
    for (const std::uint8_t h : light.horizon) EXPECT_EQ(h, 0);
    // The clamped cosine over pi in zonal harmonics (Ramamoorthi and Hanrahan 2001, eq. 8), over the upper
    // half of the sphere, where it is all of it.
    const double zonal[6] = {1.0, 2.0 / 3, 0.25, 0, -1.0 / 24, 0};
    ASSERT_EQ(light.full.size(), 21u * light.grid.count());
    int l = 0;
    for (int n = 0; n < 21; ++n) {
        if (n == lightHarmonics(l + 1)) ++l;
        const int m = lightHarmonic(n) - l * (l + 1);
        ASSERT_LE(std::abs(m), l);
        EXPECT_EQ((l + m) % 2, 0);
        const double expected = m == 0 ? zonal[l] * std::sqrt((2 * l + 1) / (4 * kPi)) : 0.0;
        for (int j = 0; j < 17; j += 4)
            for (int i = 0; i < 21; i += 5)
                EXPECT_NEAR(full(light, i, j, n), expected, 4e-5) << l << " " << m;
    }
}

TEST(TerrainLight, ATiltedPlaneLosesWhatLiesBelowTheHorizontal) {
    for (const double slope : {0.1, 0.5, 1.0, 3.0}) {
        const Heightfield ground = groundOfHeights(
            33, 33, {10, 10}, [&](double x, double y) { return slope * (0.6 * x + 0.8 * y); });
        TerrainLightSettings settings;
        settings.azimuths = 64;
        const TerrainLight light = bakeGround(ground, settings);
        const double expected = 0.5 * (1 + 1 / std::sqrt(1 + slope * slope));
        for (int j = 4; j < 29; j += 6)
            for (int i = 4; i < 29; i += 6) {
                EXPECT_NEAR(openness(light, i, j), expected, 0.004) << slope;
                // What lies below is the rest of the hemisphere: no ground of the plane itself is seen.
                EXPECT_NEAR(constantSky(light, i, j), expected, 0.004) << slope;
            }
    }
}

// A wall along y at x = 0, `height` high: from a level point at distance d the sky is cut off at the
// in-plane angle atan(height / d), which leaves (1 + cos) / 2.
TEST(TerrainLight, AStepTakesAwayTheClosedFormShare) {
    const double wall = 50;
    const Heightfield ground =
        groundOfHeights(41, 1601, {5, 5}, [&](double x, double) { return x > 2.6 ? wall : 0.0; });
    TerrainLightSettings settings;
    settings.azimuths = 64;
    settings.bounces = 0;
    const TerrainLight light = bakeGround(ground, settings);
    const int middle = 800;
    for (const int i : {4, 8, 12, 16, 18}) {
        const double distance = (20 - i) * 5.0 + 5;  // the wall's upper edge is at the sample x = 5
        const double expected = 0.5 * (1 + std::cos(std::atan2(wall, distance)));
        EXPECT_NEAR(openness(light, i, middle), expected, 0.006) << i;
        EXPECT_NEAR(constantSky(light, i, middle), expected, 0.006) << i;
    }
}

// A symmetric valley with sides of tilt b, long along y. In its cross-section the point at height h on one
// side sees the sky from its own tangent plane to the opposite rim; Hottel's rule for elements of infinitely
// long surfaces: F = (sin a1 - sin a0) / 2, angles from the normal.
struct Valley {
    double tilt, half;  // radians, metres
    // The share of the sky that lies between the opposite rim and the upward tangent of the own slope.
    double skyShare(double x) const { return 0.5 * (1 - slopeTo(x, half)); }
    // The share, seen from the point at x, of the opposite side's strip from u to v (distances from the
    // axis).
    double stripShare(double x, double u, double v) const { return 0.5 * (slopeTo(x, v) - slopeTo(x, u)); }
    double slopeTo(double x, double u) const {
        const double c = std::cos(tilt), s = std::sin(tilt), t = std::tan(tilt);
        const double dx = -u - x, dz = (u - x) * t;
        return (c * dx + s * dz) / std::hypot(dx, dz);
    }
    // Irradiance / pi under a sky of 1 after `bounces` bounces, at n points of one side, by radiosity.
    std::vector<double> light(int n, double albedo, int bounces) const {
        std::vector<double> direct, total;
        for (int k = 0; k < n; ++k) direct.push_back(skyShare((k + 0.5) * half / n));
        total = direct;
        for (int b = 0; b < bounces; ++b) {
            std::vector<double> next = direct;
            for (int k = 0; k < n; ++k)
                for (int m = 0; m < n; ++m)
                    next[k] += albedo * total[m] *
                               stripShare((k + 0.5) * half / n, m * half / n, (m + 1) * half / n);
            total = next;
        }
        return total;
    }
};

TEST(TerrainLight, AValleyIsLitByItsOtherSide) {
    const int cells = 32, n = 320, rows = 401;
    for (const double tilt : {kPi / 9, kPi / 4}) {
        const Valley valley{tilt, 160};
        const Heightfield ground = groundOfHeights(
            2 * cells + 1, rows, {5, 20}, [&](double x, double) { return std::abs(x) * std::tan(tilt); });
        for (const int bounces : {0, 3}) {
            TerrainLightSettings settings;
            settings.azimuths = 64;
            settings.bounces = bounces;
            settings.albedo = 0.8;
            settings.stride = 2;
            settings.rays = 128;
            const TerrainLight light = bakeGround(ground, settings);
            const std::vector<double> truth = valley.light(n, settings.albedo, bounces);
            // Not the axis, whose smoothed normal is level, nor the samples beside it, whose hits mix with
            // it.
            for (int i = 4; i <= 14; ++i) {
                double mean = 0;
                for (int j = 80; j < 120; ++j) mean += constantSky(light, light.grid.width / 2 + i, j) / 40;
                const double x = 10.0 * i;
                const double expected = truth[static_cast<std::size_t>(x * n / 160)];
                EXPECT_NEAR(mean, expected, 0.012) << tilt << " bounces " << bounces << " at " << x;
            }
        }
    }
}

// The mesh of ground_rays.h at a grid position.
double meshHeight(const Heightfield& ground, const glm::dvec2& grid) {
    const int i = std::clamp(static_cast<int>(std::floor(grid.x)), 0, ground.width() - 2);
    const int j = std::clamp(static_cast<int>(std::floor(grid.y)), 0, ground.height() - 2);
    const double u = grid.x - i, v = grid.y - j;
    const double east = ground.sample(i + 1, j), north = ground.sample(i, j + 1);
    if (u + v <= 1) {
        const double corner = ground.sample(i, j);
        return corner + u * (east - corner) + v * (north - corner);
    }
    const double corner = ground.sample(i + 1, j + 1);
    return corner + (1 - u) * (north - corner) + (1 - v) * (east - corner);
}

// The horizon's sine by walking over every edge of the mesh: between edges it is straight.
double walkedHorizon(const Heightfield& ground, int i, int j, const glm::dvec2& direction) {
    const glm::dvec2 step = direction / ground.spacing();
    const double height = ground.sample(i, j);
    double steepest = 0;
    for (const double speed : {step.x, step.y, step.x + step.y})
        for (int k = 1; k <= ground.width() + ground.height() && std::abs(speed) > 1e-9; ++k) {
            const double run = k / std::abs(speed);
            const glm::dvec2 grid = glm::dvec2(i, j) + run * step;
            const double outside =
                std::max({-grid.x, -grid.y, grid.x - (ground.width() - 1), grid.y - (ground.height() - 1)});
            if (outside > 1e-9) break;
            steepest = std::max(steepest, (meshHeight(ground, grid) - height) / run);
        }
    return steepest / std::sqrt(1 + steepest * steepest);
}

TEST(TerrainLight, HorizonsAreThoseOfTheMesh) {
    const Heightfield ground = groundOfHeights(65, 61, {10, 12}, [](double x, double y) {
        return 60 * std::sin(x / 41) * std::cos(y / 57) + 25 * std::sin(x / 13 + y / 17);
    });
    TerrainLightSettings settings;
    settings.azimuths = 20;
    settings.bounces = 0;
    const TerrainLight light = bakeGround(ground, settings);
    int high = 0;
    for (int j = 0; j < 61; j += 3)
        for (int i = 0; i < 65; i += 4)
            for (int a = 0; a < 20; ++a) {
                const double expected = walkedHorizon(ground, i, j, azimuthDirection(a, 20));
                const double found = light.horizon[a * light.grid.count() + j * 65 + i] / 255.0;
                // Half a step of the byte.
                ASSERT_NEAR(found, expected, 0.5 / 255 + 1e-6) << i << " " << j << " " << a;
                high += found > 0.3;
            }
    EXPECT_GT(high, 500);
}

}  // namespace
}  // namespace stereonav
