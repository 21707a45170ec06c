// Light baked over grounds that no one should have: tiny, huge, spiked, open, rough beyond reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/error.h"
#include "engine/math/constants.h"
#include "terrain/light/terrain_relight.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

TerrainLight bake(const Heightfield& ground, const TerrainLightSettings& settings) {
    Progress quiet;
    return bakeTerrainLight(ground, settings, quiet);
}

// Returns irradiance / pi of all samples, under a sky of radiance 1.
std::vector<double> constantSky(const TerrainLight& light) {
    std::vector<double> all;
    for (std::size_t k = 0; k < light.grid.count(); ++k)
        all.push_back(light.full[k] * transferUnit(0) * std::sqrt(4 * kPi));
    return all;
}

void expectSound(const Heightfield& ground, TerrainLightSettings settings, const std::string& what) {
    settings.albedo = 1;
    settings.bounces = 4;
    settings.rays = 16;
    const TerrainLight light = bake(ground, settings);
    for (const double e : constantSky(light)) {
        ASSERT_GE(e, 0) << what;
        // No more than comes in, but for the steps of 1 / 32767 in which each bounce is kept.
        ASSERT_LE(e, 1 + 3e-4) << what;
    }
    const TerrainRelight relight(ground, light);
    const SkyRadiance sky = skyRadiance([](const glm::dvec3& d) { return gradientSky(glm::vec3(d)); });
    TerrainLook look;
    for (const double elevation : {1.57, 0.3, 0.0, -0.5}) {
        look.sunElevation = elevation;
        GroundBrightness brightness;
        relight.relight(sunAndSky(look, sky), brightness);
        for (const float b : brightness.planes) {
            ASSERT_TRUE(std::isfinite(b)) << what;
            ASSERT_GE(b, 0.0f) << what;
            ASSERT_LT(b, 10.0f) << what;
        }
    }
}

TEST(TerrainLightExtreme, EveryKindOfGroundKeepsItsEnergy) {
    for (const std::string& kind : test::groundKinds())
        expectSound(test::makeGround(kind, 41, 37, 7), {}, kind);
}

TEST(TerrainLightExtreme, SmallestGrounds) {
    for (const auto& [width, height] : {std::pair{2, 2}, {2, 50}, {50, 2}, {3, 2}})
        for (const int stride : {1, 2, 7, 1000}) {
            TerrainLightSettings settings;
            settings.stride = stride;
            const Heightfield ground = test::makeGround("rough", width, height, 3);
            expectSound(ground, settings, std::to_string(width) + "x" + std::to_string(height));
            const LightGrid grid(ground, stride);
            EXPECT_EQ(grid.column(grid.width - 1), width - 1);
            EXPECT_EQ(grid.row(grid.height - 1), height - 1);
        }
}

TEST(TerrainLightExtreme, HeightsAndSpacingsOfAnySize) {
    for (const double scale : {1e-6, 1.0, 1e6})
        for (const double spacing : {1e-3, 30.0, 1e6}) {
            std::vector<float> heights;
            for (int k = 0; k < 31 * 31; ++k)
                heights.push_back(
                    static_cast<float>(scale * (1 + std::sin(k % 31 * 0.4) * std::cos(k / 31 * 0.3))));
            const Heightfield ground(31, 31, glm::dvec2(spacing), std::move(heights), "test");
            expectSound(ground, {}, std::to_string(scale) + " " + std::to_string(spacing));
        }
}

// Light is a matter of shape alone: a ground ten times as large in all directions is lit alike.
TEST(TerrainLightExtreme, LightDoesNotDependOnTheScale) {
    const auto groundOf = [](double scale, double base) {
        std::vector<float> heights;
        for (int k = 0; k < 41 * 41; ++k)
            heights.push_back(
                static_cast<float>(scale * (base + 40 * std::sin(k % 41 * 0.4) * std::cos(k / 41 * 0.3))));
        return Heightfield(41, 41, glm::dvec2(10 * scale), std::move(heights), "test");
    };
    const std::vector<double> one = constantSky(bake(groundOf(1, 0), {}));
    for (const auto& [scale, base] : {std::pair{64.0, 0.0}, {1.0 / 64, 0.0}, {1.0, 4096.0}}) {
        const std::vector<double> other = constantSky(bake(groundOf(scale, base), {}));
        double mean = 0;
        for (std::size_t k = 0; k < one.size(); ++k) {
            // Where rounding turns a ray aside, another place is looked up.
            ASSERT_NEAR(other[k], one[k], 0.02) << scale << " " << base;
            mean += std::abs(other[k] - one[k]) / static_cast<double>(one.size());
        }
        EXPECT_LT(mean, 1e-3) << scale << " " << base;
    }
}

TEST(TerrainLightExtreme, ASpikeShadesItsNeighboursAndSeesHalfTheWorldFromItsSides) {
    std::vector<float> heights(41 * 41, 0.0f);
    heights[20 * 41 + 20] = 500;
    const Heightfield ground(41, 41, glm::dvec2(10), std::move(heights), "spike");
    const TerrainLight light = bake(ground, {});
    const auto open = [&](int i, int j) { return light.openness[j * 41 + i] / 255.0; };
    EXPECT_EQ(open(20, 20), 1);  // its smoothed normal is upright, and nothing is higher
    EXPECT_LT(open(21, 20), 0.6);
    EXPECT_GT(open(40, 40), 0.98);
    EXPECT_GT(open(25, 20), open(22, 20));
    // Symmetric, but for the mesh's diagonals.
    EXPECT_NEAR(open(26, 20), open(14, 20), 0.03);
    EXPECT_NEAR(open(20, 26), open(20, 14), 0.03);
}

TEST(TerrainLightExtreme, HolesAreDarkInTheBakeAndClosedInTheLight) {
    const Heightfield ground = test::makeGround("holed", 41, 37, 7);
    ASSERT_TRUE(ground.hasHoles());
    const TerrainLight light = bake(ground, {});
    const TerrainRelight relight(ground, light);
    GroundBrightness brightness;
    TerrainLook look;
    relight.relight(sunAndSky(look, skyRadiance([](const glm::dvec3&) { return glm::vec3(1.0f); })),
                    brightness);
    int holes = 0, closed = 0;
    for (int j = 0; j < 37; ++j)
        for (int i = 0; i < 41; ++i) {
            if (std::isfinite(ground.sample(i, j))) {
                EXPECT_GT(brightness.at(i, j).y, 0.01f) << i << " " << j;
                continue;
            }
            ++holes;
            EXPECT_EQ(light.openness[j * 41 + i], 0);
            const bool beside =
                std::isfinite(ground.sample(i - 1, j)) || std::isfinite(ground.sample(i + 1, j)) ||
                std::isfinite(ground.sample(i, j - 1)) || std::isfinite(ground.sample(i, j + 1));
            if (!beside) continue;
            EXPECT_GT(brightness.at(i, j).y, 0.01f) << i << " " << j;
            ++closed;
        }
    EXPECT_GT(holes, 10);
    EXPECT_GT(closed, 5);
}

// Means of many short bakes against one long one: no bias beyond chance. z is normal; with this seed fixed
// the test can not flicker, and 4.5 is passed by chance once in 150,000.
TEST(TerrainLightExtreme, ShortBakesAreRightInTheMean) {
    const Heightfield ground = test::makeGround("smooth", 33, 33, 2);
    TerrainLightSettings settings;
    settings.albedo = 0.9;
    settings.bounces = 1;
    settings.rays = 16384;
    settings.stride = 8;
    const std::vector<double> truth = constantSky(bake(ground, settings));
    settings.rays = 16;
    constexpr int kBakes = 48;
    std::vector<double> sum(truth.size()), square(truth.size());
    for (int b = 0; b < kBakes; ++b) {
        settings.seed = 100 + b;
        const std::vector<double> one = constantSky(bake(ground, settings));
        for (std::size_t k = 0; k < truth.size(); ++k) {
            sum[k] += one[k];
            square[k] += one[k] * one[k];
        }
    }
    for (std::size_t k = 0; k < truth.size(); ++k) {
        const double mean = sum[k] / kBakes;
        const double variance = std::max(0.0, square[k] / kBakes - mean * mean) / (kBakes - 1);
        // A ratio of sums is off by the order of its variance; steps of the transfer come on top.
        EXPECT_LT(std::abs(mean - truth[k]), 4.5 * std::sqrt(variance) + 2e-4) << k;
    }
}

TEST(TerrainLightExtreme, SettingsOutOfRangeAreNamed) {
    const Heightfield ground = test::makeGround("flat", 5, 5, 1);
    const auto problemOf = [&](auto change) -> std::string {
        TerrainLightSettings settings;
        change(settings);
        try {
            bake(ground, settings);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    using testing::HasSubstr;
    EXPECT_THAT(problemOf([](auto& s) { s.order = 7; }), HasSubstr("order"));
    EXPECT_THAT(problemOf([](auto& s) { s.bounces = -1; }), HasSubstr("bounces"));
    EXPECT_THAT(problemOf([](auto& s) { s.rays = 17; }), HasSubstr("rays"));
    EXPECT_THAT(problemOf([](auto& s) { s.azimuths = 6; }), HasSubstr("azimuths"));
    EXPECT_THAT(problemOf([](auto& s) { s.stride = 0; }), HasSubstr("stride"));
    EXPECT_THAT(problemOf([](auto& s) { s.albedo = std::numeric_limits<double>::quiet_NaN(); }),
                HasSubstr("albedo"));
    EXPECT_EQ(problemOf([](auto&) {}), "");
}

TEST(TerrainLightExtreme, StopsWhenAsked) {
    const Heightfield ground = test::makeGround("rough", 101, 101, 1);
    Progress progress;
    progress.cancel();
    EXPECT_THROW(bakeTerrainLight(ground, {}, progress), Cancelled);
}

}  // namespace
}  // namespace stereonav
