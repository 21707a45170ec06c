// A medium at rest is refined by more slices until these change nothing, then by the mean of frames whose
// slices lie elsewhere.
#include "app/view/rest_refiner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/medium/sweep/swept_frames.h"
#include "engine/metrics/image_difference.h"
#include "tests/medium/sweep_scenes.h"

namespace stereonav {
namespace {

class RestingMedium final : public Scene, SweepPlace {
public:
    RestingMedium(Medium medium, int slices)
        : mMedium{std::move(medium), {}, {}, {}, {}, "", "", "", {}, {}}, mFrames(mMedium) {
        mMedium.look.light = test::sun({0, 0.3, -1}, 4);
        mMedium.sweep.slices = slices;
        mMedium.sweep.lightSize = 16;
        offer(mFrames);
        offer<SweepPlace>(*this);
    }
    FrameMaker& frames() const override { return mFrames; }
    std::unique_ptr<Flight> makeFlight() const override { return nullptr; }
    SweptFrames& swept() const { return mFrames; }

private:
    std::string name() const override { return kCpuSweep; }
    MediumScene mMedium;
    mutable SweptFrames mFrames;
};

std::shared_ptr<const ViewFrame> restingFrame(const RestingMedium& scene) {
    auto frame = std::make_shared<ViewFrame>();
    FrameRequest& request = frame->request;
    request.pose = poseFromAngles({0, 0, 30}, 0, -1.5, 0);
    request.lens.width = 20;
    request.lens.height = 16;
    request.lens.verticalFov = 0.1;
    request.stereo = {0.1, 30.0};
    request.refines = true;
    scene.frames().make(makeStereoViews(request.pose, request.lens, request.stereo), 0, {}, *frame);
    return frame;
}

TEST(RestRefiner, GivesAMediumMoreSlicesAndThenMoreRays) {
    const RestingMedium scene(test::slabOf({{0.5}, {0.1}}, 4), 64);
    const auto drawn = restingFrame(scene);
    RestRefiner refiner;
    refiner.start(drawn);
    ViewFrame shown;
    double effort = 1, before = 0;
    int steps = 0, shows = 0;
    for (; refiner.wantsMore() && steps < 40; ++steps) {
        if (!refiner.step(scene, shown)) continue;
        ++shows;
        EXPECT_GE(shown.effort, effort);
        EXPECT_TRUE(shown.effort == 2 * effort || shown.rays > 1) << "one after the other";
        effort = shown.effort;
        if (shown.rays == 1) {
            EXPECT_GE(shown.expected_db, before - 1) << "nearer with more slices";
            before = shown.expected_db;
        }
        EXPECT_EQ(shown.request.version, drawn->request.version);
        EXPECT_EQ(shown.left.viewDepth.at(3, 3), drawn->left.viewDepth.at(3, 3));
    }
    EXPECT_LT(steps, 20) << "it ends";
    EXPECT_GE(shows, 2);
    EXPECT_GE(shown.rays, 8);
    EXPECT_GT(shown.expected_db, 40);

    // The result is nearer to the truth than the picture that was drawn.
    EyePair fine;
    scene.swept().setEffort(64);
    const FrameRequest& request = drawn->request;
    scene.frames().make(makeStereoViews(request.pose, request.lens, request.stereo), 0, {kTwoSweepsMethod},
                        fine);
    scene.swept().setEffort(1);
    EXPECT_GE(errorOf(fine.left.color, shown.left.color).psnr_db,
              errorOf(fine.left.color, drawn->left.color).psnr_db);
    EXPECT_GE(errorOf(fine.right.color, shown.right.color).psnr_db,
              errorOf(fine.right.color, drawn->right.color).psnr_db);
    EXPECT_GT(errorOf(fine.right.color, shown.right.color).psnr_db, 40);
    EyePair again;  // later frames are made as before
    scene.frames().make(makeStereoViews(request.pose, request.lens, request.stereo), 0, {}, again);
    EXPECT_EQ(errorOf(again.left.color, drawn->left.color).psnr_db, kIdenticalPsnr_db);
}

TEST(RestRefiner, LeavesAPictureThatIsNotWhole) {
    const RestingMedium scene(test::slabOf({{0.5}}, 4), 8);
    for (int kind = 0; kind < 3; ++kind) {
        auto frame = std::make_shared<ViewFrame>(*restingFrame(scene));
        frame->request.effort = kind == 0 ? 0.5 : 1;
        frame->request.scale = kind == 1 ? 0.5 : 1;
        frame->request.refines = kind != 2;
        RestRefiner refiner;
        refiner.start(frame);
        EXPECT_FALSE(refiner.wantsMore()) << kind;
    }
}

}  // namespace
}  // namespace stereonav
