// Size of a screen: which source goes first, and what is set is kept for its monitor.
#include "app/view/screen_sizes.h"

#include <gmock/gmock.h>

#include <limits>

#include "engine/display/stereo_screen.h"

namespace stereonav {
namespace {

using From = ScreenSize::From;

const ScreenTold kTells{"DP-1", 598, 336, 2560, 1440}, kSilent{"HDMI-1", 0, 0, 1920, 1080};
constexpr double kNoSize = std::numeric_limits<double>::quiet_NaN();

TEST(ScreenSizes, BeginWithWhatTheMonitorTells) {
    const ScreenSizes sizes;
    const ScreenSize told = sizes.of(kTells), silent = sizes.of(kSilent);
    EXPECT_EQ(told.width_mm, 598);
    EXPECT_EQ(told.widthFrom, From::Monitor);
    EXPECT_EQ(told.distance_mm, 1000 * kViewingDistance);
    EXPECT_EQ(silent.width_mm, 1000 * kDeskScreenWidth);
    EXPECT_EQ(silent.widthFrom, From::Guess);
    EXPECT_FALSE(sizes.asks(kTells));
    EXPECT_TRUE(sizes.asks(kSilent));
    EXPECT_TRUE(sizes.asks({})) << "no monitor at all";
}

TEST(ScreenSizes, NonsenseIsAsked) {
    const ScreenSizes sizes;
    EXPECT_TRUE(sizes.asks({"a", 160, 90, 1920, 1080})) << "an aspect ratio";
    EXPECT_TRUE(sizes.asks({"a", 1, 1, 1920, 1080}));
    EXPECT_TRUE(sizes.asks({"a", -598, 336, 2560, 1440}));
    EXPECT_TRUE(sizes.asks({"a", 508, 285, 1920, 1080})) << "96 pixels an inch, made up by the desktop";
    EXPECT_FALSE(sizes.asks({"a", 531, 299, 1920, 1080}));
}

TEST(ScreenSizes, TheCommandLineGoesFirst) {
    ScreenSizes sizes;
    sizes.setKept({{"DP-1", 700, 800}, {"DP-1", 1, 1}});
    EXPECT_EQ(sizes.of(kTells).width_mm, 700);
    EXPECT_EQ(sizes.of(kTells).widthFrom, From::Person);
    sizes.say(900, std::nullopt);
    EXPECT_EQ(sizes.of(kTells).width_mm, 900);
    EXPECT_EQ(sizes.of(kTells).widthFrom, From::CommandLine);
    EXPECT_EQ(sizes.of(kTells).distance_mm, 800);
    EXPECT_FALSE(sizes.asks(kSilent)) << "the command line says it";
    EXPECT_EQ(sizes.kept().size(), 2u) << "it is not kept";
}

TEST(ScreenSizes, WhatIsSetIsKeptForItsMonitor) {
    ScreenSizes sizes;
    sizes.say(900, 1000);
    sizes.setWidth("HDMI-1", 1200);
    EXPECT_EQ(sizes.of(kSilent).width_mm, 1200) << "what was set last counts";
    EXPECT_EQ(sizes.of(kSilent).distance_mm, 1000);
    EXPECT_EQ(sizes.of(kTells).width_mm, 598) << "another monitor";
    sizes.setDistance("DP-1", 450);
    EXPECT_EQ(sizes.kept(), (std::vector<KeptScreen>{{"DP-1", {}, 450}, {"HDMI-1", 1200, {}}}));
    sizes.setWidth("HDMI-1", std::nullopt);
    EXPECT_EQ(sizes.of(kSilent).widthFrom, From::Guess);
    EXPECT_FALSE(sizes.asks(kSilent)) << "it was asked";
}

TEST(ScreenSizes, IsAskedOnce) {
    ScreenSizes sizes;
    sizes.noteAsked("HDMI-1");
    EXPECT_FALSE(sizes.asks(kSilent));
    EXPECT_EQ(sizes.of(kSilent).widthFrom, From::Guess);
    ScreenSizes again;
    again.setKept(sizes.kept());
    EXPECT_FALSE(again.asks(kSilent));
}

TEST(ScreenSizes, NoNumberChangesNothingAndFarOnesAreBroughtNear) {
    ScreenSizes sizes;
    for (const double bad : {kNoSize, std::numeric_limits<double>::infinity()}) {
        sizes.setWidth("DP-1", bad);
        sizes.setDistance("DP-1", bad);
    }
    EXPECT_TRUE(sizes.kept().empty());
    sizes.setWidth("DP-1", 1e-300);
    sizes.setDistance("DP-1", 1e300);
    EXPECT_EQ(sizes.of(kTells).width_mm, kScreenWidthRange.low);
    EXPECT_EQ(sizes.of(kTells).distance_mm, kViewingDistanceRange.high);
    for (int n = 0; n < 100; ++n) sizes.setWidth("monitor " + std::to_string(n), 500);
    EXPECT_EQ(sizes.kept().size(), kMostScreens);
    EXPECT_EQ(sizes.kept().front().monitor, "monitor 99");
}

TEST(ScreenSizes, SayWhoSaysSo) {
    EXPECT_EQ(screenText({598, 600, From::Monitor, From::Guess}),
              "The screen is 598 mm wide, as it reports, and 600 mm away.");
    EXPECT_THAT(screenText({500, 600, From::Guess, From::Guess}), testing::HasSubstr("500 mm wide, a guess"));
}

}  // namespace
}  // namespace stereonav
