// The comparison on a scene with known answers.
#include "engine/metrics/method_comparison.h"

#include <gtest/gtest.h>

#include "engine/base/error.h"
#include "tests/support/analytic_scene.h"

namespace stereonav {
namespace {

// A near ball in front of a far wall: holes beside the ball.
test::AnalyticScene ballBeforeWall() {
    return test::AnalyticScene({test::sphere({0, 8, 0}, 1.0), test::plane({0, 20, 0}, {0, -1, 0})}, 0.7);
}

std::vector<Pose> twoPoses() {
    return {poseFromAngles({0, 0, 0}, 0, 0, 0), poseFromAngles({0.5, 0, 0.2}, 0.05, 0, 0)};
}

ComparisonSetting settingOf(std::vector<RightEyeMethod> methods) {
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
    Progress progress;
    const auto figures = compareMethods(
        scene, twoPoses(), kLens, kStereo,
        settingOf({RightEyeMethod::Cubic, RightEyeMethod::Full, RightEyeMethod::NoFill}), progress, {});
    ASSERT_EQ(figures.size(), 3u);
    EXPECT_EQ(figures[0].name, "cubic");
    EXPECT_EQ(figures[1].name, "full");
    EXPECT_EQ(figures[2].name, "nofill");
    EXPECT_EQ(figures[1].difference.psnr_db, kIdenticalPsnr_db);
    EXPECT_EQ(figures[1].difference.rgb_max, 0.0);
    EXPECT_EQ(figures[1].hole_percent, 100.0);
    EXPECT_LT(figures[1].true_psnr_db, kIdenticalPsnr_db) << "one ray a pixel misses something";
    EXPECT_GT(figures[0].difference.psnr_db, figures[2].difference.psnr_db + 3.0);
    EXPECT_LT(figures[2].difference.edge_psnr_db, figures[2].difference.psnr_db);
    EXPECT_GT(figures[0].hole_percent, 0.0);
    EXPECT_LT(figures[0].hole_percent, 30.0);
    for (const MethodFigures& method : figures) {
        EXPECT_GT(method.left_ms, 0.0) << method.name;
        EXPECT_DOUBLE_EQ(method.full_right_ms, figures[1].full_right_ms) << method.name;
        EXPECT_GT(method.right_ms, 0.0) << method.name;
        EXPECT_LE(method.difference.rgb_mean, method.difference.rgb_max) << method.name;
    }
}

TEST(MethodComparison, ShowsEveryFrameWithEveryMethod) {
    const auto scene = ballBeforeWall();
    double last = -1;
    Progress progress([&](double share, const std::string&) {
        EXPECT_GE(share, last);
        last = share;
    });
    std::vector<int> indices;
    compareMethods(scene, twoPoses(), kLens, kStereo,
                   settingOf({RightEyeMethod::Linear, RightEyeMethod::McMillan}), progress,
                   [&](const ComparedFrame& frame) {
                       indices.push_back(frame.index);
                       ASSERT_EQ(frame.pictures.size(), 2u);
                       EXPECT_EQ(frame.pictures[1].method, RightEyeMethod::McMillan);
                       for (const MethodPicture& picture : frame.pictures) {
                           EXPECT_EQ(picture.right.width(), 120);
                           EXPECT_EQ(picture.holeMask.height(), 80);
                       }
                       EXPECT_EQ(frame.truth.width(), 120);
                   });
    EXPECT_EQ(indices, (std::vector<int>{0, 1}));
    EXPECT_DOUBLE_EQ(last, 1.0);
}

TEST(MethodComparison, TheEdgeFigureDoesNotDependOnTheSelection) {
    const auto scene = ballBeforeWall();
    Progress progress;
    const auto alone =
        compareMethods(scene, twoPoses(), kLens, kStereo, settingOf({RightEyeMethod::NoFill}), progress, {});
    const auto among = compareMethods(
        scene, twoPoses(), kLens, kStereo,
        settingOf({RightEyeMethod::Cubic, RightEyeMethod::NoFill, RightEyeMethod::Paper}), progress, {});
    EXPECT_EQ(alone[0].difference.edge_psnr_db, among[1].difference.edge_psnr_db);
    EXPECT_EQ(alone[0].difference.psnr_db, among[1].difference.psnr_db);
}

TEST(MethodComparison, TranslucentScenesCompareTheirOwnMethods) {
    const test::GlassScene scene({test::sphere({0, 8, 0}, 1.0)}, test::plane({0, 20, 0}, {0, -1, 0}), 0.7);
    Progress progress;
    const auto figures =
        compareMethods(scene, twoPoses(), kLens, kStereo,
                       settingOf({RightEyeMethod::Full, RightEyeMethod::DepthSplat}), progress, {});
    ASSERT_EQ(figures.size(), 2u);
    EXPECT_EQ(figures[1].name, "depthsplat");
    EXPECT_GT(figures[1].difference.psnr_db, 60.0);
    EXPECT_GT(figures[1].hole_percent, 0.0) << "some rays start at the eye";
    EXPECT_LT(figures[1].hole_percent, 30.0);
    EXPECT_GT(figures[1].warp_ms, 0.0);
    EXPECT_GT(figures[1].fill_ms, 0.0);
}

TEST(MethodComparison, NeedsPosesAndMethods) {
    const auto scene = ballBeforeWall();
    Progress progress;
    EXPECT_THROW(compareMethods(scene, {}, kLens, kStereo, settingOf({RightEyeMethod::Full}), progress, {}),
                 Error);
    EXPECT_THROW(compareMethods(scene, twoPoses(), kLens, kStereo, settingOf({}), progress, {}), Error);
    EXPECT_THROW(medianOf({}), Error);
}

TEST(MethodComparison, MediansAreOfEachFieldByItself) {
    std::vector<MethodFigures> frames(4);
    const double left[] = {4, 1, 3, 2}, truth[] = {10, 40, 20, 30};
    for (int k = 0; k < 4; ++k) {
        frames[k].name = "x";
        frames[k].left_ms = left[k];
        frames[k].true_psnr_db = truth[k];
        frames[k].difference.rgb_max = k == 2 ? 9 : 1;
    }
    EXPECT_EQ(medianOf(frames).left_ms, 2.5);
    EXPECT_EQ(medianOf(frames).true_psnr_db, 25.0);
    EXPECT_EQ(medianOf(frames).difference.rgb_max, 1.0);
    frames.resize(3);
    EXPECT_EQ(medianOf(frames).left_ms, 3.0);
    EXPECT_EQ(medianOf(frames).name, "x");
}

}  // namespace
}  // namespace stereonav
