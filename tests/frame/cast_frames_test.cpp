// Frames of cast scenes: the pictures are those of the left eye's cast and of RightEye, by every method's
// name.
#include "engine/frame/cast_frames.h"

#include <gmock/gmock.h>

#include <cstring>

#include "engine/base/error.h"
#include "tests/support/analytic_scene.h"

namespace stereonav {
namespace {

constexpr int kWidth = 61, kHeight = 43;

StereoViews framedViews(double x = 0) {
    Lens lens;
    lens.width = kWidth;
    lens.height = kHeight;
    return makeStereoViews(poseFromAngles({x, 0, 0}, 0, -0.2, 0), lens, {0.3, 9.0});
}

test::AnalyticScene boxes() {
    return test::AnalyticScene(
        {test::box({-4, 9, -3}, {-0.5, 11, 1}), test::box({-20, 20, -9}, {20, 22, 9})});
}

template <typename T>
bool same(const Plane<T>& a, const Plane<T>& b) {
    if (a.width() != b.width() || a.height() != b.height()) return false;
    for (int y = 0; y < a.height(); ++y)
        if (std::memcmp(a.row(y), b.row(y), sizeof(T) * static_cast<std::size_t>(a.width())) != 0)
            return false;
    return true;
}

TEST(CastFrames, AreThoseOfTheParts) {
    const test::AnalyticScene scene = boxes();
    CastFrames frames(scene);
    ASSERT_EQ(frames.methods().size(), kRightEyeMethods.size());
    for (const std::string_view name : frames.methods()) {
        SCOPED_TRACE(name);
        const StereoViews views = framedViews();
        EyePair frame;
        frames.make(views, 0, {name, {}}, frame);
        EyeImage left, right;
        left.resize(kWidth, kHeight, scene.viewDependence());
        renderEye(scene, views.left, left);
        WarpSetting setting;
        setting.method = *rightEyeMethodFromName(name);
        RightEye eye;
        const RightEyeTimings timings = eye.render(scene, views, left, setting, right);
        EXPECT_TRUE(same(frame.left.color, left.color));
        EXPECT_TRUE(same(frame.left.viewDepth, left.viewDepth));
        EXPECT_TRUE(same(frame.right.color, right.color));
        EXPECT_TRUE(same(frame.right.viewDepth, right.viewDepth));
        ASSERT_TRUE(frame.timings.warped);
        EXPECT_EQ(frame.timings.warped->holePixels, timings.holePixels);
        EXPECT_GT(frame.timings.left_ms, 0);
        if (name == "linear") {
            EXPECT_GT(timings.holePixels, 0) << "something is in view";
        }
        EXPECT_DOUBLE_EQ(frame.timings.both_ms, frame.timings.left_ms + frame.timings.right_ms);
    }
}

TEST(CastFrames, TheDefaultIsTheScenes) {
    const test::AnalyticScene scene = boxes();
    CastFrames frames(scene);
    EXPECT_EQ(frames.defaultMethod(), nameOf(defaultMethodFor(scene)));
    EyePair unnamed, named;
    frames.make(framedViews(), 0, {}, unnamed);
    frames.make(framedViews(), 0, {frames.defaultMethod(), {}}, named);
    EXPECT_TRUE(same(unnamed.right.color, named.right.color));
}

TEST(CastFrames, OneEyeLeavesNothingOfTheOther) {
    const test::AnalyticScene scene = boxes();
    CastFrames frames(scene);
    EyePair both, one;
    frames.make(framedViews(), 0, {}, both);
    frames.make(framedViews(1), 0, {}, one);
    frames.makeOne(framedViews().left, 0, one);
    EXPECT_TRUE(same(one.left.color, both.left.color));
    EXPECT_TRUE(one.right.color.empty());
    EXPECT_FALSE(one.timings.warped);
    EXPECT_EQ(one.timings.right_ms, 0);
    EXPECT_EQ(one.timings.both_ms, one.timings.left_ms);
}

TEST(CastFrames, UnknownMethodsAreRefused) {
    const test::AnalyticScene scene = boxes();
    CastFrames frames(scene);
    EyePair frame;
    EXPECT_THROW(frames.make(framedViews(), 0, {"sweep", {}}, frame), Error);
    const std::vector<StereoViews> views{framedViews()};
    EXPECT_THROW(frames.meet({0.5}, "sweep", views), Error);
}

TEST(CastFrames, ARightEyeByItselfIsThatOfTheFrame) {
    const test::AnalyticScene scene = boxes();
    CastFrames frames(scene);
    RightFromLeft* const byItself = frames.rightFromLeft();
    ASSERT_TRUE(byItself);
    EyePair exact, whole;
    EyeImage right;
    frames.make(framedViews(), 0, {frames.exactMethod(), {}}, exact);
    EXPECT_FALSE(byItself->holes().open);
    for (const std::string_view name : frames.methods()) {
        SCOPED_TRACE(name);
        const RightEyeTimings timings = byItself->makeRight(framedViews(), exact.left, {name, {}}, right);
        const bool open = leavesHoles(*rightEyeMethodFromName(name));
        EXPECT_EQ(byItself->holes().open, open);
        long long holes = 0;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) holes += byItself->holes().mask.at(x, y) != 0;
        EXPECT_EQ(timings.holePixels, open ? 0 : holes) << "those that were cast";
        EXPECT_GT(holes, 0) << "something is in view";
        frames.make(framedViews(), 0, {name, {}}, whole);
        EXPECT_TRUE(same(whole.left.color, exact.left.color));
        EXPECT_TRUE(same(whole.right.color, right.color));
        EXPECT_TRUE(same(whole.right.viewDepth, right.viewDepth));
    }
    EXPECT_THROW(byItself->makeRight(framedViews(), exact.left, {"sweep", {}}, right), Error);
}

TEST(CastFrames, AComparisonMayLeaveOneOut) {
    const test::AnalyticScene scene = boxes();
    std::vector<std::string_view> all = CastFrames(scene).compared();
    EXPECT_EQ(all.size(), methodsFor(scene).size());
    EXPECT_EQ(all.front(), CastFrames(scene).exactMethod());
    std::erase(all, "cubic");
    EXPECT_EQ(CastFrames(scene, RightEyeMethod::Cubic).compared(), all);
}

TEST(CastFrames, WishesForQualityAreMet) {
    const test::AnalyticScene scene = boxes();
    CastFrames frames(scene);
    const std::vector<StereoViews> views{framedViews(), framedViews(2)};
    const auto plan = frames.measure(views);
    ASSERT_TRUE(plan);
    EXPECT_EQ(plan->width, kWidth);
    const auto all = frames.meet({1.0}, "", views);
    ASSERT_TRUE(all);
    const auto kept = frames.meet({0.5}, "cubic", views);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->setting.method, RightEyeMethod::Cubic);
    // All of the expected error taken away: the full cast, or all pixels cast beside the holes.
    EyePair frame, full;
    frames.make(views[0], 0, {nameOf(all->setting.method), all->setting}, frame);
    frames.make(views[0], 0, {"full", {}}, full);
    EXPECT_TRUE(same(frame.right.color, full.right.color));
}

}  // namespace
}  // namespace stereonav
