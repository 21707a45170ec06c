// Natural colours of ground: what grows where, and ground of every kind.
#include "terrain/scene/natural_tones.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "engine/base/parallel.h"
#include "terrain/scene/ground_color.h"

namespace stereonav {
namespace {

using glm::vec3;
using HeightAt = std::function<double(int i, int j)>;
constexpr double kRadian = std::numbers::pi / 180;

Heightfield naturalGround(int width, int height, double spacing, const HeightAt& at) {
    std::vector<float> heights;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) heights.push_back(static_cast<float>(at(i, j)));
    return Heightfield(width, height, glm::dvec2(spacing), heights, "ground");
}

// Rising evenly from west to east: a height a column.
Heightfield rising(double low, double high, double spacing = 400, int side = 64) {
    return naturalGround(side, side, spacing,
                         [=](int i, int) { return low + (high - low) * i / (side - 1); });
}

TintPlace placed(double degrees, double verticalScale = 1) {
    return {verticalScale, {degrees * kRadian}, GroundPalette::Natural};
}

// Mean colour of a column of level ground; gradient: as if it lay so.
vec3 meanOf(const Heightfield& ground, const NaturalTones& tones, int column,
            const glm::vec2& gradient = {}) {
    vec3 sum(0.0f);
    for (int j = 0; j < ground.height(); ++j) {
        GroundShape::Site site = tones.shape().siteAt({column, j});
        site.gradient = gradient;
        sum += tones.colorAt({column, j}, ground.sample(column, j), site);
    }
    return sum / static_cast<float>(ground.height());
}

float lightnessOf(const vec3& c) {
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}
float saturationOf(const vec3& c) {
    return 1 - std::min({c.x, c.y, c.z}) / std::max({c.x, c.y, c.z});
}

TEST(NaturalTones, WoodsThenGrassThenRockThenSnow) {
    const Heightfield ground = rising(200, 4400);
    const NaturalTones tones(ground, placed(47), ground);
    const GrowthLines lines = growthLines(47 * kRadian);
    const auto column = [](double metres) { return static_cast<int>((metres - 200) / 4200 * 63); };
    const glm::vec2 hill(0.3f, 0.0f);
    const vec3 wood = meanOf(ground, tones, column(0.6 * lines.tree), hill),
               alp = meanOf(ground, tones, column(0.55 * lines.tree + 0.45 * lines.snow), hill),
               ice = meanOf(ground, tones, column(lines.snow + 700), hill);
    EXPECT_GT(wood.y, wood.x) << "green";
    EXPECT_GT(wood.y, 1.15f * wood.z);
    EXPECT_LT(lightnessOf(wood), 0.12f);
    EXPECT_GT(lightnessOf(alp), 1.3f * lightnessOf(wood));
    EXPECT_LT(saturationOf(alp), saturationOf(wood));
    EXPECT_GT(lightnessOf(ice), 0.5f);
    EXPECT_GT(ice.z, ice.x);
}

TEST(NaturalTones, LinesFollowTheLatitude) {
    const Heightfield ground = rising(3300, 3700);
    const auto at = [&](double degrees) {
        return meanOf(ground, NaturalTones(ground, placed(degrees), ground), 32, {0.2f, 0.0f});
    };
    EXPECT_GT(lightnessOf(at(52)), 0.5f) << "snow";
    EXPECT_LT(lightnessOf(at(30)), 0.3f);
    EXPECT_EQ(at(52).x, at(-52).x);
    const vec3 tropic = meanOf(ground, NaturalTones(ground, placed(2), ground), 32);
    EXPECT_GT(tropic.y, tropic.x) << "below the tree line";
}

TEST(NaturalTones, DryBeltsAreSandyAndGreenerHigherUp) {
    const Heightfield ground = rising(100, 3000);
    const NaturalTones desert(ground, placed(27), ground), humid(ground, placed(52), ground);
    const vec3 low = meanOf(ground, desert, 3), high = meanOf(ground, desert, 58);
    EXPECT_GT(low.x, 1.1f * low.y);
    EXPECT_GT(low.x / low.y, high.x / high.y);
    EXPECT_GT(meanOf(ground, humid, 3).y, meanOf(ground, humid, 3).x);
}

// A slope that faces the pole is darker and greener, on both halves of the Earth.
TEST(NaturalTones, SlopesThatFaceThePoleAreGreener) {
    const Heightfield ground = rising(600, 1400);
    for (const double degrees : {38.0, -38.0}) {
        const NaturalTones tones(ground, placed(degrees), ground);
        const float north = degrees > 0 ? 1.0f : -1.0f;
        const vec3 shady = meanOf(ground, tones, 32, {0.0f, -0.4f * north}),
                   sunny = meanOf(ground, tones, 32, {0.0f, 0.4f * north});
        EXPECT_LT(lightnessOf(shady), 0.75f * lightnessOf(sunny)) << degrees;
        EXPECT_GT(shady.y / shady.x, sunny.y / sunny.x) << degrees;
    }
}

TEST(NaturalTones, HollowsAreGreenerAndSteepGroundIsRock) {
    const Heightfield ground = rising(600, 1400, 30);
    const NaturalTones tones(ground, placed(38), ground);
    GroundShape::Site site = tones.shape().siteAt({30, 30});
    const auto at = [&](float wet, float hollow, float slope) {
        site.wet = wet;
        site.hollow = hollow;
        site.gradient = {slope, 0.0f};
        return tones.colorAt({30, 30}, 1000, site);
    };
    EXPECT_GT(at(0.8f, 0.5f, 0.2f).y / at(0.8f, 0.5f, 0.2f).x,
              at(-0.8f, -0.5f, 0.2f).y / at(-0.8f, -0.5f, 0.2f).x);
    EXPECT_LT(saturationOf(at(0, 0, 2.0f)), 0.7f * saturationOf(at(0, 0, 0.2f)));
}

// No step is larger than noise's own: neither at a height nor at a slope.
TEST(NaturalTones, ColoursChangeWithoutBands) {
    const Heightfield ground = rising(-100, 5200);
    for (const double degrees : {0.0, 35.0, 47.0, 70.0}) {
        const NaturalTones tones(ground, placed(degrees), ground);
        GroundShape::Site site = tones.shape().siteAt({30, 30});
        site.gradient = {0.3f, 0.0f};
        vec3 before = tones.colorAt({30, 30}, 1, site);
        for (double metres = 2; metres < 5200; metres += 1) {
            const vec3 now = tones.colorAt({30, 30}, metres, site);
            ASSERT_LT(glm::distance(now, before), 0.008f) << degrees << " at " << metres;
            before = now;
        }
    }
}

TEST(NaturalTones, ColoursAreNaturalOnAnyGround) {
    const std::vector<std::pair<std::string, HeightAt>> kinds{
        {"flat", [](int, int) { return 0.0; }},
        {"flat high", [](int, int) { return 812.0; }},
        {"tiny", [](int i, int) { return 1e-7 * i; }},
        {"huge", [](int i, int j) { return 1e6 * (i - 3.0) * j; }},
        {"all of the Earth", [](int i, int) { return -11000 + 20000.0 * i / 12; }},
        {"holes", [](int i, int j) { return i > 4 && j > 4 && i < 8 ? std::nan("") : 40.0 * i * j; }}};
    for (const auto& [name, at] : kinds)
        for (const auto& latitudes :
             std::vector<std::vector<double>>{{}, {0.0}, {-1.2, -1.5708}, {1.5708, 0.6}}) {
            const Heightfield ground = naturalGround(13, 11, 30, at);
            const NaturalTones tones(ground, {1, latitudes, GroundPalette::Natural}, ground);
            for (double y = -0.5; y < 11; y += 0.5)
                for (double x = -0.5; x < 13; x += 0.5) {
                    const GroundTone tone =
                        tones.at({x, y}, ground.heightAt(ground.worldFromGrid(glm::dvec2(x, y))));
                    for (int k = 0; k < 3; ++k)
                        ASSERT_TRUE(tone.color[k] > 0.004f && tone.color[k] < 1.1f) << name << x << " " << y;
                    ASSERT_NEAR(glm::length(tone.normal), 1, 1e-6);
                }
        }
}

TEST(NaturalTones, TwoRowsAreEnough) {
    for (const auto& [width, height] : {std::pair(2, 2), std::pair(40, 2), std::pair(2, 40)}) {
        const Heightfield ground = naturalGround(width, height, 30, [](int i, int j) { return 9.0 * i + j; });
        EXPECT_GT(NaturalTones(ground, placed(40), ground).at({0.5, 0.5}, 4).color.y, 0.01f);
    }
}

TEST(NaturalTones, WithoutALatitudeNothingIsSnowAndWhateverIsHighIsBare) {
    const Heightfield ground = rising(200, 6200);
    const NaturalTones tones(ground, {1, {}, GroundPalette::Natural}, ground);
    EXPECT_LT(lightnessOf(meanOf(ground, tones, 63)), 0.35f);
    const vec3 low = meanOf(ground, tones, 5, {0.2f, 0.0f});
    EXPECT_GT(low.y, low.x);
}

TEST(NaturalTones, TheSeaIsWaterAndALevelPlainIsNot) {
    const Heightfield coast =
        naturalGround(40, 40, 30, [](int i, int) { return i < 20 ? 0.0 : 8.0 * (i - 19); });
    const NaturalTones at(coast, placed(45), coast), anywhere(coast, {1, {}, GroundPalette::Natural}, coast);
    const auto blue = [](const GroundTone& tone) { return tone.color.z > 1.2f * tone.color.x; };
    EXPECT_TRUE(blue(at.at({8, 8}, 0)));
    EXPECT_FALSE(blue(at.at({30, 8}, 88)));
    EXPECT_FALSE(blue(anywhere.at({8, 8}, 0)));
    const Heightfield plain = naturalGround(40, 40, 30, [](int, int) { return 300.0; });
    EXPECT_FALSE(blue(NaturalTones(plain, placed(45), plain).at({8, 8}, 300)));
}

TEST(NaturalTones, TexturesAreTheSameOnAnyNumberOfThreadsAndExaggerationKeepsTheirColours) {
    const Heightfield ground = naturalGround(
        50, 40, 30, [](int i, int j) { return 900 + 300 * std::sin(0.2 * i) * std::cos(0.1 * j); });
    TerrainLook unlit;
    unlit.ambient = 1;
    const auto texture = [&](const Heightfield& of, double scale) {
        Progress progress;
        return tintedGround(of, unlit, placed(46, scale), progress).texture;
    };
    const int before = threadCount();
    setThreadCount(1);
    const ColorTexture one = texture(ground, 1);
    setThreadCount(4);
    const ColorTexture four = texture(ground, 1);
    setThreadCount(before);
    const Heightfield high = naturalGround(
        50, 40, 30, [](int i, int j) { return 2 * (900 + 300 * std::sin(0.2 * i) * std::cos(0.1 * j)); });
    const ColorTexture shown = texture(high, 2);
    ASSERT_EQ(one.byteCount(), four.byteCount());
    for (int y = 0; y < 80; ++y)
        for (int x = 0; x < 100; ++x) {
            const PackedColor color = one.level(0).at(x, y);
            ASSERT_EQ(color, four.level(0).at(x, y));
            ASSERT_LT(glm::distance(unpackColor(color), unpackColor(shown.level(0).at(x, y))), 0.03f);
        }
}

}  // namespace
}  // namespace stereonav
