// The shadow that ground casts on itself, against closed forms and against rays.
#include "terrain/light/cast_shadow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "engine/math/constants.h"
#include "terrain/light/sun_and_sky.h"

namespace stereonav {
namespace {

Heightfield shadedGround(int width, int height, const glm::dvec2& spacing,
                         const std::function<double(int, int)>& h) {
    std::vector<float> heights;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) heights.push_back(static_cast<float>(h(i, j)));
    return Heightfield(width, height, spacing, std::move(heights), "test ground");
}

std::vector<std::uint8_t> hiddenOn(const Heightfield& ground, const LightGrid& grid, double azimuth,
                                   double elevation) {
    return ShadowCaster(ground, grid).hidden(directionToSun(azimuth, elevation));
}

TEST(CastShadow, OfAWallIsAsLongAsTheSunIsLow) {
    // 60 m high, along the column 50; 10 m a sample.
    const Heightfield ground =
        shadedGround(101, 21, {10, 10}, [](int i, int) { return i == 50 ? 60.0 : 0.0; });
    const LightGrid grid(ground, 1);
    for (const double elevation : {20.0, 30.0, 45.0}) {
        const std::vector<std::uint8_t> hidden = hiddenOn(ground, grid, 90 * kRadians, elevation * kRadians);
        const double length = 60 / std::tan(elevation * kRadians);
        for (int i = 0; i < 101; ++i) {
            const double west = 10.0 * (50 - i);
            const std::uint8_t at = hidden[10 * 101 + i];
            if (west > 0 && west < length - 11) {
                EXPECT_EQ(at, 255) << i << ", " << elevation;
            } else if (west <= 0 || west > length) {
                EXPECT_EQ(at, 0) << i << ", " << elevation;
            }
        }
    }
}

// Whether a ray from above a sample to the sun meets the ground.
bool meets(const Heightfield& ground, int i, int j, const glm::dvec3& toSun) {
    const glm::dvec3 from(ground.worldFromGrid({i, j}), ground.sample(i, j));
    for (double t = 1; t < 4000; t += 1) {
        const glm::dvec3 at = from + t * toSun;
        if (!ground.contains(glm::dvec2(at))) return false;
        if (ground.heightAt(glm::dvec2(at)) > at.z + 0.3) return true;
    }
    return false;
}

TEST(CastShadow, IsWhatRaysFind) {
    const Heightfield ground = shadedGround(90, 70, {12, 17}, [](int i, int j) {
        return 80 * std::sin(i * 0.21) * std::cos(j * 0.27) + 30 * std::sin(i * 0.6 + j * 0.4);
    });
    const LightGrid grid(ground, 1);
    for (const double azimuth : {0.0, 33.0, 90.0, 141.0, 200.0, 300.0}) {
        const glm::dvec3 toSun = directionToSun(azimuth * kRadians, 22 * kRadians);
        const std::vector<std::uint8_t> hidden = ShadowCaster(ground, grid).hidden(toSun);
        int wrong = 0, dark = 0;
        for (int j = 0; j < 70; ++j)
            for (int i = 0; i < 90; ++i) {
                // Slopes that are turned away have no light, whatever is said of their shadow.
                if (glm::dot(ground.normalAt(ground.worldFromGrid({i, j})), toSun) < 0.05) continue;
                const bool ray = meets(ground, i, j, toSun);
                dark += ray;
                wrong += ray != (hidden[static_cast<std::size_t>(j) * 90 + i] > 127);
            }
        EXPECT_GT(dark, 300) << azimuth;
        EXPECT_LT(wrong, 0.05 * 90 * 70) << azimuth;
    }
}

TEST(CastShadow, IsTheSameAtFewerSamplesButTheirStep) {
    const Heightfield ground =
        shadedGround(102, 21, {10, 10}, [](int i, int) { return i >= 48 && i <= 52 ? 80.0 : 0.0; });
    const LightGrid grid(ground, 4);
    const std::vector<std::uint8_t> hidden = hiddenOn(ground, grid, 270 * kRadians, 30 * kRadians);
    for (int i = 0; i < grid.width; ++i) {
        const double east = 10.0 * (grid.column(i) - 52);
        const std::uint8_t at = hidden[2 * grid.width + i];
        if (east > 0 && east < 80 / std::tan(30 * kRadians) - 80) {
            EXPECT_EQ(at, 255) << i;
        } else if (east > 80 / std::tan(30 * kRadians) + 40 || east < -80) {
            EXPECT_EQ(at, 0) << i;
        }
    }
}

TEST(CastShadow, IsNoneOfAHighSunASetSunOrOfHoles) {
    const Heightfield ground = shadedGround(30, 30, {10, 10}, [](int i, int j) {
        return i == 10 ? std::nan("") : i == 20 && j != 5 ? 40.0 : 0.0;
    });
    const LightGrid grid(ground, 1);
    const std::vector<std::uint8_t> none(grid.count(), 0);
    EXPECT_EQ(hiddenOn(ground, grid, 1, 90 * kRadians), none);
    EXPECT_EQ(hiddenOn(ground, grid, 1, 0), none);
    EXPECT_EQ(hiddenOn(ground, grid, 1, -0.2), none);
    const std::vector<std::uint8_t> hidden = hiddenOn(ground, grid, 90 * kRadians, 10 * kRadians);
    EXPECT_EQ(hidden[15 * 30 + 9], 255) << "beyond the hole";
    EXPECT_EQ(hidden[15 * 30 + 10], 0) << "in it";
}

TEST(CastShadow, TakesTheSmallestAndSteepestGround) {
    const Heightfield two = shadedGround(2, 2, {1e-6, 1e6}, [](int i, int j) { return i * 3e37 - j * 1e37; });
    for (const double azimuth : {0.0, 1.0, 2.0, 4.0})
        EXPECT_EQ(hiddenOn(two, LightGrid(two, 1), azimuth, 0.5).size(), 4u);
}

}  // namespace
}  // namespace stereonav
