// Frames that are averaged until they are the truth: the mean is that of pictures made one by one, the
// expected error is above the true one, and a scene without anything to average has none.
#include "engine/frame/refined_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/frame/cast_frames.h"
#include "engine/frame/sliced_frames.h"
#include "engine/sampling/pixel_samples.h"
#include "tests/support/analytic_scene.h"
#include "tests/support/one_method_frames.h"

namespace stereonav {
namespace {

StereoViews refinedViews() {
    Lens lens;
    lens.width = 77;
    lens.height = 51;
    return makeStereoViews(poseFromAngles({0, 0, 0}, 0, -0.1, 0), lens, {0.3, 9.0});
}

test::AnalyticScene refinedScene() {
    return test::AnalyticScene({test::sphere({-1.5, 10, -1}, 1.7), test::box({1, 9, -4}, {2.2, 11, 1}),
                                test::plane({0, 0, -4}, {0.1, 0, 1})});
}

double levelsApart(const Plane<PackedColor>& a, const Plane<glm::vec3>& truth) {
    double sum = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            const glm::vec3 is = unpackColor(a.at(x, y)), should = truth.at(x, y);
            for (int c = 0; c < 3; ++c) sum += std::pow(std::sqrt(is[c]) - std::sqrt(should[c]), 2.0);
        }
    return 255 * std::sqrt(sum / (3.0 * a.width() * a.height()));
}

// The mean of a grid of factor x factor rays in each pixel.
Plane<glm::vec3> truthOf(const EyeRenderer& scene, const EyeView& view, int factor) {
    EyeImage fine;
    fine.resize(view.width * factor, view.height * factor, scene.viewDependence());
    renderEye(scene, view.supersampled(factor), fine);
    Plane<glm::vec3> mean(view.width, view.height);
    for (int y = 0; y < fine.height(); ++y)
        for (int x = 0; x < fine.width(); ++x)
            mean.at(x / factor, y / factor) +=
                unpackColor(fine.color.at(x, y)) / static_cast<float>(factor * factor);
    return mean;
}

TEST(RefinedFrames, AreTheMeanOfFramesMadeOneByOne) {
    const test::AnalyticScene scene = refinedScene();
    CastFrames frames(scene);
    const StereoViews views = refinedViews();
    RefinedFrames refined;
    for (int round = 0; round < 2; ++round) {  // what was before is forgotten
        refined.restart();
        EXPECT_EQ(refined.count(), 0);
        Plane<glm::vec3> left(77, 51), right(77, 51);
        EyePair first;
        for (int k = 0; k < 5; ++k) {
            refined.add(frames, views, 0, {"full"});
            EyePair frame;
            frames.make(shiftedBy(views, evenPlace(k)), 0, {"full"}, frame);
            if (k == 0) first = frame;
            for (int y = 0; y < 51; ++y)
                for (int x = 0; x < 77; ++x) {
                    left.at(x, y) += unpackColor(frame.left.color.at(x, y)) / 5.0f;
                    right.at(x, y) += unpackColor(frame.right.color.at(x, y)) / 5.0f;
                }
        }
        EXPECT_EQ(refined.count(), 5);
        const EyePair& mean = refined.mean();
        EXPECT_LT(levelsApart(mean.left.color, left), 0.15) << "packed channels are rounded";
        EXPECT_LT(levelsApart(mean.right.color, right), 0.15);
        for (int y = 0; y < 51; ++y)
            for (int x = 0; x < 77; ++x) {
                ASSERT_EQ(mean.left.viewDepth.at(x, y), first.left.viewDepth.at(x, y));
                ASSERT_EQ(mean.right.viewDepth.at(x, y), first.right.viewDepth.at(x, y));
            }
    }
}

TEST(RefinedFrames, ExpectAnErrorThatIsNotBelowTheTrueOne) {
    const test::AnalyticScene scene = refinedScene();
    CastFrames frames(scene);
    const StereoViews views = refinedViews();
    const Plane<glm::vec3> left = truthOf(scene, views.left, 16), right = truthOf(scene, views.right, 16);
    RefinedFrames refined;
    EXPECT_TRUE(std::isinf(refined.error_levels()));
    EXPECT_EQ(refined.error_db(), 0);
    double last = 0;
    for (int k = 1; k <= 64; ++k) {
        refined.add(frames, views, 0, {"full"});
        if (k < 8 || k % 8 != 0) continue;
        const double true_ = std::hypot(levelsApart(refined.mean().left.color, left),
                                        levelsApart(refined.mean().right.color, right)) /
                             std::sqrt(2.0);
        EXPECT_LT(true_, refined.error_levels() * 1.05 + 0.05) << k;
        EXPECT_GT(true_, refined.error_levels() * 0.1) << k;
        last = true_;
    }
    EXPECT_LT(last, 1) << "of a picture that is all edges";
    EXPECT_NEAR(refined.error_db(), 20 * std::log10(255 / refined.error_levels()), 1e-9);
}

TEST(RefinedFrames, DoNotDependOnThreads) {
    const test::AnalyticScene scene = refinedScene();
    CastFrames frames(scene);
    RefinedFrames all, one;
    const int threads = threadCount();
    for (int k = 0; k < 4; ++k) all.add(frames, refinedViews(), 0, {"linear"});
    setThreadCount(1);
    for (int k = 0; k < 4; ++k) one.add(frames, refinedViews(), 0, {"linear"});
    EXPECT_EQ(all.error_levels(), one.error_levels());
    setThreadCount(threads);
    for (int y = 0; y < 51; ++y)
        for (int x = 0; x < 77; ++x)
            ASSERT_EQ(all.mean().right.color.at(x, y), one.mean().right.color.at(x, y));
}

TEST(RefinedFrames, OneEyeAndAnEmptySky) {
    const test::AnalyticScene nothing({});
    CastFrames frames(nothing);
    RefinedFrames refined;
    for (int k = 0; k < 4; ++k) refined.addOne(frames, refinedViews().left, 0);
    EXPECT_TRUE(refined.mean().right.color.empty());
    EXPECT_LT(refined.error_levels(), 1) << "a smooth sky";
    EXPECT_GT(refined.error_db(), 48);
    EXPECT_LE(refined.error_db(), kMostPsnr_db);
}

TEST(RefinedFrames, WhatFailsChangesNothing) {
    const test::AnalyticScene scene = refinedScene();
    CastFrames frames(scene);
    RefinedFrames refined;
    refined.add(frames, refinedViews(), 0, {"full"});
    refined.add(frames, refinedViews(), 0, {"full"});
    const double before = refined.error_levels();
    EXPECT_THROW(refined.add(frames, refinedViews(), 0, {"unheard-of"}), Error);
    EXPECT_EQ(refined.count(), 2);
    EXPECT_EQ(refined.error_levels(), before);
}

// Grey that depends on nothing but the turn; one step of the packed colour for each hundredth.
class GreyTurned final : public test::OneMethodFrames, public SlicedFrames {
public:
    void makeOne(const EyeView& view, double, EyePair& frame) override {
        turns.push_back(mTurn);
        if (mTurn == failsAt) throw Error("", "", "it failed", "do nothing");
        frame.left.resize(view.width, view.height);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x)
                frame.left.color.at(x, y) = packColor(glm::vec3(static_cast<float>(mTurn)));
    }
    void setTurn(double turn) override { mTurn = turn; }
    void setEffort(double) override {}

    std::vector<double> turns;
    double failsAt = -1;

private:
    double mTurn = 0;
};

// What is arbitrary about a frame is another in each, evenly, and as it was afterwards.
TEST(RefinedFrames, TurnWhatCanBeTurned) {
    GreyTurned frames;
    RefinedFrames refined;
    for (int k = 0; k < 64; ++k) refined.add(frames, refinedViews(), 0, {});
    std::vector<double> sorted = frames.turns;
    EXPECT_EQ(sorted.front(), 0) << "the first is as it is alone";
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t k = 0; k < sorted.size(); ++k)
        EXPECT_NEAR(sorted[k], static_cast<double>(k) / 64, 0.025) << "evenly";
    EXPECT_NEAR(unpackColor(refined.mean().left.color.at(3, 3)).x, 0.5, 0.02);
    EyePair alone;
    frames.make(refinedViews(), 0, {}, alone);
    EXPECT_EQ(frames.turns.back(), 0);
    frames.failsAt = frames.turns[1];
    refined.restart();
    refined.addOne(frames, refinedViews().left, 0);
    EXPECT_THROW(refined.addOne(frames, refinedViews().left, 0), Error);
    frames.failsAt = -1;
    frames.make(refinedViews(), 0, {}, alone);
    EXPECT_EQ(frames.turns.back(), 0) << "also where it failed";
}

// The first one may be there already.
TEST(RefinedFrames, BeginWithAFrameThatWasMade) {
    const test::AnalyticScene scene = refinedScene();
    CastFrames frames(scene);
    RefinedFrames all, begun;
    for (int k = 0; k < 3; ++k) all.add(frames, refinedViews(), 0, {"full"});
    EyePair first;
    frames.make(refinedViews(), 0, {"full"}, first);
    begun.begin(first);
    EXPECT_EQ(begun.count(), 1);
    for (int k = 1; k < 3; ++k) begun.add(frames, refinedViews(), 0, {"full"});
    EXPECT_EQ(begun.error_levels(), all.error_levels());
    for (int y = 0; y < 51; ++y)
        for (int x = 0; x < 77; ++x)
            ASSERT_EQ(begun.mean().right.color.at(x, y), all.mean().right.color.at(x, y));
}

}  // namespace
}  // namespace stereonav
