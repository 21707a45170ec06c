// The ground's texture: orientation, sizes of the levels, and light kept through them.
#include "terrain/color_texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace stereonav {
namespace {

Plane<PackedColor> randomImage(int width, int height) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> value(0, 1);
    Plane<PackedColor> image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y) = packColor({value(random), value(random), value(random)});
    return image;
}

TEST(ColorTexture, FirstLevelIsTheImageSouthRowFirst) {
    const auto image = randomImage(13, 7);
    const ColorTexture texture(image, {-0.5, -0.5}, {0.5, 0.25});
    EXPECT_EQ(texture.gridOrigin(), glm::dvec2(-0.5, -0.5));
    EXPECT_EQ(texture.gridPerTexel(), glm::dvec2(0.5, 0.25));
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 13; ++x) EXPECT_EQ(texture.level(0).at(x, 6 - y), image.at(x, y));
}

TEST(ColorTexture, LevelsHalveRoundingUp) {
    const ColorTexture texture(randomImage(13, 5), {}, {1, 1});
    const int widths[] = {13, 7, 4, 2, 1}, heights[] = {5, 3, 2, 1, 1};
    ASSERT_EQ(texture.levelCount(), 5);
    std::size_t bytes = 0;
    for (int k = 0; k < 5; ++k) {
        EXPECT_EQ(texture.level(k).width(), widths[k]);
        EXPECT_EQ(texture.level(k).height(), heights[k]);
        EXPECT_EQ(texture.level(k).row(0), texture.data() + texture.offset(k));
        bytes += static_cast<std::size_t>(widths[k] + 1) * (heights[k] + 1) * sizeof(PackedColor);
    }
    EXPECT_EQ(texture.byteCount(), bytes);
}

TEST(ColorTexture, LastColumnAndRowAreRepeated) {
    const ColorTexture texture(randomImage(13, 5), {}, {1, 1});
    for (int k = 0; k < texture.levelCount(); ++k) {
        const ColorTexture::Level level = texture.level(k);
        for (int y = 0; y <= level.height(); ++y)
            EXPECT_EQ(level.at(level.width(), y),
                      level.at(level.width() - 1, std::min(y, level.height() - 1)));
        for (int x = 0; x < level.width(); ++x)
            EXPECT_EQ(level.at(x, level.height()), level.at(x, level.height() - 1));
    }
}

TEST(ColorTexture, AveragesInLinearLight) {
    // For a side of a power of two the last level is the mean of everything, in linear light.
    const auto image = randomImage(64, 64);
    glm::dvec3 mean(0.0);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) mean += glm::dvec3(unpackColor(image.at(x, y))) / 4096.0;
    const ColorTexture texture(image, {}, {1, 1});
    const glm::vec3 last = unpackColor(texture.level(texture.levelCount() - 1).at(0, 0));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(last[k], mean[k], 2e-3);
    // Black and white stripes give half the light, not half the code.
    Plane<PackedColor> stripes(8, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) stripes.at(x, y) = packColor(glm::vec3(x % 2 ? 1.0f : 0.0f));
    const ColorTexture striped(stripes, {}, {1, 1});
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) EXPECT_NEAR(unpackColor(striped.level(1).at(x, y)).x, 0.5f, 1e-3f);
}

}  // namespace
}  // namespace stereonav
