// A translucent wall with eyes from no distance at all to ten times that of the nearest thing apart, by all
// methods; and what the quality dial makes of wishes at their ends and beyond them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "engine/stereo/error_prediction.h"
#include "engine/stereo/quality_plan.h"
#include "engine/stereo/right_eye.h"
#include "tests/stability/stability_scenes.h"
#include "tests/support/calibrate_error.h"
#include "tests/support/stability_row.h"

namespace stereonav {
namespace {

using namespace test;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

// A cavity with a polyp before the eyes, of a wall that takes 0.95 of the light a millimetre, or of an opaque
// one.
VolumeScene cavity(bool glass) {
    const glm::dvec3 middle(0.028, 0.028, 0.028);
    const auto wall = [=](const glm::dvec3& p) {
        const double hollow = glm::length(p - middle) - 0.026;
        return std::max(hollow, 0.0025 - glm::length(p - middle - glm::dvec3(0.0008, 0.006, 0)));
    };
    GreyVolume field = walledVolume(frameOf(glm::ivec3(71), glm::dvec3(0.0008)), wall, 3e5);
    if (!glass) return surfaceScene(std::move(field), -480);
    VolumeScene scene;
    SurfaceSetting setting;
    setting.isovalue = -480;
    setting.lowest = -630;
    setting.highest = 32767;
    Progress progress;
    scene.field = std::move(field);
    scene.cells = findSurfaceCells(scene.field, setting, progress);
    scene.look.transfer =
        TransferFunction({{-630, {0.8f, 0.3f, 0.2f}, 0}, {-330, {0.8f, 0.6f, 0.4f}, 0.95}}, 0.001, "test");
    return scene;
}

struct GlassStage {
    VolumeScene scene;
    VolumeRenderer renderer;
    explicit GlassStage(bool glass) : scene(cavity(glass)), renderer(scene) {}

    // factor: separation over the distance of the polyp, 3.5 mm.
    StereoViews views(double factor) const {
        constexpr double kNearest = 0.0035;
        const Pose head = poseFromAngles({0.028, 0.028, 0.028}, 0, 0, 0);
        return makeStereoViews(head, {120, 24, 0.35, 1.0, 0.2 * kNearest},
                               {factor * kNearest, 4 * std::max(1.0, factor) * kNearest});
    }
};

const GlassStage& glassStageOf(bool glass) {
    static const GlassStage kGlass(true), kWall(false);
    return glass ? kGlass : kWall;
}

EyeImage rightEye(const GlassStage& stage, const StereoViews& views, const EyeImage& left,
                  const WarpSetting& setting, RightEyeTimings* timings = nullptr) {
    RightEye eye;
    EyeImage right;
    const RightEyeTimings t = eye.render(stage.renderer, views, left, setting, right);
    if (timings) *timings = t;
    return right;
}

WarpSetting settingOf(RightEyeMethod method) {
    WarpSetting setting;
    setting.method = method;
    return setting;
}

class TranslucentRow : public testing::TestWithParam<double> {
protected:
    std::string id(const std::string& what) const {
        return "separation/translucent/" + what + "/" + shortNumber(GetParam());
    }
    std::string words() const {
        return "a translucent wall, eyes " + shortNumber(GetParam()) + " times the nearest distance apart";
    }
};

TEST_P(TranslucentRow, EveryPixelIsSound) {
    StabilityRow row(id("sound"), words() + ", all methods", "pixels of no depth or of a depth that is none",
                     0, "pixels");
    row.count(0);
    const GlassStage& stage = glassStageOf(true);
    ASSERT_TRUE(stage.renderer.translucent());
    const StereoViews views = stage.views(GetParam());
    const EyeImage left = castPicture(stage.renderer, views.left);
    for (const RightEyeMethod method : methodsFor(stage.renderer)) {
        const EyeImage right = rightEye(stage, views, left, settingOf(method));
        for (int y = 0; y < right.height(); ++y)
            for (int x = 0; x < right.width(); ++x)
                row.count(!(right.viewDepth.at(x, y) >= views.right.nearDepth * (1 - 1e-6)));
    }
}

// Selective casts where depths shift apart by more than 0.7 pixels: at the most as much is wrong as if all
// was warped; where nothing shifts it is the left eye, bit for bit.
TEST_P(TranslucentRow, SelectiveIsNoWorseThanLinear) {
    StabilityRow row(id("selective"), words() + ", squared error of selective over that of linear",
                     "ratio above 1, or pixels that differ where nothing shifts", 1, "");
    const GlassStage& stage = glassStageOf(true);
    const StereoViews views = stage.views(GetParam());
    const EyeImage left = castPicture(stage.renderer, views.left);
    const EyeImage full = rightEye(stage, views, left, settingOf(RightEyeMethod::Full));
    const auto squares = [&](const EyeImage& image) {
        double sum = 0;
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                for (const int shift : {0, 10, 20}) {
                    const double d = 1.0 * (image.color.at(x, y) >> shift & 1023u) -
                                     1.0 * (full.color.at(x, y) >> shift & 1023u);
                    sum += d * d;
                }
        return sum;
    };
    const EyeImage selective = rightEye(stage, views, left, settingOf(RightEyeMethod::Selective));
    const double linear = squares(rightEye(stage, views, left, settingOf(RightEyeMethod::Linear)));
    row.saw(linear > 0 ? squares(selective) / linear : squares(selective));
    if (GetParam() == 0) row.count(static_cast<double>(differentPixels(left, selective)));
}

INSTANTIATE_TEST_SUITE_P(Stability, TranslucentRow, testing::Values(0.0, 1e-6, 1e-4, 1e-2, 0.1, 1.0, 10.0),
                         [](const auto& given) { return testName(shortNumber(given.param)); });

// ---- the quality dial

struct DialCase {
    std::string name;
    double quality, targetPsnr_db, mostPixels;
};

class DialRow : public testing::TestWithParam<std::tuple<bool, DialCase>> {
protected:
    bool glass() const { return std::get<0>(GetParam()); }
    const DialCase& wish() const { return std::get<1>(GetParam()); }
};

// Whatever is wished, a pixel is what it was warped to, or what is cast there.
TEST_P(DialRow, EveryPixelIsWarpedOrCast) {
    const std::string scene = glass() ? "translucent" : "opaque";
    StabilityRow row("quality/" + scene + "/" + wish().name,
                     "a lumen, " + scene + ", refined with " + wish().name,
                     "pixels neither as warped nor as cast, or more of them cast than allowed", 0, "pixels");
    row.count(0);
    const GlassStage& stage = glassStageOf(glass());
    const StereoViews views = stage.views(0.3);
    const EyeImage left = castPicture(stage.renderer, views.left);
    WarpSetting setting = settingOf(defaultMethodFor(stage.renderer));
    const EyeImage warped = rightEye(stage, views, left, setting),
                   full = rightEye(stage, views, left, settingOf(RightEyeMethod::Full));
    setting.refinement = {
        std::make_shared<ErrorCalibration>(calibrateError(stage.renderer, {&views, 1}, setting)),
        wish().quality, wish().targetPsnr_db, wish().mostPixels};
    RightEyeTimings timings;
    const EyeImage refined = rightEye(stage, views, left, setting, &timings);
    const auto same = [](PackedColor a, PackedColor b) {  // rays that start elsewhere round otherwise
        for (const int shift : {0, 10, 20})
            if (std::abs(int(a >> shift & 1023u) - int(b >> shift & 1023u)) > 2) return false;
        return true;
    };
    for (int y = 0; y < full.height(); ++y)
        for (int x = 0; x < full.width(); ++x)
            row.count(!same(refined.color.at(x, y), warped.color.at(x, y)) &&
                      !same(refined.color.at(x, y), full.color.at(x, y)));
    const double pixels = static_cast<double>(full.width()) * full.height();
    row.count(static_cast<double>(timings.refinedPixels) > std::max(wish().mostPixels, 0.0) * pixels);
    if (wish().quality >= 1 && wish().mostPixels >= 1)
        row.count(static_cast<double>(differentPixels(refined, full)));
    if (wish().quality == 0 && wish().targetPsnr_db == 0)
        row.count(static_cast<double>(differentPixels(refined, warped)));
}

INSTANTIATE_TEST_SUITE_P(
    Stability, DialRow,
    testing::Combine(
        testing::Bool(),
        testing::Values(DialCase{"quality 0", 0, 0, 1}, DialCase{"quality 1", 1, 0, 1},
                        DialCase{"quality NaN", kNan, 0, 1}, DialCase{"quality -1", -1, 0, 1},
                        DialCase{"quality 1e300", 1e300, 0, 1}, DialCase{"target 1e-300 dB", 0, 1e-300, 1},
                        DialCase{"target 100 dB", 0, 100, 1}, DialCase{"target NaN", 0, kNan, 1},
                        DialCase{"target infinite", 0, kInfinite, 1}, DialCase{"no ray to spare", 1, 100, 0},
                        DialCase{"fewer rays than none", 1, 100, -1}, DialCase{"rays NaN", 0.5, 0, kNan})),
    [](const auto& given) {
        return testName(std::string(std::get<0>(given.param) ? "glass_" : "wall_") +
                        std::get<1>(given.param).name);
    });

// ---- what is planned for wishes

class PlanRow : public testing::TestWithParam<std::tuple<bool, double>> {};

TEST_P(PlanRow, WhatIsPlannedIsWithinItsRanges) {
    const auto [glass, target_ms] = GetParam();
    const std::string scene = glass ? "translucent" : "opaque";
    StabilityRow row("quality/plan/" + scene + "/" + shortNumber(target_ms),
                     "a lumen, " + scene + ", planned for " + shortNumber(target_ms) + " ms a frame",
                     "scales, shares and errors that are none", 0, "");
    row.count(0);
    const GlassStage& stage = glassStageOf(glass);
    const StereoViews views = stage.views(0.3);
    const std::vector<NamedWarp> warps = warpsWorthTrying(stage.renderer);
    const MeasuredWarps measured = measureWarps(stage.renderer, {&views, 1}, warps, 1);
    for (const std::optional<double> quality : {std::optional<double>(), {0.0}, {1.0}, {1e-300}, {1 - 1e-16}})
        for (const std::optional<double> target : {std::optional<double>(), {0.0}, {1e-300}, {100.0}}) {
            const QualityPlan plan = planQuality(measured, {quality, target, target_ms});
            const auto outside = [&](double v, double low, double high) {
                row.count(!(v >= low && v <= high));
            };
            outside(plan.scale, kLeastScale, 1);
            outside(plan.castShare, 0, 1);
            outside(plan.meanSquare, 0, 255.0 * 255);
            outside(plan.setting.refinement.mostPixels, 0, 1);
            outside(plan.setting.refinement.quality, 0, 1);
            row.count(plan.scale == 1 && plan.setting.method != RightEyeMethod::Full &&
                      measured.left_ms > target_ms);
        }
}

INSTANTIATE_TEST_SUITE_P(Stability, PlanRow,
                         testing::Combine(testing::Bool(), testing::Values(1e-9, 1e-3, 1.0, 1e3, 1e12)),
                         [](const auto& given) {
                             return testName(std::string(std::get<0>(given.param) ? "glass_" : "wall_") +
                                             shortNumber(std::get<1>(given.param)));
                         });

}  // namespace
}  // namespace stereonav
