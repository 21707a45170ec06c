// Flicker of pictures whose changes are known by hand.
#include "engine/metrics/flicker.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.h"
#include "engine/metrics/image_difference.h"
#include "engine/metrics/srgb_levels.h"

namespace stereonav {
namespace {

PackedColor greyOf(int byte) {
    const std::uint32_t c = packedFromSrgbByte()[static_cast<std::size_t>(byte)];
    return c | c << 10 | c << 20;
}

Plane<PackedColor> painted(int byte) {
    Plane<PackedColor> picture(20, 10);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 20; ++x) picture.at(x, y) = greyOf(byte);
    return picture;
}

TEST(Flicker, LevelsAreThoseOfTheBytesWithoutRounding) {
    for (int packed = 0; packed < 1024; ++packed) {
        const float level = srgbLevelFromPacked()[static_cast<std::size_t>(packed)];
        EXPECT_EQ(static_cast<int>(level + 0.5f),
                  int{srgbByteFromPacked()[static_cast<std::size_t>(packed)]});
    }
    EXPECT_EQ(srgbLevelFromPacked()[0], 0.0f);
    EXPECT_NEAR(srgbLevelFromPacked()[1023], 255.0f, 1e-4f);
}

TEST(Flicker, WhatChangesAsTheTruthDoesCostsNothing) {
    const auto a = painted(100), b = painted(140);
    EXPECT_EQ(flickerPsnr({a, b}, {a, b}), kIdenticalPsnr_db);
    EXPECT_EQ(flickerPsnr({a, a}, {b, b}), kIdenticalPsnr_db) << "wrong by 40 levels, and it stays so";
}

// One pixel of 200 is wrong in one of the frames.
TEST(Flicker, AnErrorThatComesOrGoesCosts) {
    const auto truth = painted(100);
    auto spot = truth;
    spot.at(7, 3) = greyOf(120);
    const double off = srgbLevels(greyOf(120)).x - srgbLevels(greyOf(100)).x;
    const double expected = 10 * std::log10(255.0 * 255.0 / (off * off / 200));
    EXPECT_NEAR(flickerPsnr({truth, truth}, {truth, spot}), expected, 1e-3);
    EXPECT_NEAR(flickerPsnr({truth, truth}, {spot, truth}), expected, 1e-3);
    EXPECT_EQ(flickerPsnr({truth, truth}, {spot, spot}), kIdenticalPsnr_db);
    // at another place in the other frame: twice the squares
    auto moved = truth;
    moved.at(8, 3) = greyOf(120);
    EXPECT_NEAR(flickerPsnr({truth, truth}, {spot, moved}), expected - 10 * std::log10(2.0), 1e-3);
}

// The truth brightens and the picture does not.
TEST(Flicker, WhatStandsStillWhereTheTruthMovesCosts) {
    const auto dark = painted(100), light = painted(110);
    const double off = srgbLevels(greyOf(110)).x - srgbLevels(greyOf(100)).x;
    EXPECT_NEAR(flickerPsnr({dark, light}, {dark, dark}), 20 * std::log10(255.0 / off), 1e-3);
}

TEST(Flicker, NeedsPicturesOfOneSize) {
    const auto a = painted(1);
    EXPECT_THROW(flickerPsnr({a, a}, {a, Plane<PackedColor>(20, 9)}), Error);
    EXPECT_THROW(flickerPsnr({a, Plane<PackedColor>(19, 10)}, {a, a}), Error);
    const Plane<PackedColor> none;
    EXPECT_THROW(flickerPsnr({none, none}, {none, none}), Error);
}

}  // namespace
}  // namespace stereonav
