// Pictures in more pixels than they were made in.
#include "engine/image/enlarge.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stereonav {
namespace {

EyeImage rampOf(int width, int height, int perColumn, int perRow) {
    EyeImage image;
    image.resize(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto c = static_cast<PackedColor>(100 + perColumn * x + perRow * y);
            image.color.at(x, y) = c | c / 2 << 10 | (1023 - c) << 20;
            image.viewDepth.at(x, y) = static_cast<float>(1 + x + 100 * y);
        }
    return image;
}

TEST(Enlarged, TheSameSizeIsTheSamePicture) {
    const EyeImage image = rampOf(7, 5, 40, 30), same = enlarged(image, 7, 5);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 7; ++x) {
            EXPECT_EQ(same.color.at(x, y), image.color.at(x, y));
            EXPECT_EQ(same.viewDepth.at(x, y), image.viewDepth.at(x, y));
        }
}

// What is linear stays linear between the outermost centres, and is constant beyond them.
TEST(Enlarged, ARampStaysARamp) {
    const int from = 9;
    const EyeImage image = rampOf(from, 6, 40, 60);
    for (const int width : {10, 13, 18, 27}) {
        const EyeImage large = enlarged(image, width, 11);
        for (int y = 0; y < 11; ++y)
            for (int x = 0; x < width; ++x) {
                const double column = std::clamp((x + 0.5) * from / width - 0.5, 0.0, from - 1.0);
                const double row = std::clamp((y + 0.5) * 6 / 11 - 0.5, 0.0, 5.0);
                const double wanted = 100 + 40 * column + 60 * row;
                EXPECT_NEAR(large.color.at(x, y) & 1023u, wanted, 0.5 + 40.0 / 512 + 60.0 / 512 + 1e-9)
                    << width << " " << x << " " << y;
            }
    }
}

TEST(Enlarged, DepthsAreThoseThatWereSeen) {
    const EyeImage large = enlarged(rampOf(4, 3, 1, 1), 8, 6);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 8; ++x)
            EXPECT_EQ(large.viewDepth.at(x, y), static_cast<float>(1 + x / 2 + 100 * (y / 2)));
}

TEST(Enlarged, OnePixelAndStrips) {
    EyeImage one = rampOf(1, 1, 0, 0);
    one.viewDepth.at(0, 0) = kMissDepth;
    for (const auto& [width, height] : {std::pair{1, 1}, {5, 1}, {1, 5}, {3, 4}}) {
        const EyeImage large = enlarged(one, width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                EXPECT_EQ(large.color.at(x, y), one.color.at(0, 0));
                EXPECT_EQ(large.viewDepth.at(x, y), kMissDepth);
            }
    }
}

TEST(Enlarged, FullWhiteStaysFullWhite) {
    EyeImage white;
    white.resize(3, 2);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x) white.color.at(x, y) = 0x3fffffffu;
    const EyeImage large = enlarged(white, 17, 9);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 17; ++x) EXPECT_EQ(large.color.at(x, y), 0x3fffffffu);
}

}  // namespace
}  // namespace stereonav
