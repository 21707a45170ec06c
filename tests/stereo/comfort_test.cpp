// Eyes made comfortable for a picture: by what is at fault, no more than it takes.
#include "engine/stereo/comfort.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace stereonav {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Lens lensOf() {
    Lens lens;
    lens.width = 1280;
    lens.height = 720;
    return lens;
}

StereoViews viewsWith(const StereoSetting& setting) {
    return makeStereoViews({}, lensOf(), setting);
}

ParallaxRange seenWith(const StereoSetting& setting, double nearest, double farthest) {
    const StereoViews views = viewsWith(setting);
    return {parallaxAt(views, nearest), parallaxAt(views, farthest)};
}

StereoSetting fitted(const StereoSetting& setting, double nearest, double farthest) {
    const StereoViews views = viewsWith(setting);
    return comfortableEyes(setting, seenWith(setting, nearest, farthest),
                           views.shiftAtInfinity / views.left.width);
}

TEST(Comfort, States) {
    EXPECT_EQ(comfortOf({-0.01, 0.02}), ComfortState::Comfortable);
    EXPECT_EQ(comfortOf({0, 0}), ComfortState::Comfortable);
    EXPECT_EQ(comfortOf({-0.0101, 0.01}), ComfortState::Excursion);
    EXPECT_EQ(comfortOf({0.02, 0.04}), ComfortState::Excursion);
    EXPECT_EQ(comfortOf({-0.025, 0.004}), ComfortState::Excursion);
    EXPECT_EQ(comfortOf({-0.026, -0.01}), ComfortState::TooMuch);
    EXPECT_EQ(comfortOf({0.03, 0.041}), ComfortState::TooMuch);
    EXPECT_EQ(comfortOf({-0.015, 0.02}), ComfortState::TooMuch) << "3.5 % in all";
    EXPECT_EQ(comfortOf({std::nan(""), 0.01}), ComfortState::TooMuch);
    EXPECT_EQ(comfortOf({-kInfinity, kInfinity}), ComfortState::TooMuch);
}

TEST(Comfort, WhatIsComfortableStays) {
    const StereoSetting setting{10, 600};
    const StereoSetting same = fitted(setting, 500, kInfinity);
    EXPECT_EQ(same.separation, setting.separation);
    EXPECT_EQ(same.zeroParallax, setting.zeroParallax);
}

// The range fits the budget, its place does not: the screen moves, the eyes stay.
TEST(Comfort, TheScreenIsAtFault) {
    const StereoSetting setting{20, 600};
    ASSERT_EQ(comfortOf(seenWith(setting, 700, kInfinity)), ComfortState::Excursion);  // 2.2 % behind
    const StereoSetting farther = fitted(setting, 700, kInfinity);
    EXPECT_EQ(farther.separation, setting.separation);
    EXPECT_GT(farther.zeroParallax, setting.zeroParallax);
    EXPECT_NEAR(seenWith(farther, 700, kInfinity).far, 0.019, 1e-12);
    const StereoSetting nearer = fitted(setting, 390, 590);
    EXPECT_EQ(nearer.separation, setting.separation);
    EXPECT_LT(nearer.zeroParallax, setting.zeroParallax);
    EXPECT_NEAR(seenWith(nearer, 390, 590).near, -0.0095, 1e-12);
}

// No screen distance mends a range that is too wide; what is left of it fills the limits, which tells where
// the screen is.
TEST(Comfort, TheEyesAreAtFault) {
    const StereoSetting setting{40, 600};
    const StereoSetting together = fitted(setting, 400, 1e9);
    EXPECT_LT(together.separation, setting.separation);
    EXPECT_NEAR(together.zeroParallax, setting.zeroParallax, 1e-3 * setting.zeroParallax) << "it lay well";
    const ParallaxRange seen = seenWith(together, 400, 1e9);
    EXPECT_EQ(comfortOf(seen), ComfortState::Comfortable);
    EXPECT_NEAR(seen.far - seen.near, 0.0285, 1e-6);
}

TEST(Comfort, AnyRoomBecomesComfortable) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> logs(-4, 4), unit(0, 1);
    for (int n = 0; n < 20000; ++n) {
        const double screen = std::exp(logs(random)), first = screen * std::exp(logs(random));
        const double second = unit(random) < 0.2 ? kInfinity : screen * std::exp(logs(random));
        const StereoSetting setting{screen * (unit(random) < 0.1 ? 0.25 : 0.05 * unit(random) + 1e-4),
                                    screen};
        const double nearest = std::min(first, second), farthest = std::max(first, second);
        const StereoSetting fit = fitted(setting, nearest, farthest);
        ASSERT_EQ(comfortOf(seenWith(fit, nearest, farthest)), ComfortState::Comfortable)
            << setting.separation << " " << screen << " " << nearest << " " << farthest;
        ASSERT_LE(fit.separation, setting.separation);
        const StereoSetting again = fitted(fit, nearest, farthest);
        ASSERT_EQ(again.separation, fit.separation) << "once is enough";
        ASSERT_EQ(again.zeroParallax, fit.zeroParallax);
    }
}

TEST(Comfort, ExtremesLeaveAUsableSetting) {
    const StereoSetting setting{20, 600};
    for (const auto& [nearest, farthest] : {std::pair{1e-3, kInfinity}, std::pair{1e-30, 1e-29},
                                            std::pair{1e30, kInfinity}, std::pair{5.0, 5.0}}) {
        const StereoSetting fit = fitted(setting, nearest, farthest);
        EXPECT_TRUE(std::isfinite(fit.separation) && fit.separation >= 0);
        EXPECT_TRUE(std::isfinite(fit.zeroParallax) && fit.zeroParallax > 0);
        viewsWith(fit);
    }
    const StereoSetting flat = fitted({0, 600}, 1, kInfinity);
    EXPECT_EQ(flat.separation, 0);
    EXPECT_EQ(flat.zeroParallax, 600);
    for (const ParallaxRange& broken : {ParallaxRange{std::nan(""), 0.1}, ParallaxRange{0.1, -0.1},
                                        ParallaxRange{-kInfinity, 0.1}, ParallaxRange{-0.1, kInfinity}}) {
        const StereoSetting kept = comfortableEyes(setting, broken, 0.02);
        EXPECT_TRUE(std::isfinite(kept.separation) && std::isfinite(kept.zeroParallax) &&
                    kept.zeroParallax > 0);
    }
}

// A limit that goes, goes slowly; one that begins anew begins with what is shown.
TEST(Comfort, TheSlowLimitIsReleasedSlowly) {
    ComfortLimit limit;
    limit.observe(1.0, {-0.1, 0.1});
    StereoSetting shown{1, 1};
    for (int n = 0; n < 200; ++n) shown = limit.limited({1, 1}, 0.1, 0);
    EXPECT_NEAR(shown.separation, 0.95 * 0.15, 1e-6) << "below a fifth, where that is asked for";
    double before = shown.separation;
    for (int n = 0; n < 60; ++n) {
        const double now = limit.released({1, 1}, 1.0 / 60).separation;
        EXPECT_GT(now, before);
        EXPECT_LT(now - before, 0.02);
        before = now;
    }
    for (int n = 0; n < 200; ++n) shown = limit.released({1, 1}, 0.1);
    EXPECT_EQ(shown.separation, 1.0) << "exactly, in the end";
    for (int n = 0; n < 200; ++n) shown = limit.limited({1, 1}, 0.1, 0);
    limit.restart();
    EXPECT_EQ(limit.limited({1, 1}, 0, 0).separation, 1.0);
}

}  // namespace
}  // namespace stereonav
