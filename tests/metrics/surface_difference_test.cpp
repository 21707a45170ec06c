// Hole share and error as the stereo paper counts them, on pictures whose counts are known by hand.
#include "engine/metrics/surface_difference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.h"
#include "engine/frame/cast_frames.h"
#include "engine/image/packed_color.h"
#include "engine/metrics/image_difference.h"
#include "engine/metrics/method_comparison.h"
#include "tests/support/analytic_scene.h"

namespace stereonav {
namespace {

// 10 x 4 pixels: the upper two rows are sky, the lower two ground.
EyeImage halfSky(PackedColor ground) {
    EyeImage image;
    image.resize(10, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 10; ++x) {
            image.viewDepth.at(x, y) = y < 2 ? kMissDepth : 100.0f;
            image.color.at(x, y) = y < 2 ? 0u : ground;
        }
    return image;
}

Plane<std::uint8_t> noHoles() {
    Plane<std::uint8_t> mask(10, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 10; ++x) mask.at(x, y) = 0;
    return mask;
}

PackedColor greyByte(int byte) {
    const std::uint32_t c = packedFromSrgbByte()[static_cast<std::size_t>(byte)];
    return c | c << 10 | c << 20;
}

// All of the sky and 4 of the 20 pixels of ground are holes: 4 of 16 warped ones, where all pixels count 60
// %.
TEST(SurfaceDifference, SkyIsNoHole) {
    const EyeImage full = halfSky(greyByte(100));
    Plane<std::uint8_t> mask = noHoles();
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 10; ++x) mask.at(x, y) = 255;
    for (const int x : {0, 4, 8, 9}) mask.at(x, 2) = 255;
    const SurfaceDifference d = surfaceDifference(full, full, mask, false);
    EXPECT_EQ(d.surfacePixels, 20);
    EXPECT_EQ(d.holePixels, 4);
    EXPECT_DOUBLE_EQ(d.holesOfWarped_percent, 25.0);
    EXPECT_EQ(d.psnr_db, kIdenticalPsnr_db);
}

// On the ground 10 pixels are off by 6 levels in each channel: a mean square of 18 over it, 9 over the
// picture.
TEST(SurfaceDifference, ErrorIsThatOfTheSceneAlone) {
    const EyeImage full = halfSky(greyByte(100));
    EyeImage right = halfSky(greyByte(100));
    for (int x = 0; x < 10; ++x) right.color.at(x, 3) = greyByte(106);
    const double expected = 10 * std::log10(255.0 * 255.0 / 18);
    EXPECT_NEAR(surfaceDifference(full, right, noHoles(), false).psnr_db, expected, 1e-9);
    // errors of the sky are none
    for (int x = 0; x < 10; ++x) right.color.at(x, 0) = greyByte(255);
    EXPECT_NEAR(surfaceDifference(full, right, noHoles(), false).psnr_db, expected, 1e-9);
}

// What is left open is no error of what was warped; what is cast counts, wrong or not.
TEST(SurfaceDifference, GapsThatStayOpenAreNotCompared) {
    const EyeImage full = halfSky(greyByte(100));
    EyeImage right = halfSky(greyByte(100));
    Plane<std::uint8_t> mask = noHoles();
    for (int x = 0; x < 5; ++x) {
        right.color.at(x, 2) = 0;
        mask.at(x, 2) = 255;
    }
    EXPECT_EQ(surfaceDifference(full, right, mask, true).psnr_db, kIdenticalPsnr_db);
    EXPECT_NEAR(surfaceDifference(full, right, mask, false).psnr_db,
                10 * std::log10(255.0 * 255.0 / (0.25 * 100 * 100)), 1e-9);
    EXPECT_DOUBLE_EQ(surfaceDifference(full, right, mask, true).holesOfWarped_percent, 100.0 * 5 / 15);
}

TEST(SurfaceDifference, IsNotANumberWhereThereIsNothingToCount) {
    EyeImage sky = halfSky(0);
    for (int y = 2; y < 4; ++y)
        for (int x = 0; x < 10; ++x) sky.viewDepth.at(x, y) = kMissDepth;
    const SurfaceDifference d = surfaceDifference(sky, sky, noHoles(), false);
    EXPECT_TRUE(std::isnan(d.psnr_db));
    EXPECT_TRUE(std::isnan(d.holesOfWarped_percent));
    EXPECT_EQ(d.surfacePixels, 0);
}

TEST(SurfaceDifference, RefusesOtherSizes) {
    const EyeImage full = halfSky(0);
    EXPECT_THROW(surfaceDifference(full, full, Plane<std::uint8_t>(9, 4), false), Error);
    EXPECT_THROW(gapPixels(full, Plane<std::uint8_t>(10, 3)), Error);
}

TEST(GapPixels, AreToldApartByWhatWasWarpedBesideThem) {
    const EyeImage full = halfSky(0);
    Plane<std::uint8_t> mask = noHoles();
    for (const int x : {0, 1, 4, 5, 6, 9}) mask.at(x, 2) = 255;
    for (const int x : {0, 9}) mask.at(x, 0) = 255;  // sky
    const GapPixels gaps = gapPixels(full, mask);
    EXPECT_EQ(gaps.leftEnd, 2);
    EXPECT_EQ(gaps.middle, 3);
    EXPECT_EQ(gaps.rightEnd, 1);
    EXPECT_EQ(gaps.leftEnd + gaps.middle + gaps.rightEnd,
              surfaceDifference(full, full, mask, false).holePixels);
}

TEST(GapPixels, ARowWithoutAnythingWarpedIsOneGap) {
    Plane<std::uint8_t> mask = noHoles();
    for (int x = 0; x < 10; ++x) mask.at(x, 3) = 255;
    EXPECT_EQ(gapPixels(halfSky(0), mask).leftEnd, 10);
}

// A wall at depth 20 that fills the view, separation 0.4, zero parallax at 10: every pixel shifts by the same
// whole number of pixels and as many columns at the right border are seen by the right eye alone.
TEST(SurfaceDifference, OfAWallIsTheStripThatOnlyTheRightEyeSees) {
    const test::AnalyticScene wall({test::plane({0, 20, 0}, {0, -1, 0})}, 0.7);
    const Lens lens{120, 80, 0.8, 1.0, 0.1};
    const StereoSetting stereo{0.4, 10.0};
    ComparisonSetting setting;
    setting.methods = {"full", "paper", "nofill"};
    setting.repeats = 1;
    setting.truthFactor = 1;
    const StereoViews views = makeStereoViews(poseFromAngles({0, 0, 0}, 0, 0, 0), lens, stereo);
    CastFrames frames(wall);
    Progress progress;
    const auto figures = compareMethods(frames, {{poseFromAngles({0, 0, 0}, 0, 0, 0), 0}}, lens, stereo,
                                        setting, progress, {});
    const double shift = views.shiftAtInfinity - views.parallaxScale / 20;
    ASSERT_GT(shift, 1);
    EXPECT_TRUE(std::isnan(figures[0].holesOfWarped_percent)) << "a full cast warps nothing";
    EXPECT_EQ(figures[0].surface_psnr_db, kIdenticalPsnr_db);
    const double share = figures[1].hole_percent / 100;
    EXPECT_NEAR(figures[1].holesOfWarped_percent, 100 * share / (1 - share), 1e-9);
    EXPECT_NEAR(share * lens.width, shift, 1.5);
    EXPECT_GT(figures[2].holesOfWarped_percent, 0);
    EXPECT_LT(figures[2].holesOfWarped_percent, 100 * 4 / (lens.width - 4.0));
    EXPECT_GT(figures[2].surface_psnr_db, figures[2].difference.psnr_db + 10) << "the open strip is no error";
}

// The same wall cut off at half height, with sky above, which the paper's warp casts: its pixels are holes of
// all, and none of those that count.
TEST(SurfaceDifference, HalfASkyDoesNotChangeThePapersCount) {
    const test::AnalyticScene wall({test::plane({0, 20, 0}, {0, -1, 0})}, 0.7),
        low({test::box({-500, 20, -500}, {500, 21, 0})}, 0.7);
    const Lens lens{120, 80, 0.8, 1.0, 0.1};
    ComparisonSetting setting;
    setting.methods = {"paper"};
    setting.repeats = 1;
    setting.truthFactor = 1;
    const std::vector<TimedPose> poses{{poseFromAngles({0, 0, 0}, 0, 0, 0), 0}};
    CastFrames wallFrames(wall), lowFrames(low);
    Progress progress;
    const MethodFigures whole =
                            compareMethods(wallFrames, poses, lens, {0.4, 10.0}, setting, progress, {})[0],
                        half = compareMethods(lowFrames, poses, lens, {0.4, 10.0}, setting, progress, {})[0];
    EXPECT_NEAR(half.holesOfWarped_percent, whole.holesOfWarped_percent, 1e-9);
    EXPECT_GT(half.hole_percent, 50);
    EXPECT_LT(whole.hole_percent, 20);
}

}  // namespace
}  // namespace stereonav
