// Butteraugli through libjxl: what it must say of pictures whose differences are plain to see, and our own
// parts.
#include "engine/metrics/butteraugli.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

PackedColor greyByteOf(int byte) {
    const std::uint32_t c = packedFromSrgbByte()[static_cast<std::size_t>(byte)];
    return c | c << 10 | c << 20;
}

Plane<PackedColor> slope(int width, int height) {
    Plane<PackedColor> picture(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) picture.at(x, y) = greyByteOf(60 + (3 * x + 5 * y) % 120);
    return picture;
}

// A picture that is brighter by `levels` in columns 40 .. 47 of rows 20 .. 27.
Plane<PackedColor> withPatch(int levels) {
    Plane<PackedColor> picture = slope(96, 64);
    for (int y = 20; y < 28; ++y)
        for (int x = 40; x < 48; ++x) picture.at(x, y) = greyByteOf(60 + (3 * x + 5 * y) % 120 + levels);
    return picture;
}

Plane<std::uint8_t> maskOf(int width, int height, int x0, int x1) {
    Plane<std::uint8_t> mask(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) mask.at(x, y) = x >= x0 && x < x1 ? 255 : 0;
    return mask;
}

TEST(Butteraugli, EqualPicturesAreAtNoDistance) {
    const auto picture = slope(96, 64);
    const ButteraugliMap map = butteraugliOf(picture, picture);
    EXPECT_EQ(map.norm3, 0.0);
    EXPECT_EQ(map.max, 0.0);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 96; ++x) ASSERT_EQ(map.distances.at(x, y), 0.0f);
}

TEST(Butteraugli, LargerErrorsAreFurtherAwayAndTheMapShowsWhere) {
    const auto truth = slope(96, 64);
    const ButteraugliMap faint = butteraugliOf(truth, withPatch(2)),
                         plain = butteraugliOf(truth, withPatch(60));
    EXPECT_GT(faint.max, 0.0);
    EXPECT_LT(faint.max, 1.0) << "two levels are not noticed";
    EXPECT_GT(plain.max, 3.0);
    EXPECT_GT(plain.norm3, 2 * faint.norm3);
    EXPECT_LT(plain.norm3, plain.max);
    EXPECT_GT(plain.distances.at(44, 24), 5 * plain.distances.at(90, 60));
    double most = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 96; ++x) most = std::max(most, static_cast<double>(plain.distances.at(x, y)));
    EXPECT_NEAR(most, plain.max, 1e-6);
}

TEST(Butteraugli, PartsAreCountedAsLibjxlCountsTheWhole) {
    const ButteraugliMap map = butteraugliOf(slope(96, 64), withPatch(40));
    const ButteraugliParts whole = partsOf(map.distances, maskOf(96, 64, 0, 96));
    EXPECT_NEAR(whole.inside, map.norm3, 1e-4 * map.norm3);
    EXPECT_TRUE(std::isnan(whole.outside));
    const ButteraugliParts parts = partsOf(map.distances, maskOf(96, 64, 36, 52));
    EXPECT_GT(parts.inside, map.norm3);
    EXPECT_LT(parts.outside, map.norm3);
    EXPECT_THROW(partsOf(map.distances, maskOf(96, 63, 0, 1)), Error);
}

TEST(Butteraugli, PartsOfAMapMadeByHand) {
    Plane<float> distances(4, 1);
    const float values[] = {1, 1, 2, 0};
    for (int x = 0; x < 4; ++x) distances.at(x, 0) = values[x];
    const ButteraugliParts parts = partsOf(distances, maskOf(4, 1, 0, 2));
    EXPECT_NEAR(parts.inside, 1.0, 1e-12);
    // half of its pixels at 2
    const double expected =
        2 * (std::pow(0.5, 1.0 / 3) + std::pow(0.5, 1.0 / 6) + std::pow(0.5, 1.0 / 12)) / 3;
    EXPECT_NEAR(parts.outside, expected, 1e-12);
    const Plane<PackedColor> picture = pictureOf(distances);
    EXPECT_EQ(picture.at(3, 0), 0u);
    EXPECT_NEAR(srgbByteFromPacked()[picture.at(0, 0) & 1023], 128, 1);
    EXPECT_EQ(srgbByteFromPacked()[picture.at(2, 0) >> 20], 255);
}

TEST(Butteraugli, DoesNotDependOnThreads) {
    const auto truth = slope(131, 77), image = [&] {
        Plane<PackedColor> other = slope(131, 77);
        for (int y = 0; y < 77; ++y) other.at((7 * y) % 131, y) = greyByteOf(250);
        return other;
    }();
    const int threads = threadCount();
    setThreadCount(1);
    const ButteraugliMap one = butteraugliOf(truth, image);
    setThreadCount(3);
    const ButteraugliMap three = butteraugliOf(truth, image);
    setThreadCount(threads);
    EXPECT_EQ(one.norm3, three.norm3);
    for (int y = 0; y < 77; ++y)
        for (int x = 0; x < 131; ++x) ASSERT_EQ(one.distances.at(x, y), three.distances.at(x, y));
}

TEST(Butteraugli, OfAnySize) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 40}, {7, 8}, {8, 8}, {33, 5}, {130, 9}}) {
        const auto truth = slope(width, height);
        Plane<PackedColor> image = truth;
        image.at(width - 1, height - 1) = greyByteOf(255);
        const ButteraugliMap map = butteraugliOf(truth, image);
        EXPECT_EQ(map.distances.width(), width);
        EXPECT_EQ(map.distances.height(), height);
        EXPECT_TRUE(std::isfinite(map.max)) << width << "x" << height;
        EXPECT_GT(map.max, 0.3) << width << "x" << height;
        EXPECT_EQ(butteraugliOf(truth, truth).max, 0.0);
    }
    EXPECT_THROW(butteraugliOf(slope(9, 9), slope(9, 8)), Error);
    EXPECT_THROW(butteraugliOf({}, {}), Error);
}

}  // namespace
}  // namespace stereonav
