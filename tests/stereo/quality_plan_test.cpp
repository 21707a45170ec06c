// Which way of making the right eye is taken for a wish: by hand on made-up measurements, and on a terrain's
// frames that were not measured.
#include "engine/stereo/quality_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/base/progress.h"
#include "engine/stereo/frame_plan.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/read/scene_file.h"
#include "terrain/scene/terrain_loader.h"
#include "tests/support/own_cache.h"

namespace stereonav {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A way whose frame of 1,000 pixels has `holes` of them, the others half of contrast class 10 and half of 30,
// with these mean squared errors.
MeasuredWarp wayOf(const std::string& name, double holes, double low, double high, double right_ms) {
    MeasuredWarp warp;
    warp.name = name;
    auto calibration = std::make_shared<ErrorCalibration>();
    for (int c = 0; c < kContrastClasses; ++c) calibration->meanSquare[c] = c < 20 ? low : high;
    calibration->margin.fill(2);
    warp.setting.refinement.calibration = calibration;
    ContrastCounts counts{};
    counts[10] = static_cast<long long>((1000 - holes) / 2);
    counts[30] = static_cast<long long>(1000 - holes) - counts[10];
    warp.counts = {counts};
    warp.holes = {holes};
    warp.right_ms = right_ms;
    warp.ray_ns = 1e4;
    return warp;
}

MeasuredWarp fullCast(double ms) {
    MeasuredWarp full;
    full.name = "full";
    full.setting.method = RightEyeMethod::Full;
    full.holes = {1000};
    full.right_ms = ms;
    return full;
}

// The fine way casts 100 pixels to be four times as good, the rough one 10 to be four times as bad.
MeasuredWarps madeUp() {
    MeasuredWarps measured;
    measured.warps = {wayOf("first", 40, 1, 16, 3), wayOf("fine", 100, 0.25, 4, 3.6),
                      wayOf("rough", 10, 4, 64, 2.7), fullCast(10)};
    measured.pixels = 1000;
    measured.left_ms = 10;
    return measured;
}

TEST(QualityPlan, NothingWishedIsTheFirstWay) {
    for (const QualityWish& wish : {QualityWish{}, QualityWish{0.0}}) {
        const QualityPlan plan = planQuality(madeUp(), wish);
        EXPECT_EQ(plan.name, "first");
        EXPECT_DOUBLE_EQ(plan.castShare, 0.04);
        EXPECT_EQ(plan.setting.refinement.quality, 0);
        EXPECT_EQ(plan.scale, 1);
    }
}

// The first way reaches a quarter of its error by casting half of its pixels, the fine one as it is.
TEST(QualityPlan, QualityIsReachedByTheWayOfFewestRays) {
    const QualityPlan plan = planQuality(madeUp(), {0.7});
    EXPECT_EQ(plan.name, "fine");
    EXPECT_DOUBLE_EQ(plan.castShare, 0.1);
    EXPECT_EQ(plan.setting.refinement.quality, 0);
    EXPECT_LE(plan.meanSquare, 0.3 * (480 * 1 + 480 * 16) / 1000.0);
    const QualityPlan alone = planQuality(madeUp(), {0.7, std::nullopt, std::nullopt, true});
    EXPECT_EQ(alone.name, "first");
    EXPECT_DOUBLE_EQ(alone.castShare, 0.52);
    EXPECT_NEAR(alone.setting.refinement.quality, 0.7, 1e-12);
    EXPECT_EQ(planQuality(madeUp(), {1.0}).name, "full");
}

// 10 log10(255^2 / (2 E)): 36.0 dB of the first way, 42.3 of the fine one, 29.8 of the rough one.
TEST(QualityPlan, ATargetIsMetByTheWayOfFewestRays) {
    EXPECT_EQ(planQuality(madeUp(), {std::nullopt, 29}).name, "rough");
    EXPECT_EQ(planQuality(madeUp(), {std::nullopt, 35}).name, "first");
    EXPECT_EQ(planQuality(madeUp(), {std::nullopt, 42}).name, "fine");
    const QualityPlan most = planQuality(madeUp(), {std::nullopt, 100});
    EXPECT_EQ(most.name, "full");
    EXPECT_EQ(most.meanSquare, 0);
}

TEST(QualityPlan, ATimeIsSpentOnTheLeastError) {
    for (const double plenty : {20.0, 40.0, 1e6})
        EXPECT_EQ(planQuality(madeUp(), {std::nullopt, std::nullopt, plenty}).name, "full") << plenty;
    EXPECT_EQ(planQuality(madeUp(), {std::nullopt, std::nullopt, 19.9}).name, "fine");
    // 13.3 ms leave time for 30 rays of 10 us beside the first way's holes, less than a class
    EXPECT_EQ(planQuality(madeUp(), {std::nullopt, std::nullopt, 13.3}).name, "first");
    const QualityPlan rough = planQuality(madeUp(), {std::nullopt, std::nullopt, 12.8});
    EXPECT_EQ(rough.name, "rough");
    EXPECT_EQ(rough.scale, 1);
}

// Below what the fastest way takes the picture gets smaller, by a root of two at a time, and says no bound.
TEST(QualityPlan, WhatDoesNotFitIsMadeSmaller) {
    for (const double target : {12.6, 7.0, 3.3, 1.6, 1e-3}) {
        const QualityPlan plan = planQuality(madeUp(), {std::nullopt, 45, target});
        EXPECT_EQ(plan.name, "rough") << target;
        EXPECT_LT(plan.scale, 1) << target;
        EXPECT_GE(plan.scale, kLeastScale) << target;
        if (plan.scale > kLeastScale) {
            EXPECT_LE(12.7 * plan.scale * plan.scale, target);
        }
        EXPECT_GT(2 * 12.7 * plan.scale * plan.scale, std::min(target, 12.7 / 16)) << target;
        EXPECT_EQ(plan.setting.refinement.calibration, nullptr);
    }
}

TEST(QualityPlan, ATimeComesBeforeATarget) {
    // 47 dB want the fine way's upper class cast, which takes 18.1 ms in all
    EXPECT_GT(planQuality(madeUp(), {std::nullopt, 47, 18.2}).castShare, 0.5);
    const QualityPlan short_ = planQuality(madeUp(), {std::nullopt, 47, 14.0});
    EXPECT_EQ(short_.name, "fine");
    EXPECT_LE(short_.both_ms, 14.0);
}

TEST(QualityPlan, WithoutErrorNothingIsCast) {
    MeasuredWarps exact;
    exact.warps = {wayOf("first", 0, 0, 0, 3), wayOf("fine", 100, 0, 0, 3), fullCast(10)};
    exact.pixels = 1000;
    for (const double quality : {0.0, 0.5, 1.0}) {
        const QualityPlan plan = planQuality(exact, {quality, 60});
        EXPECT_EQ(plan.name, "first") << quality;
        EXPECT_EQ(plan.castShare, 0) << quality;
    }
}

TEST(QualityPlan, WishesOutsideTheirRangeAreRefused) {
    for (const double bad : {kNan, -0.1, 1.1, 1e300}) EXPECT_THROW(planQuality(madeUp(), {bad}), Error);
    for (const double bad : {kNan, -1.0, 101.0})
        EXPECT_THROW(planQuality(madeUp(), {std::nullopt, bad}), Error);
    for (const double bad : {kNan, 0.0, -1.0, 1e300})
        EXPECT_THROW(planQuality(madeUp(), {std::nullopt, std::nullopt, bad}), Error);
}

// ---- on a terrain

class Planned : public testing::Test {
protected:
    static void SetUpTestSuite() {
        SceneFile file;
        file.builtIn = true;
        file.builtInSize = 257;
        Progress progress;
        sScene = new TerrainScene(loadTerrain(file, progress));
        sRenderer = new TerrainRenderer(*sScene);
        sMeasured = new MeasuredWarps(measureWarps(*sRenderer, viewsAt(1), warpsWorthTrying(*sRenderer), 1));
    }
    static void TearDownTestSuite() {
        delete sMeasured;
        delete sRenderer;
        delete sScene;
    }

    // Every third of 48 poses of the scene's flight, from `first` on.
    static std::vector<StereoViews> viewsAt(std::size_t first) {
        Lens lens = sScene->lens;
        lens.width = 160;
        lens.height = 120;
        StereoSetting stereo = sScene->stereo;
        stereo.separation = stereo.zeroParallax / 30;
        std::vector<StereoViews> views;
        const std::vector<Pose> poses = sScene->path.frames(48);
        for (std::size_t n = first; n < poses.size(); n += 3)
            views.push_back(makeStereoViews(poses[n], lens, stereo));
        return views;
    }

    // Frames that were not measured: mean squared error, share of pixels cast, share within the bound.
    struct Flight {
        double meanSquare = 0, castShare = 0, within = 0;
    };
    static Flight fly(const WarpSetting& setting) {
        Flight flight;
        EyeImage left, right, full;
        RightEye eye;
        const auto& bytes = srgbByteFromPacked();
        const std::vector<StereoViews> views = viewsAt(2);
        const auto frames = static_cast<double>(views.size());
        for (const StereoViews& v : views) {
            left.resize(v.left.width, v.left.height, sRenderer->viewDependence());
            renderEye(*sRenderer, v.left, left);
            const RightEyeTimings t = eye.render(*sRenderer, v, left, setting, right);
            WarpSetting all;
            all.method = RightEyeMethod::Full;
            eye.render(*sRenderer, v, left, all, full);
            double sum = 0;
            for (int y = 0; y < full.height(); ++y)
                for (int x = 0; x < full.width(); ++x)
                    for (const int shift : {0, 10, 20}) {
                        const double d = 1.0 * bytes[full.color.at(x, y) >> shift & 1023u] -
                                         bytes[right.color.at(x, y) >> shift & 1023u];
                        sum += d * d;
                    }
            const double pixels = static_cast<double>(full.width()) * full.height(),
                         square = sum / (3 * pixels);
            flight.meanSquare += square / frames;
            flight.castShare += static_cast<double>(t.holePixels) / pixels / frames;
            const double psnr = square > 0 ? 10 * std::log10(255 * 255 / square) : kMostPsnr_db;
            flight.within += (psnr >= t.boundPsnr_db) / frames;
        }
        return flight;
    }

    inline static TerrainScene* sScene = nullptr;
    inline static TerrainRenderer* sRenderer = nullptr;
    inline static MeasuredWarps* sMeasured = nullptr;
};

TEST_F(Planned, TheDefaultComesFirstAndTheFullCastLast) {
    const std::vector<NamedWarp> warps = warpsWorthTrying(*sRenderer);
    EXPECT_EQ(warps.front().setting.method, defaultMethodFor(*sRenderer));
    EXPECT_EQ(warps.front().setting.maxStretch, WarpSetting().maxStretch);
    EXPECT_EQ(warps.back().setting.method, RightEyeMethod::Full);
    EXPECT_GE(warps.size(), 5u);
    EXPECT_THROW(measureWarps(*sRenderer, {}, warps, 1), Error);
    EXPECT_THROW(measureWarps(*sRenderer, viewsAt(1), std::span(warps).first(2), 1), Error);
}

// A scattered ray is dearer than one of a full cast.
double costOf(const QualityPlan& plan, double castShare) {
    return plan.setting.method == RightEyeMethod::Full ? 1 : kScatteredRay * castShare;
}

// Never dearer than the default way refined alone, and the bound holds on frames that it has not seen.
TEST_F(Planned, MeetsTargetsAtNoMoreThanTheDefaultWaysCost) {
    double saved = 0;
    for (const double target : {35.0, 42.0, 48.0, 54.0}) {
        const QualityPlan chosen = planQuality(*sMeasured, {std::nullopt, target}),
                          alone = planQuality(*sMeasured, {std::nullopt, target, std::nullopt, true});
        const Flight a = fly(chosen.setting), b = fly(alone.setting);
        EXPECT_GE(a.within, 0.95) << target << " " << chosen.name;
        const double cost = costOf(chosen, a.castShare), alones = costOf(alone, b.castShare);
        EXPECT_LE(cost, alones + 0.02) << target << " " << chosen.name;
        EXPECT_NEAR(a.castShare, chosen.castShare, 0.25 * chosen.castShare + 0.005) << target;
        saved = std::max(saved, alones - cost);
    }
    EXPECT_GT(saved, 0.002);  // choosing is worth something
}

TEST_F(Planned, QualityTakesAwayItsShareOfTheError) {
    const double whole = fly(sMeasured->warps.front().setting).meanSquare;
    for (const double quality : {0.3, 0.6, 0.9}) {
        const QualityPlan plan = planQuality(*sMeasured, {quality});
        EXPECT_LE(fly(plan.setting).meanSquare, (1 - quality) * whole * 1.15) << quality << " " << plan.name;
        EXPECT_LE(plan.castShare,
                  planQuality(*sMeasured, {quality, std::nullopt, std::nullopt, true}).castShare)
            << quality;
    }
}

TEST_F(Planned, WithoutATimeNothingDependsOnTheClock) {
    MeasuredWarps other = *sMeasured;
    other.left_ms *= 7;
    for (std::size_t n = 0; n < other.warps.size(); ++n) {
        other.warps[n].right_ms *= 1.0 + static_cast<double>(n);
        other.warps[n].ray_ns *= 10.0 / (1.0 + static_cast<double>(n));
    }
    for (const double quality : {0.0, 0.2, 0.5, 0.8, 1.0})
        for (const double target : {0.0, 40.0, 50.0}) {
            const QualityPlan a = planQuality(*sMeasured, {quality, target}),
                              b = planQuality(other, {quality, target});
            EXPECT_EQ(a.name, b.name) << quality << " " << target;
            EXPECT_EQ(a.castShare, b.castShare) << quality << " " << target;
        }
}

}  // namespace
}  // namespace stereonav
