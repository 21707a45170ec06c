// Pictures in more pixels than they were made in.
#include "engine/image/enlarge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace stereonav {
namespace {

EyeImage enlarged(const EyeImage& image, int width, int height) {
    EyeImage large;
    enlarge(image, width, height, large);
    return large;
}

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

// Every channel is enlarged by itself, whatever lies beside it.
TEST(Enlarged, EachChannelIsBilinear) {
    constexpr int kWidth = 13, kHeight = 7;
    EyeImage image;
    image.resize(kWidth, kHeight);
    std::mt19937 random(5);
    std::uniform_int_distribution<int> anything(0, 1023), end(0, 1);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            PackedColor c = 0;
            for (const int shift : {0, 10, 20})
                c |= static_cast<PackedColor>(y % 2 ? anything(random) : 1023 * end(random)) << shift;
            image.color.at(x, y) = c;
            image.viewDepth.at(x, y) = 1;
        }
    for (const auto& [width, height] : {std::pair{13, 7}, {14, 8}, {29, 40}, {64, 7}}) {
        const EyeImage large = enlarged(image, width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (const int shift : {0, 10, 20}) {
                    const double u = (x + 0.5) * kWidth / width - 0.5, v = (y + 0.5) * kHeight / height - 0.5;
                    const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
                    // weights as they are kept: 256ths
                    const double a = std::lround(256 * (u - i)) / 256.0,
                                 b = std::lround(256 * (v - j)) / 256.0;
                    const auto channel = [&](int p, int q) {
                        return image.color.at(std::clamp(p, 0, kWidth - 1), std::clamp(q, 0, kHeight - 1)) >>
                                   shift &
                               1023u;
                    };
                    const double wanted = (1 - b) * ((1 - a) * channel(i, j) + a * channel(i + 1, j)) +
                                          b * ((1 - a) * channel(i, j + 1) + a * channel(i + 1, j + 1));
                    ASSERT_EQ(large.color.at(x, y) >> shift & 1023u, std::floor(wanted + 0.5))
                        << width << "x" << height << " " << x << "," << y << " " << shift;
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
