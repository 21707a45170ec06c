// The comparison on a scene with known answers.
#include "engine/metrics/method_comparison.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "engine/base/error.h"
#include "engine/frame/cast_frames.h"
#include "tests/support/analytic_scene.h"
#include "tests/support/whole_progress.h"

namespace stereonav {
namespace {

// A near ball in front of a far wall: holes beside the ball.
test::AnalyticScene ballBeforeWall() {
    return test::AnalyticScene({test::sphere({0, 8, 0}, 1.0), test::plane({0, 20, 0}, {0, -1, 0})}, 0.7);
}

std::vector<TimedPose> twoPoses() {
    return {{poseFromAngles({0, 0, 0}, 0, 0, 0), 0}, {poseFromAngles({0.5, 0, 0.2}, 0.05, 0, 0), 2}};
}

ComparisonSetting settingOf(std::vector<std::string_view> methods) {
    ComparisonSetting setting;
    setting.methods = std::move(methods);
    setting.repeats = 1;
    setting.truthFactor = 2;
    return setting;
}

const Lens kLens{120, 80, 0.8, 1.0, 0.1};
const StereoSetting kStereo{0.4, 10.0};

TEST(MethodComparison, FullIsExactAndOpenHolesCost) {
    const auto scene = ballBeforeWall();
    CastFrames frames(scene);
    Progress progress;
    const auto figures = compareMethods(frames, twoPoses(), kLens, kStereo,
                                        settingOf({"cubic", "full", "nofill"}), progress, {});
    ASSERT_EQ(figures.size(), 3u);
    EXPECT_EQ(figures[0].name, "cubic");
    EXPECT_EQ(figures[1].name, "full");
    EXPECT_EQ(figures[2].name, "nofill");
    EXPECT_EQ(figures[1].difference.psnr_db, kIdenticalPsnr_db);
    EXPECT_EQ(figures[1].difference.rgb_max, 0.0);
    EXPECT_EQ(figures[1].hole_percent, 100.0);
    EXPECT_LT(figures[1].true_psnr_db, kIdenticalPsnr_db) << "one ray a pixel misses something";
    EXPECT_LT(figures[1].left_true_psnr_db, kIdenticalPsnr_db);
    EXPECT_NEAR(figures[1].left_true_psnr_db, figures[1].true_psnr_db, 3.0) << "eyes of one kind";
    EXPECT_GT(figures[0].difference.psnr_db, figures[2].difference.psnr_db + 3.0);
    EXPECT_LT(figures[2].difference.edge_psnr_db, figures[2].difference.psnr_db);
    EXPECT_GT(figures[0].hole_percent, 0.0);
    EXPECT_LT(figures[0].hole_percent, 30.0);
    for (const MethodFigures& method : figures) {
        EXPECT_GT(method.left_ms, 0.0) << method.name;
        EXPECT_DOUBLE_EQ(method.full_right_ms, figures[1].full_right_ms) << method.name;
        EXPECT_GT(method.right_ms, 0.0) << method.name;
        EXPECT_GT(method.pair_ms, method.left_ms) << method.name;
        EXPECT_EQ(method.left_true_psnr_db, figures[1].left_true_psnr_db) << "all share the left eye";
        EXPECT_LE(method.difference.rgb_mean, method.difference.rgb_max) << method.name;
    }
}

TEST(MethodComparison, ShowsEveryFrameWithEveryMethod) {
    const auto scene = ballBeforeWall();
    CastFrames frames(scene);
    Progress progress;
    std::vector<int> indices;
    compareMethods(frames, twoPoses(), kLens, kStereo, settingOf({"linear", "mcmillan"}), progress,
                   [&](const ComparedFrame& frame) {
                       indices.push_back(frame.index);
                       ASSERT_EQ(frame.pictures.size(), 2u);
                       EXPECT_EQ(frame.pictures[1].method, "mcmillan");
                       for (const MethodPicture& picture : frame.pictures) {
                           EXPECT_EQ(picture.right.width(), 120);
                           EXPECT_EQ(picture.holeMask.height(), 80);
                       }
                       EXPECT_EQ(frame.truth.width(), 120);
                       EXPECT_EQ(frame.leftTruth.width(), 120);
                   });
    EXPECT_EQ(indices, (std::vector<int>{0, 1}));
}

TEST(MethodComparison, TellsAWholeProgress) {
    const auto scene = ballBeforeWall();
    CastFrames frames(scene);
    for (const bool beside : {false, true}) {
        ComparisonSetting setting = settingOf({"linear", "full"});
        if (beside) setting.beside = twoPoses();
        test::expectWholeProgress(beside ? "with the next frames" : "alone", 5, [&](Progress& progress) {
            compareMethods(frames, twoPoses(), kLens, kStereo, setting, progress, {});
        });
    }
}

TEST(MethodComparison, TheEdgeFigureDoesNotDependOnTheSelection) {
    const auto scene = ballBeforeWall();
    CastFrames frames(scene);
    Progress progress;
    const auto alone =
        compareMethods(frames, twoPoses(), kLens, kStereo, settingOf({"nofill"}), progress, {});
    const auto among = compareMethods(frames, twoPoses(), kLens, kStereo,
                                      settingOf({"cubic", "nofill", "paper"}), progress, {});
    EXPECT_EQ(alone[0].difference.edge_psnr_db, among[1].difference.edge_psnr_db);
    EXPECT_EQ(alone[0].difference.psnr_db, among[1].difference.psnr_db);
}

TEST(MethodComparison, TranslucentScenesCompareTheirOwnMethods) {
    const test::GlassScene scene({test::sphere({0, 8, 0}, 1.0)}, test::plane({0, 20, 0}, {0, -1, 0}), 0.7);
    CastFrames frames(scene);
    Progress progress;
    const auto figures =
        compareMethods(frames, twoPoses(), kLens, kStereo, settingOf({"full", "depthsplat"}), progress, {});
    ASSERT_EQ(figures.size(), 2u);
    EXPECT_EQ(figures[1].name, "depthsplat");
    EXPECT_GT(figures[1].difference.psnr_db, 60.0);
    EXPECT_GT(figures[1].hole_percent, 0.0) << "some rays start at the eye";
    EXPECT_LT(figures[1].hole_percent, 30.0);
    EXPECT_GT(figures[1].warp_ms, 0.0);
    EXPECT_GT(figures[1].fill_ms, 0.0);
}

// Two eyes of one colour each, by methods that make both: "each" is what the others are measured against.
class PaintedPairs final : public FrameMaker {
public:
    std::span<const std::string_view> methods() const override { return kNames; }
    std::string_view defaultMethod() const override { return "together"; }
    std::string_view exactMethod() const override { return "each"; }
    std::string_view whatMethodsMake() const override { return "both eyes"; }
    void make(const StereoViews& views, double time, const FrameWay& way, EyePair& frame) override {
        times.push_back(time);
        const bool wrong = way.method == "wrong left";
        paint(views.left, wrong ? glm::vec3(0.5f) : glm::vec3(0.2f), frame.left);
        paint(views.right, glm::vec3(0.7f), frame.right);
        frame.timings = {};
        frame.timings.both_ms = way.method == "each" ? 20 : 12;
        if (way.method == "each") frame.timings.left_ms = 11, frame.timings.right_ms = 9;
    }
    void makeOne(const EyeView&, double, EyePair&) override { ADD_FAILURE() << "there is no finer truth"; }

    std::vector<double> times;

private:
    static void paint(const EyeView& view, const glm::vec3& color, EyeImage& image) {
        image.resize(view.width, view.height);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                image.color.at(x, y) = packColor(color);
                image.viewDepth.at(x, y) = 10;
            }
    }
    static constexpr std::array<std::string_view, 3> kNames{"together", "each", "wrong left"};
};

TEST(MethodComparison, MethodsThatMakeBothEyesAreMeasuredByBoth) {
    PaintedPairs frames;
    Progress progress;
    int shown = 0;
    const auto figures =
        compareMethods(frames, twoPoses(), kLens, kStereo, settingOf(frames.compared()), progress,
                       [&](const ComparedFrame& frame) {
                           ++shown;
                           ASSERT_EQ(frame.pictures.size(), 3u);
                           EXPECT_TRUE(frame.truth.empty());
                           EXPECT_TRUE(frame.pictures[2].holeMask.empty());
                           EXPECT_NE(frame.pictures[2].left.color.at(3, 3), frame.left.color.at(3, 3));
                       });
    EXPECT_EQ(shown, 2);
    EXPECT_EQ(frames.times, (std::vector<double>{0, 0, 0, 2, 2, 2})) << "the path's own clock";
    ASSERT_EQ(figures.size(), 3u);
    EXPECT_EQ(figures[0].name, "together");
    EXPECT_EQ(figures[0].left_ms, 11);
    EXPECT_EQ(figures[0].right_ms, 1) << "what the other eye costs on top of one by itself";
    EXPECT_EQ(figures[1].right_ms, 9);
    EXPECT_EQ(figures[2].full_right_ms, 9);
    EXPECT_EQ(figures[0].pair_ms, 12);
    EXPECT_EQ(figures[1].pair_ms, 20);
    EXPECT_EQ(figures[0].difference.psnr_db, kIdenticalPsnr_db);
    EXPECT_LT(figures[2].difference.psnr_db, 30) << "the left eye counts";
    for (const MethodFigures& method : figures) {
        EXPECT_TRUE(std::isnan(method.true_psnr_db));
        EXPECT_TRUE(std::isnan(method.left_true_psnr_db));
        EXPECT_TRUE(std::isnan(method.surface_psnr_db));
        EXPECT_EQ(method.hole_percent, 0);
    }
}

// A pair whose left eye is right at even seconds alone: it comes and goes, and the eyes disagree then.
class FlickeringPairs final : public FrameMaker {
public:
    std::span<const std::string_view> methods() const override { return kNames; }
    std::string_view defaultMethod() const override { return "always"; }
    std::string_view exactMethod() const override { return "each"; }
    std::string_view whatMethodsMake() const override { return "both eyes"; }
    void make(const StereoViews& views, double time, const FrameWay& way, EyePair& frame) override {
        const bool wrong = way.method == "always" || (way.method == "odd" && std::fmod(time, 2.0) == 1);
        for (EyeImage* const eye : {&frame.left, &frame.right}) {
            eye->resize(views.left.width, views.left.height);
            for (int y = 0; y < eye->height(); ++y)
                for (int x = 0; x < eye->width(); ++x) {
                    eye->color.at(x, y) = packColor(glm::vec3(wrong && eye == &frame.left ? 0.25f : 0.2f));
                    eye->viewDepth.at(x, y) = 10;
                }
        }
        frame.timings = {};
        frame.timings.both_ms = 2;
        frame.timings.left_ms = frame.timings.right_ms = 1;
    }
    void makeOne(const EyeView&, double, EyePair&) override { ADD_FAILURE() << "there is no finer truth"; }

private:
    static constexpr std::array<std::string_view, 3> kNames{"each", "always", "odd"};
};

TEST(MethodComparison, WhatComesAndGoesFlickersAndEyesThatDisagreeAreRivals) {
    FlickeringPairs frames;
    Progress progress;
    ComparisonSetting setting = settingOf(frames.compared());
    const auto still = compareMethods(frames, twoPoses(), kLens, kStereo, setting, progress, {});
    for (const MethodFigures& method : still) EXPECT_TRUE(std::isnan(method.flicker_db)) << method.name;
    setting.beside = {{twoPoses()[0].pose, 1}, {twoPoses()[1].pose, 3}};
    const auto figures = compareMethods(frames, twoPoses(), kLens, kStereo, setting, progress, {});
    ASSERT_EQ(figures.size(), 3u);
    EXPECT_EQ(figures[0].flicker_db, kIdenticalPsnr_db);
    EXPECT_EQ(figures[0].rivalry_db, kIdenticalPsnr_db);
    EXPECT_EQ(figures[1].flicker_db, kIdenticalPsnr_db) << "its error stays";
    EXPECT_LT(figures[1].rivalry_db, 30) << "one eye is brighter";
    EXPECT_LT(figures[2].flicker_db, 30);
    EXPECT_EQ(figures[2].rivalry_db, kIdenticalPsnr_db) << "both are right at even seconds";
    EXPECT_EQ(figures[2].difference.psnr_db, kIdenticalPsnr_db) << "the neighbour is for flicker alone";
}

TEST(MethodComparison, WarpedScenesHaveThemFromTheFinerTruths) {
    const auto scene = ballBeforeWall();
    CastFrames frames(scene);
    Progress progress;
    ComparisonSetting setting = settingOf({"full", "cubic", "nofill"});
    setting.beside = {{poseFromAngles({0.1, 0, 0}, 0, 0, 0), 1},
                      {poseFromAngles({0.6, 0, 0.2}, 0.05, 0, 0), 3}};
    const auto figures = compareMethods(frames, twoPoses(), kLens, kStereo, setting, progress, {});
    for (const MethodFigures& method : figures) {
        EXPECT_LT(method.flicker_db, 70) << method.name << ": one ray a pixel flickers";
        EXPECT_LT(method.rivalry_db, 70) << method.name;
        EXPECT_LT(method.edge_rivalry_db, method.rivalry_db) << method.name;
    }
    EXPECT_GT(figures[0].flicker_db, figures[2].flicker_db + 3) << "black holes flicker";
    EXPECT_GT(figures[1].flicker_db, figures[2].flicker_db + 3);
}

TEST(MethodComparison, NeedsPosesAndMethods) {
    const auto scene = ballBeforeWall();
    CastFrames frames(scene);
    Progress progress;
    EXPECT_THROW(compareMethods(frames, {}, kLens, kStereo, settingOf({"full"}), progress, {}), Error);
    EXPECT_THROW(compareMethods(frames, twoPoses(), kLens, kStereo, settingOf({}), progress, {}), Error);
    EXPECT_THROW(medianOf({}), Error);
}

TEST(MethodComparison, MediansAreOfEachFieldByItself) {
    std::vector<MethodFigures> frames(4);
    const double left[] = {4, 1, 3, 2}, truth[] = {10, 40, 20, 30};
    for (int k = 0; k < 4; ++k) {
        frames[k].name = "x";
        frames[k].left_ms = left[k];
        frames[k].true_psnr_db = truth[k];
        frames[k].left_true_psnr_db = 2 * truth[k];
        frames[k].pair_ms = 10 * left[k];
        frames[k].flicker_db = truth[k];
        frames[k].rivalry_db = truth[k] + 1;
        frames[k].edge_rivalry_db = truth[k] + 2;
        frames[k].difference.rgb_max = k == 2 ? 9 : 1;
    }
    EXPECT_EQ(medianOf(frames).left_ms, 2.5);
    EXPECT_EQ(medianOf(frames).true_psnr_db, 25.0);
    EXPECT_EQ(medianOf(frames).left_true_psnr_db, 50.0);
    EXPECT_EQ(medianOf(frames).pair_ms, 25.0);
    EXPECT_EQ(medianOf(frames).flicker_db, 25.0);
    EXPECT_EQ(medianOf(frames).rivalry_db, 26.0);
    EXPECT_EQ(medianOf(frames).edge_rivalry_db, 27.0);
    EXPECT_EQ(medianOf(frames).difference.rgb_max, 1.0);
    frames.resize(3);
    EXPECT_EQ(medianOf(frames).left_ms, 3.0);
    EXPECT_EQ(medianOf(frames).name, "x");
}

}  // namespace
}  // namespace stereonav
