// The map of a terrain: where things lie on it, what it shows, and that its cost goes with its pixels.
#include "terrain/scene/ground_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

GroundMap mapOf(const TerrainScene& terrain, int most) {
    Progress progress;
    return mapOfGround(terrain, most, progress);
}

float mapBrightness(const GroundMap& map, int x, int y) {
    const glm::vec3 color = unpackColor(map.picture.at(x, y));
    return (color.x + color.y + color.z) / 3;
}

// A ground of one colour, which holds no light.
TerrainScene mapScene(Heightfield ground) {
    TerrainScene scene;
    Plane<PackedColor> texels(2, 2);
    for (int k = 0; k < 4; ++k) texels.at(k % 2, k / 2) = packColor(glm::vec3(0.3f));
    const glm::dvec2 cells(ground.width() - 1, ground.height() - 1);
    scene.color = ColorTexture(texels, glm::dvec2(0.0), 0.5 * cells);
    scene.ground = std::move(ground);
    return scene;
}

Heightfield heightsOf(int width, int height, const std::function<float(int, int)>& at) {
    std::vector<float> heights;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) heights.push_back(at(i, j));
    return Heightfield(width, height, {30, 25}, std::move(heights), "test");
}

TEST(GroundMap, LiesWhereTheGroundLies) {
    const TerrainScene scene = mapScene(test::makeGround("smooth", 101, 61, 1));
    for (const int most : {1, 2, 7, 100, 333}) {
        const GroundMap map = mapOf(scene, most);
        EXPECT_EQ(std::max(map.picture.width(), map.picture.height()), most);
        EXPECT_NEAR(map.metresPerPixel, 3000.0 / most, 1e-9);
        EXPECT_EQ(map.picture.height(), std::max(1, static_cast<int>(std::lround(most / 2.0))));
        EXPECT_NEAR(map.northWest.x, -1500, 1e-9);
        EXPECT_NEAR(map.northWest.y, 750, 1e-9);
    }
    EXPECT_EQ(mapOf(scene, 0).picture.width(), 1);
    EXPECT_EQ(mapOf(scene, -5).picture.width(), 1);
    EXPECT_EQ(mapOf(mapScene(test::makeGround("flat", 200, 2, 1)), 1 << 30).picture.width(), kMostMapPixels);
}

// Colours by quarter: north-west red, north-east green, south-west blue, south-east white.
TEST(GroundMap, NorthIsUpAndEastIsRight) {
    TerrainScene scene = mapScene(test::makeGround("flat", 41, 41, 1));
    Plane<PackedColor> texels(2, 2);  // row 0 northernmost
    texels.at(0, 0) = packColor({1, 0, 0});
    texels.at(1, 0) = packColor({0, 1, 0});
    texels.at(0, 1) = packColor({0, 0, 1});
    texels.at(1, 1) = packColor({1, 1, 1});
    scene.color = ColorTexture(texels, glm::dvec2(0.0), glm::dvec2(20.0));
    const GroundMap map = mapOf(scene, 80);
    const int right = map.picture.width() - 3, bottom = map.picture.height() - 3;
    const auto near = [&](int x, int y, const glm::vec3& color) {
        return glm::distance(unpackColor(map.picture.at(x, y)), color) < 0.1;
    };
    EXPECT_TRUE(near(2, 2, {1, 0, 0}));
    EXPECT_TRUE(near(right, 2, {0, 1, 0}));
    EXPECT_TRUE(near(2, bottom, {0, 0, 1}));
    EXPECT_TRUE(near(right, bottom, {1, 1, 1}));
}

TEST(GroundMap, SlopesTowardsTheNorthWestAreBright) {
    for (const double raise : {0.05, 1.0, 20.0}) {
        // A roof whose ridge runs from south-west to north-east.
        const TerrainScene roof = mapScene(heightsOf(61, 73, [&](int i, int j) {
            return static_cast<float>(-raise * std::abs((30 * i - 900) - (25 * j - 900)) / 10);
        }));
        const GroundMap map = mapOf(roof, 60);
        const float level = 0.3f, bright = mapBrightness(map, 10, 10),
                    dark = mapBrightness(map, map.picture.width() - 11, map.picture.height() - 11);
        EXPECT_GT(bright, level * 1.02f) << raise;
        EXPECT_LT(dark, level * 0.98f) << raise;
    }
    const GroundMap flat = mapOf(mapScene(test::makeGround("flat", 30, 30, 1)), 20);
    EXPECT_NEAR(mapBrightness(flat, 5, 5), 0.3, 0.002);
    // Colours that hold the sun's light are left as they are.
    TerrainScene lit = mapScene(test::makeGround("smooth", 61, 61, 1));
    lit.report.colorHoldsSun = true;
    const GroundMap asItIs = mapOf(lit, 40);
    for (int x = 0; x < 40; ++x) EXPECT_NEAR(mapBrightness(asItIs, x, 20), 0.3, 0.002);
}

TEST(GroundMap, HolesAreHatched) {
    TerrainScene scene = mapScene(test::makeGround("holed", 90, 90, 1));
    const GroundMap map = mapOf(scene, 90);
    // Columns 30 to 44 and rows 30 to 44 from the south are open.
    const int x = 37, y = static_cast<int>((89 - 37) * 25.0 / map.metresPerPixel);
    float least = 1, most = 0;
    for (int d = -4; d <= 4; ++d) {
        least = std::min(least, mapBrightness(map, x + d, y));
        most = std::max(most, mapBrightness(map, x + d, y));
    }
    EXPECT_LT(least, 0.05);
    EXPECT_GT(most, 0.1);
    EXPECT_LT(most, 0.2);
    EXPECT_GT(mapBrightness(map, 5, 5), 0.2);
}

TEST(GroundMap, OnePixelOfTheSmallestGround) {
    const GroundMap map = mapOf(mapScene(test::makeGround("flat", 2, 2, 1)), 1);
    EXPECT_NEAR(mapBrightness(map, 0, 0), 0.3, 0.002);
}

TEST(GroundMap, IsTheSameWithAnyThreads) {
    const TerrainScene scene = mapScene(test::makeGround("rough", 200, 150, 3));
    const int before = threadCount();
    setThreadCount(1);
    const GroundMap one = mapOf(scene, 120);
    setThreadCount(4);
    const GroundMap four = mapOf(scene, 120);
    setThreadCount(before);
    for (int y = 0; y < one.picture.height(); ++y)
        for (int x = 0; x < one.picture.width(); ++x) ASSERT_EQ(one.picture.at(x, y), four.picture.at(x, y));
}

TEST(GroundMap, CanBeCancelled) {
    const TerrainScene scene = mapScene(test::makeGround("rough", 50, 50, 3));
    Progress progress;
    progress.cancel();
    EXPECT_THROW(mapOfGround(scene, 100, progress), Cancelled);
}

}  // namespace
}  // namespace stereonav
