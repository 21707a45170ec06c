// Rivalry of eyes whose pictures are made by hand, over ground of one depth with a pillar before it.
#include "engine/metrics/rivalry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/base/error.h"
#include "engine/metrics/image_difference.h"
#include "engine/metrics/srgb_levels.h"

namespace stereonav {
namespace {

constexpr int kWidth = 24, kHeight = 3;
constexpr float kFar = 10, kNear = 2;

// Returns eyes for which columns of the far depth are the left eye's, and of the near depth 4 further left.
StereoViews eyes() {
    StereoViews views;
    views.parallaxScale = 10;
    views.shiftAtInfinity = 1;
    return views;
}

PackedColor grey(int byte) {
    const std::uint32_t c = packedFromSrgbByte()[static_cast<std::size_t>(byte)];
    return c | c << 10 | c << 20;
}

double stepUp(int byte) {
    return srgbLevels(grey(byte + 1)).x - srgbLevels(grey(byte)).x;
}

template <typename T>
Plane<T> filled(T value) {
    Plane<T> plane(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) plane.at(x, y) = value;
    return plane;
}

// Depths that are near in columns x0 .. x1 - 1.
Plane<float> pillar(int x0, int x1) {
    Plane<float> depths = filled(kFar);
    for (int y = 0; y < kHeight; ++y)
        for (int x = x0; x < x1; ++x) depths.at(x, y) = kNear;
    return depths;
}

struct HandMade {
    Plane<float> columns = columnsInRightEye(eyes(), pillar(10, 14), pillar(6, 10));
    Plane<PackedColor> left = filled(grey(100)), right = filled(grey(100));
    Plane<std::uint8_t> mask = filled<std::uint8_t>(0);
};

TEST(Rivalry, ColumnsAreWhereTheOtherEyeSeesAPoint) {
    const Plane<float> columns = HandMade().columns;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const bool onPillar = x >= 10 && x < 14, behindIt = x >= 6 && x < 10;
            EXPECT_EQ(columns.at(x, y), behindIt ? -1 : onPillar ? x - 4 : x) << x;
        }
}

TEST(Rivalry, OfSkyToo) {
    const auto sky = filled(std::numeric_limits<float>::infinity());
    const Plane<float> columns = columnsInRightEye(eyes(), sky, sky);
    for (int x = 0; x < kWidth; ++x) EXPECT_EQ(columns.at(x, 0), x + 1 < kWidth ? x + 1 : -1) << x;
    const Plane<float> unknown = columnsInRightEye(eyes(), filled(0.0f), sky);
    EXPECT_EQ(unknown.at(3, 1), -1);
}

TEST(Rivalry, EqualEyesHaveNone) {
    const HandMade h;
    const Rivalry r = rivalryOf(h.columns, {h.left, h.right}, {h.left, h.right}, h.mask);
    EXPECT_EQ(r.psnr_db, kIdenticalPsnr_db);
    EXPECT_TRUE(std::isnan(r.edge_psnr_db)) << "there are no edges";
    EXPECT_DOUBLE_EQ(r.seen_percent, 100.0 * 20 / 24);
}

TEST(Rivalry, WhatBothEyesHaveWrongIsNone) {
    const HandMade h;
    const auto wrong = filled(grey(140));
    EXPECT_EQ(rivalryOf(h.columns, {h.left, h.right}, {wrong, wrong}, h.mask).psnr_db, kIdenticalPsnr_db);
}

TEST(Rivalry, WhatTheTruthsShowDifferentlyIsNone) {
    const HandMade h;
    const auto lit = filled(grey(180));
    EXPECT_EQ(rivalryOf(h.columns, {h.left, lit}, {h.left, lit}, h.mask).psnr_db, kIdenticalPsnr_db);
    EXPECT_LT(rivalryOf(h.columns, {h.left, lit}, {h.left, h.left}, h.mask).psnr_db, 15)
        << "a highlight lost";
}

TEST(Rivalry, OneLevelInOneEyeIsOneLevel) {
    const HandMade h;
    const auto brighter = filled(grey(101));
    const double expected = 20 * std::log10(255.0 / stepUp(100));
    EXPECT_NEAR(expected, 48.13, 1.0);
    EXPECT_NEAR(rivalryOf(h.columns, {h.left, h.right}, {h.left, brighter}, h.mask).psnr_db, expected, 1e-3);
    EXPECT_NEAR(rivalryOf(h.columns, {h.left, h.right}, {brighter, h.right}, h.mask).psnr_db, expected, 1e-3);
}

// What one eye alone sees may be anything.
TEST(Rivalry, HiddenPixelsAreLeftOut) {
    HandMade h;
    Plane<PackedColor> left = h.left, right = h.right;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 6; x < 10; ++x) left.at(x, y) = grey(250);  // behind the pillar for the right eye
        for (int x = 10; x < 14; ++x) right.at(x, y) = grey(3);  // behind it for the left one
    }
    EXPECT_EQ(rivalryOf(h.columns, {h.left, h.right}, {left, right}, h.mask).psnr_db, kIdenticalPsnr_db);
    right.at(6, 1) = grey(120);  // on it
    EXPECT_LT(rivalryOf(h.columns, {h.left, h.right}, {left, right}, h.mask).psnr_db, 50);
}

// Two pixels of three rows are off, both in the mask with the rest of their columns.
TEST(Rivalry, InsideTheMask) {
    HandMade h;
    Plane<PackedColor> right = h.right;
    right.at(2, 0) = right.at(3, 2) = grey(101);
    for (int y = 0; y < kHeight; ++y) h.mask.at(2, y) = h.mask.at(3, y) = 255;
    const Rivalry r = rivalryOf(h.columns, {h.left, h.right}, {h.left, right}, h.mask);
    const double level = 20 * std::log10(255.0 / stepUp(100));
    EXPECT_NEAR(r.edge_psnr_db, level + 10 * std::log10(6 / 2.0), 1e-3);
    EXPECT_NEAR(r.psnr_db, level + 10 * std::log10(60 / 2.0), 1e-3);
}

// Half a pixel to the right: between two pixels of the right eye.
TEST(Rivalry, IsInterpolatedBetweenPixels) {
    StereoViews views = eyes();
    views.shiftAtInfinity = 1.5;
    const auto depths = filled(kFar);
    const Plane<float> columns = columnsInRightEye(views, depths, depths);
    EXPECT_FLOAT_EQ(columns.at(4, 0), 4.5f);
    EXPECT_EQ(columns.at(kWidth - 1, 0), -1) << "beyond the edge";
    const auto truth = filled(grey(100));
    Plane<PackedColor> right = truth;
    right.at(5, 0) = grey(101);
    const Rivalry r = rivalryOf(columns, {truth, truth}, {truth, right}, filled<std::uint8_t>(0));
    // two places have half of it each, of 23 in each row
    EXPECT_NEAR(r.psnr_db, 20 * std::log10(255.0 / stepUp(100)) + 10 * std::log10(3 * 23 / 0.5), 1e-3);
}

TEST(Rivalry, NeedsPicturesOfOneSize) {
    const HandMade h;
    const Plane<PackedColor> small(3, 3);
    EXPECT_THROW(rivalryOf(h.columns, {h.left, h.right}, {h.left, small}, h.mask), Error);
    EXPECT_THROW(rivalryOf(h.columns, {h.left, h.right}, {h.left, h.right}, Plane<std::uint8_t>()), Error);
    EXPECT_THROW(columnsInRightEye(eyes(), Plane<float>(4, 4), Plane<float>(4, 5)), Error);
}

}  // namespace
}  // namespace stereonav
