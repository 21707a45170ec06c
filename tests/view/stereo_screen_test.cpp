// Parallax on real screens, compared with figures computed by hand, and for sizes that no screen has.
#include "engine/display/stereo_screen.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace stereonav {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(StereoScreen, MillimetresAndDegrees) {
    // Expected: 2 % of half a metre is 10 mm; from 0.6 m 2 atan(5 / 600) = 0.9549 degrees.
    const ScreenParallax far = onScreen(0.02, 0.5, 0.6);
    EXPECT_NEAR(far.millimetres, 10, 1e-12);
    EXPECT_NEAR(far.degrees, 0.95490, 1e-5);
    EXPECT_FALSE(far.diverges);
    const ScreenParallax near = onScreen(-0.02, 0.5, 0.6);
    EXPECT_EQ(near.millimetres, -far.millimetres);
    EXPECT_EQ(near.degrees, -far.degrees);
    // The same picture on a wall of three metres.
    EXPECT_NEAR(onScreen(0.02, 3, 4).millimetres, 60, 1e-12);
    EXPECT_FALSE(onScreen(0.02, 3, 4).diverges);
    EXPECT_TRUE(onScreen(0.022, 3, 4).diverges);
    EXPECT_FALSE(onScreen(-0.5, 3, 4).diverges) << "before the screen eyes turn inwards";
}

TEST(StereoScreen, NoSizeIsNoParallax) {
    for (const double bad : {0.0, -0.5, kNan, kInfinity}) {
        EXPECT_EQ(onScreen(0.02, bad, 0.6).millimetres, 0) << bad;
        EXPECT_EQ(onScreen(0.02, 0.5, bad).degrees, 0) << bad;
    }
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
        EXPECT_EQ(onScreen(bad, 0.5, 0.6).millimetres, 0) << bad;
        EXPECT_FALSE(onScreen(bad, 0.5, 0.6).diverges) << bad;
    }
    EXPECT_EQ(screenParallaxText({}, {}), "");
    EXPECT_EQ(divergenceText({}), "");
    // At the smallest distance eyes look sideways at most.
    EXPECT_NEAR(onScreen(1, 1, 1e-300).degrees, 180, 1e-9);
    EXPECT_EQ(onScreen(0, 0.5, 0.6).degrees, 0);
}

TEST(StereoScreen, SaysWhatItFinds) {
    EXPECT_EQ(screenParallaxText(onScreen(-0.01, 0.5, 0.6), onScreen(0.02, 0.5, 0.6)),
              "on the screen -5.0 to +10.0 mm, -0.48 to +0.95 degrees");
    EXPECT_THAT(divergenceText(onScreen(0.04, 2, 3)),
                testing::HasSubstr("80 mm apart on the screen, more than the eyes' 65"));
    EXPECT_EQ(divergenceText(onScreen(0.03, 2, 3)), "");
}

TEST(StereoScreen, MonitorsAreBelievedWhereTheyTellASize) {
    EXPECT_EQ(statedWidth(597, 336, 2560, 1440), 0.597);
    EXPECT_EQ(statedWidth(336, 597, 1440, 2560), 0.336) << "turned";
    EXPECT_EQ(statedWidth(1600, 900, 3840, 2160), 1.6);
    EXPECT_EQ(statedWidth(1600, 900, 3840, 1080), 1.6) << "two eyes in one mode";
    EXPECT_EQ(statedWidth(1600, 900, 1920, 2205), 1.6) << "frame packed";
    EXPECT_EQ(statedWidth(597, 336, 0, 0), 0.597);
    for (const auto& [width, height] : {std::pair(0, 0),
                                        {-1, 300},
                                        {16, 9},
                                        {160, 90},
                                        {160, 100},
                                        {597, 0},
                                        {597, 20},
                                        {200, 900},
                                        {2000000, 1000000}})
        EXPECT_EQ(statedWidth(width, height, 1920, 1080), kDeskScreenWidth) << width << "x" << height;
}

TEST(StereoScreen, APictureHasItsPartOfTheScreen) {
    const StereoScreen screen{0.6, 0.6};
    EXPECT_NEAR(pictureWidth(screen, 1920, 1920), 0.6, 1e-12);
    EXPECT_NEAR(pictureWidth(screen, 480, 1920), 0.15, 1e-12);
    EXPECT_NEAR(pictureWidth(screen, 3840, 1920), 1.2, 1e-12) << "over two monitors";
    for (const double none : {0.0, -1.0, kNan}) {
        EXPECT_EQ(pictureWidth(screen, none, 1920), 0) << none;
        EXPECT_EQ(pictureWidth(screen, 100, none), 0) << none;
    }
    EXPECT_EQ(onScreen(0.02, pictureWidth(screen, 0, 1920), 0.6).millimetres, 0);
    EXPECT_EQ(onScreen(0.02, pictureWidth(screen, kInfinity, 1920), 0.6).millimetres, 0);
}

}  // namespace
}  // namespace stereonav
