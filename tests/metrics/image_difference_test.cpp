// Image differences against values worked out by hand.
#include "engine/metrics/image_difference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.h"
#include "engine/image/opencv/byte_image.h"
#include "engine/metrics/difference_picture.h"

namespace stereonav {
namespace {

Plane<PackedColor> bytes(int width, int height, const cv::Vec3b& bgr) {
    return planeFromBytes(cv::Mat(height, width, CV_8UC3, cv::Scalar(bgr[0], bgr[1], bgr[2])));
}

Plane<std::uint8_t> mask(int width, int height, std::uint8_t value) {
    Plane<std::uint8_t> plane(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) plane.at(x, y) = value;
    return plane;
}

TEST(ByteImage, EveryByteSurvivesTheWayThroughAPlane) {
    cv::Mat image(1, 256, CV_8UC3);
    for (int i = 0; i < 256; ++i)
        image.at<cv::Vec3b>(0, i) =
            cv::Vec3b(static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(255 - i), 7);
    const cv::Mat back = bytesFromPlane(planeFromBytes(image));
    for (int i = 0; i < 256; ++i) EXPECT_EQ(back.at<cv::Vec3b>(0, i), image.at<cv::Vec3b>(0, i)) << i;
}

TEST(ImageDifference, IdenticalPicturesGiveTheCap) {
    const auto image = bytes(40, 30, {10, 200, 90});
    const ImageDifference d = differenceOf(image, image, mask(40, 30, 255));
    EXPECT_EQ(d.psnr_db, kIdenticalPsnr_db);
    EXPECT_EQ(d.edge_psnr_db, kIdenticalPsnr_db);
    EXPECT_NEAR(d.ssim, 1.0, 1e-6);
    EXPECT_EQ(d.rgb_mean, 0.0);
    EXPECT_EQ(d.rgb_max, 0.0);
}

// A constant offset (1, 2, 2): mean square (1 + 4 + 4) / 3 = 3, distance sqrt(9) = 3.
TEST(ImageDifference, ConstantOffset) {
    const auto a = bytes(32, 32, {100, 100, 100}), b = bytes(32, 32, {101, 102, 102});
    const ImageDifference d = differenceOf(a, b, mask(32, 32, 255));
    const double expected = 10.0 * std::log10(255.0 * 255.0 / 3.0);
    EXPECT_NEAR(d.psnr_db, expected, 1e-9);
    EXPECT_NEAR(d.edge_psnr_db, expected, 1e-9);
    EXPECT_NEAR(psnrOf(a, b), expected, 1e-9);
    EXPECT_NEAR(d.rgb_mean, 3.0, 1e-6);
    EXPECT_NEAR(d.rgb_p99, 3.0, 1e-6);
    EXPECT_NEAR(d.rgb_max, 3.0, 1e-6);
    // Flat pictures: only the luminance term of SSIM, (2 m n + C1) / (m^2 + n^2 + C1), C1 = 6.5025.
    const auto luminance = [](double m, double n) { return (2 * m * n + 6.5025) / (m * m + n * n + 6.5025); };
    EXPECT_NEAR(d.ssim, (luminance(100, 101) + 2 * luminance(100, 102)) / 3, 1e-4);
}

TEST(ImageDifference, PercentileAndMaximumOfAFewBadPixels) {
    auto a = bytes(20, 10, {50, 50, 50});  // 200 pixels: 99 % are 198
    auto b = a;
    const PackedColor off = bytes(1, 1, {50, 50, 60}).at(0, 0), far = bytes(1, 1, {50, 50, 80}).at(0, 0);
    b.at(3, 4) = far;
    b.at(19, 9) = far;
    EXPECT_EQ(differenceOf(a, b, mask(20, 10, 0)).rgb_p99, 0.0);
    b.at(7, 7) = off;
    const ImageDifference d = differenceOf(a, b, mask(20, 10, 0));
    EXPECT_NEAR(d.rgb_p99, 10.0, 1e-6);
    EXPECT_NEAR(d.rgb_max, 30.0, 1e-6);
    EXPECT_NEAR(d.rgb_mean, (30.0 + 30.0 + 10.0) / 200, 1e-6);
    EXPECT_EQ(d.edge_psnr_db, kIdenticalPsnr_db) << "an empty mask holds no error";
}

TEST(ImageDifference, OnlyTheMaskCountsForTheEdgeFigure) {
    const auto a = bytes(8, 8, {0, 0, 0});
    auto b = a;
    b.at(2, 2) = bytes(1, 1, {30, 30, 30}).at(0, 0);
    auto m = mask(8, 8, 0);
    m.at(2, 2) = m.at(3, 2) = 1;
    EXPECT_NEAR(differenceOf(a, b, m).edge_psnr_db, 10 * std::log10(255.0 * 255.0 / 450.0), 1e-6);
}

TEST(ImageDifference, OnePixelWorksAndSizesAreChecked) {
    const auto one = bytes(1, 1, {1, 2, 3});
    EXPECT_EQ(differenceOf(one, one, mask(1, 1, 0)).psnr_db, kIdenticalPsnr_db);
    EXPECT_THROW(psnrOf(one, bytes(2, 1, {0, 0, 0})), Error);
    EXPECT_THROW(psnrOf(Plane<PackedColor>(), Plane<PackedColor>()), Error);
    EXPECT_THROW(differenceOf(one, one, mask(2, 1, 0)), Error);
}

TEST(EdgeMask, MarksHolesAndBothSidesOfDepthEdges) {
    Plane<float> depth(20, 9);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 20; ++x) depth.at(x, y) = x < 10 ? 10.0f : 100.0f;
    auto holes = mask(20, 9, 0);
    holes.at(0, 0) = 255;
    // parallax 10 against 1 pixels at x = 9 | 10; grown by one: 8..11
    const auto marked = edgeMask(holes, depth, 100.0, 1);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 20; ++x) {
            const bool expected = (x >= 8 && x <= 11) || (x <= 1 && y <= 1);
            EXPECT_EQ(marked.at(x, y) != 0, expected) << x << " " << y;
        }
    // parallax 0.1 against 0.01: no edge
    EXPECT_EQ(edgeMask(holes, depth, 1.0, 0).at(9, 4), 0);
    EXPECT_NE(edgeMask(holes, depth, 1.0, 0).at(0, 0), 0);
}

TEST(EdgeMask, TheHorizonIsAnEdgeOnlyWhereTheGroundHasParallax) {
    Plane<float> depth(1, 4);
    for (int y = 0; y < 4; ++y) depth.at(0, y) = y < 2 ? kMissDepth : 50.0f;
    EXPECT_NE(edgeMask({}, depth, 100.0, 0).at(0, 1), 0);
    EXPECT_EQ(edgeMask({}, depth, 10.0, 0).at(0, 1), 0);
}

TEST(DifferencePicture, HolesAreRedAndDifferencesAreTimesFive) {
    const auto a = bytes(4, 2, {10, 20, 30}), b = bytes(4, 2, {12, 20, 130});
    const cv::Mat times = bytesFromPlane(differenceTimes(a, b, 5));
    auto holes = mask(4, 2, 0);
    holes.at(3, 1) = 255;
    const cv::Mat red = bytesFromPlane(holesInRed(a, holes));
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 4; ++x) {
            EXPECT_EQ(times.at<cv::Vec3b>(y, x), cv::Vec3b(10, 0, 255));
            EXPECT_EQ(red.at<cv::Vec3b>(y, x),
                      x == 3 && y == 1 ? cv::Vec3b(0, 0, 255) : cv::Vec3b(10, 20, 30));
        }
    EXPECT_THROW(holesInRed(a, mask(1, 1, 0)), Error);
}

}  // namespace
}  // namespace stereonav
