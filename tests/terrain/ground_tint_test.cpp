// Tints of ground without a picture: what grows or lies where, by height, latitude and slope.
#include "terrain/scene/ground_tint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

namespace stereonav {
namespace {

using Height = std::function<double(int i, int j)>;
constexpr double kRadians = std::numbers::pi / 180;

Heightfield groundOf(int side, double spacing, const Height& height) {
    std::vector<float> heights;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) heights.push_back(static_cast<float>(height(i, j)));
    return Heightfield(side, side, glm::dvec2(spacing), heights, "ground");
}

// Rising evenly from west to east.
Heightfield rampGround(double low, double high, double spacing = 200, int side = 60) {
    return groundOf(side, spacing, [=](int i, int) { return low + (high - low) * i / (side - 1); });
}

glm::vec3 tintAt(const GroundTint& tint, const glm::dvec2& grid, double height,
                 const glm::dvec3& normal = {0, 0, 1}) {
    GroundTint::Site site = tint.siteAt(grid);
    site.gradient = -glm::vec2(normal) / static_cast<float>(normal.z);
    return tint.at(grid, height, site);
}

glm::vec3 meanTint(const Heightfield& ground, const GroundTint& tint, int column) {
    glm::vec3 sum(0.0f);
    for (int j = 0; j < ground.height(); ++j) {
        const glm::dvec2 grid(column, j);
        sum += tint.at(grid, ground.sample(column, j), tint.siteAt(grid));
    }
    return sum / static_cast<float>(ground.height());
}

bool looksSnowy(const glm::vec3& color) {
    return color.x > 0.5f && color.z > 0.95f * color.x;
}
bool looksGreen(const glm::vec3& color) {
    return color.y > 1.08f * color.x && color.y > 1.08f * color.z;
}

TEST(GroundTint, LinesFallTowardsThePolesAndAreEqualOnBothSides) {
    for (double degrees = 25; degrees < 90; degrees += 0.5) {
        const GrowthLines here = growthLines(degrees * kRadians),
                          north = growthLines((degrees + 0.5) * kRadians);
        EXPECT_GE(here.tree, north.tree) << degrees;
        EXPECT_GE(here.snow, north.snow) << degrees;
        EXPECT_LE(here.tree, here.snow);
        EXPECT_EQ(growthLines(-degrees * kRadians).snow, here.snow);
    }
    // What is known of mountains: snow lies all year on Mont Blanc and Kilimanjaro, trees grow at 1,500 m in
    // the Alps, and at no height in Spitsbergen.
    EXPECT_LT(growthLines(45.8 * kRadians).snow, 4000);
    EXPECT_LT(growthLines(-3 * kRadians).snow, 5700);
    EXPECT_GT(growthLines(46 * kRadians).tree, 1500);
    EXPECT_LT(growthLines(78 * kRadians).tree, 100);
}

TEST(GroundTint, SnowLiesWhereTheLatitudeHasIt) {
    const Heightfield ground = rampGround(200, 4800);
    for (const double degrees : {-46.0, 46.0, 0.0, 34.0}) {
        const GroundTint tint(ground, {1, {degrees * kRadians}});
        const bool high = std::abs(degrees) > 40;
        EXPECT_EQ(looksSnowy(meanTint(ground, tint, 57)), high) << degrees;
        EXPECT_FALSE(looksSnowy(meanTint(ground, tint, 25))) << degrees;
    }
    // Twice as high as it is: the truth decides, not what is shown.
    const Heightfield doubled = rampGround(400, 4800);
    EXPECT_FALSE(looksSnowy(meanTint(doubled, GroundTint(doubled, {2, {46 * kRadians}}), 58)));
    EXPECT_FALSE(looksSnowy(meanTint(ground, GroundTint(ground, {}), 59))) << "of no known place";
    // From north to south within one model: columns of equal height.
    const Heightfield level = groundOf(60, 50'000, [](int i, int j) { return 2500 + 2 * ((i + j) % 2); });
    const GroundTint across(level, {1, {20 * kRadians, 70 * kRadians}});
    EXPECT_TRUE(looksSnowy(tintAt(across, {30, 58}, 2500)));
    EXPECT_FALSE(looksSnowy(tintAt(across, {30, 2}, 2500)));
}

TEST(GroundTint, LowlandsHaveTheColourOfTheirEnvironment) {
    const Heightfield ground = rampGround(50, 2500);
    EXPECT_TRUE(looksGreen(meanTint(ground, GroundTint(ground, {1, {4 * kRadians}}), 3)));
    EXPECT_TRUE(looksGreen(meanTint(ground, GroundTint(ground, {1, {52 * kRadians}}), 3)));
    EXPECT_TRUE(looksGreen(meanTint(ground, GroundTint(ground, {}), 0)));
    const glm::vec3 desert = meanTint(ground, GroundTint(ground, {1, {25 * kRadians}}), 3);
    EXPECT_GT(desert.x, desert.y);
    EXPECT_GT(desert.y, desert.z);
    const glm::vec3 ice = meanTint(ground, GroundTint(ground, {1, {-82 * kRadians}}), 1);
    EXPECT_GT(ice.z, ice.x);
}

TEST(GroundTint, SteepGroundIsRock) {
    const Heightfield ground = rampGround(100, 2500, 30, 100);
    const GroundTint tint(ground, {1, {50 * kRadians}});
    const auto saturation = [&](double degrees) {
        double sum = 0;
        const glm::dvec3 normal(0, -std::sin(degrees * kRadians), std::cos(degrees * kRadians));
        for (int j = 1; j < 99; ++j) {
            const glm::vec3 c = tintAt(tint, {20, j}, ground.sample(20, j), normal);
            sum += 1 - std::min({c.x, c.y, c.z}) / std::max({c.x, c.y, c.z});
        }
        return sum / 98;
    };
    EXPECT_GT(saturation(5), 1.4 * saturation(62));
}

// Whatever the heights: colours within what a texture can hold, neither black nor beyond white.
TEST(GroundTint, EveryKindOfHeightsHasAColour) {
    const std::vector<std::pair<std::string, Height>> kinds{
        {"flat", [](int, int) { return 0.0; }},
        {"flat high", [](int, int) { return 812.0; }},
        {"tiny", [](int i, int) { return 1e-7 * i; }},
        {"huge", [](int i, int j) { return 1e6 * (i - 3.0) * j; }},
        {"deep", [](int i, int j) { return -11000 + 900.0 * i + 20.0 * j; }},
        {"dead sea", [](int i, int) { return -430 + 3.0 * i; }},
        {"holes", [](int i, int j) { return i > 4 && j > 4 && i < 8 ? std::nan("") : 40.0 * i * j; }}};
    for (const auto& [name, height] : kinds)
        for (const auto& latitudes :
             std::vector<std::vector<double>>{{}, {0.0}, {-1.2, -1.57}, {0.9, 0.6, 0.3}}) {
            const Heightfield ground = groundOf(13, 30, height);
            const GroundTint tint(ground, {1, latitudes});
            for (double y = -0.5; y < 13; y += 0.5)
                for (double x = -0.5; x < 13; x += 0.5) {
                    const glm::dvec2 grid(x, y);
                    const glm::dvec2 world = ground.worldFromGrid(grid);
                    const GroundTint::Site site = tint.siteAt(grid);
                    ASSERT_LT(glm::distance(site.normal(), ground.normalAt(world)), 1e-5)
                        << name << x << " " << y;
                    const glm::vec3 c = tint.at(grid, ground.heightAt(world), site);
                    for (int k = 0; k < 3; ++k) {
                        ASSERT_GT(c[k], 0.001f) << name << " " << x << " " << y;
                        ASSERT_LT(c[k], 1.5f) << name << " " << x << " " << y;
                    }
                }
        }
}

TEST(GroundTint, TheSmallestGround) {
    const Heightfield ground(2, 2, glm::dvec2(1e-6), {0, 1e-6f, 2e-6f, 3e-6f}, "ground");
    const GroundTint tint(ground, {1, {0.7}});
    EXPECT_GT(tintAt(tint, {0.5, 0.5}, 1e-6).y, 0.01f);
}

TEST(GroundTint, SeaIsLevelGroundAtItsHeightAndWhatLiesBelow) {
    const Height coast = [](int i, int) { return i < 20 ? 0.0 : 8.0 * (i - 19); };
    const Heightfield ground = groundOf(40, 30, coast);
    const GroundTint placed(ground, {1, {0.8}}), anywhere(ground, {});
    const auto blue = [](const glm::vec3& c) { return c.z > c.x && c.z > c.y; };
    EXPECT_TRUE(blue(tintAt(placed, {8, 8}, 0)));
    EXPECT_FALSE(blue(tintAt(placed, {30, 8}, 88)));
    EXPECT_FALSE(blue(tintAt(anywhere, {8, 8}, 0)));
    const Heightfield floor = rampGround(-4000, 600);
    const GroundTint deep(floor, {1, {0.8}});
    const glm::vec3 shallow = tintAt(deep, {8, 8}, -100), abyss = tintAt(deep, {8, 8}, -3900);
    EXPECT_TRUE(blue(shallow));
    EXPECT_TRUE(blue(abyss));
    EXPECT_GT(shallow.y, 2 * abyss.y);
    const Heightfield depression = rampGround(-420, 600);
    EXPECT_FALSE(blue(tintAt(GroundTint(depression, {1, {0.55}}), {8, 8}, -400)));
}

// A plain with a metre of noise has no play of colours made of that noise.
TEST(GroundTint, NoiseOfAPlainIsNotSpreadOverTheScale) {
    for (const bool placed : {true, false}) {
        const auto spread = [&](double height) {
            const Heightfield ground =
                groundOf(80, 30, [=](int i, int j) { return 100 + height * ((i * 7 + j * 3) % 5); });
            const GroundTint tint(ground, placed ? TintPlace{1, {0.8}} : TintPlace{});
            float low = 9, high = 0;
            // At one place of the noise: heights alone.
            for (int k = 0; k < 5; ++k) {
                const glm::vec3 c = tintAt(tint, {40, 40}, 100 + height * k);
                low = std::min(low, c.x);
                high = std::max(high, c.x);
            }
            return high / low;
        };
        EXPECT_LT(spread(0.25), 1.03f) << placed;
        EXPECT_GT(spread(100), 1.25f) << placed;
    }
}

}  // namespace
}  // namespace stereonav
