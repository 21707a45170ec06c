// The ground's texture: orientation, sizes of the levels, and light kept through them.
#include "engine/image/color_texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
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

TEST(ColorTexture, ReadsPlacesBetweenTexelsAndLevels) {
    const ColorTexture texture(randomImage(13, 6), {-0.5, 2}, {0.5, 0.25});
    const auto root = [](const glm::vec3& linear) { return glm::sqrt(linear); };
    for (int k = 0; k < texture.levelCount(); ++k) {
        const ColorTexture::Level level = texture.level(k);
        const double size = 1 << k;
        const auto gridOf = [&](double x, double y) {  // grid coordinates of texels of that level
            return glm::dvec2(-0.5, 2) + glm::dvec2(x, y) * size * glm::dvec2(0.5, 0.25);
        };
        for (int y = 0; y < level.height(); ++y)
            for (int x = 0; x < level.width(); ++x) {
                const glm::vec3 here = unpackColor(level.at(x, y));
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(texture.at(gridOf(x + 0.5, y + 0.5), k)[c], here[c], 1e-5);
                // Halfway to the east, in roots; the last texel is repeated.
                const glm::vec3 between =
                    0.5f * (root(here) + root(unpackColor(level.at(std::min(x + 1, level.width() - 1), y))));
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(texture.at(gridOf(x + 1, y + 0.5), k)[c], between[c] * between[c], 1e-5);
            }
    }
    // A level holds on for a quarter of the way to the next, and from three quarters on it is that.
    const glm::dvec2 place(1.1, 2.7);
    EXPECT_EQ(texture.at(place, 0.25), texture.at(place, 0));
    EXPECT_EQ(texture.at(place, 0.75), texture.at(place, 1));
    EXPECT_EQ(texture.at(place, -3), texture.at(place, 0));
    EXPECT_EQ(texture.at(place, 99), texture.at(place, texture.levelCount() - 1));
    const glm::vec3 middle = 0.5f * (root(texture.at(place, 1)) + root(texture.at(place, 2)));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(texture.at(place, 1.5)[c], middle[c] * middle[c], 1e-5);
    for (const glm::dvec2& outside : {glm::dvec2(-90, 2.1), glm::dvec2(900, 2.1)})
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(texture.at(outside, 0)[c],
                        texture.at({outside.x < 0 ? -0.25 : 5.75, outside.y}, 0)[c], 1e-5);
}

}  // namespace
}  // namespace stereonav
