// Paint is put over each eye once, in the window's frames, at rest, over the truth that a frame is compared
// with, and in pictures for files.
#include <gtest/gtest.h>

#include "app/output/stereo_frame.h"
#include "app/view/frame_truth.h"
#include "app/view/rest_refiner.h"
#include "engine/base/parallel.h"
#include "engine/frame/cast_frames.h"
#include "engine/metrics/image_difference.h"
#include "tests/support/analytic_scene.h"
#include "tests/support/wait_for.h"
#include "tests/view/fake_scene.h"

namespace stereonav {
namespace {

PackedColor halved(PackedColor color) {
    return packColor(unpackColor(color) * 0.25f);  // half of the packed value
}

// Surfaces left of x = 0 get darker with each coat.
class DarkerOnTheLeft final : public EyePainter {
public:
    void paint(const EyeView& view, EyeImage& image) const override {
        parallelFor(image.height(), [&](int y) {
            for (int x = 0; x < image.width(); ++x) {
                const float depth = image.viewDepth.at(x, y);
                if (depth == kMissDepth || view.pointAt(x + 0.5, y + 0.5, depth).x >= 0) continue;
                image.color.at(x, y) = halved(image.color.at(x, y));
            }
        });
    }
};

class PaintedFrames : public testing::Test {
protected:
    PaintedFrames() {
        mParts.frames = &mFrames;
        mParts.rays = &mAnalytic;
        mParts.lens.width = 77;
        mParts.lens.height = 51;
        mParts.stereo = {0.3, 9.0};
        mParts.way.method = "linear";
        mPainted = mParts;
        mPainted.painters = {std::make_shared<DarkerOnTheLeft>()};
    }
    FrameRequest request() const {
        FrameRequest request;
        request.version = 1;
        request.pose = poseFromAngles({0, 0, 0}, 0, -0.1, 0);
        request.lens = mParts.lens;
        request.stereo = mParts.stereo;
        request.way = mParts.way;
        request.refines = true;
        return request;
    }
    StereoViews views() const { return makeStereoViews(request().pose, request().lens, request().stereo); }
    // Expects `plain` with one coat in each eye.
    void expectOneCoat(const EyePair& plain, const EyePair& painted) const {
        EyePair coated = plain;
        const DarkerOnTheLeft coat;
        coat.paint(views().left, coated.left);
        coat.paint(views().right, coated.right);
        EXPECT_LT(errorOf(plain.left.color, coated.left.color).psnr_db, 30) << "it is seen";
        EXPECT_EQ(errorOf(coated.left.color, painted.left.color).psnr_db, kIdenticalPsnr_db);
        EXPECT_EQ(errorOf(coated.right.color, painted.right.color).psnr_db, kIdenticalPsnr_db);
    }
    std::shared_ptr<const ViewFrame> frameOf(const FakeParts& parts, const FrameRequest& request) {
        ViewWorker worker([&](Progress&) { return openOf(parts); }, [] {});
        worker.request(request);
        return test::waitFor([&] { return worker.takeFrame(); });
    }

    test::AnalyticScene mAnalytic{{test::sphere({-1.5, 10, -1}, 1.7), test::box({1, 9, -4}, {2.2, 11, 1}),
                                   test::plane({0, 0, -4}, {0.1, 0, 1})}};
    CastFrames mFrames{mAnalytic};
    FakeParts mParts, mPainted;
};

TEST_F(PaintedFrames, AreThoseOfTheWindow) {
    expectOneCoat(*frameOf(mParts, request()), *frameOf(mPainted, request()));
    FrameRequest one = request();
    one.twoEyes = false;
    const auto painted = frameOf(mPainted, one), plain = frameOf(mParts, one);
    EyePair coated = *plain;
    DarkerOnTheLeft().paint(makeEyeView(one.pose, one.lens), coated.left);
    EXPECT_EQ(errorOf(coated.left.color, painted->left.color).psnr_db, kIdenticalPsnr_db);
}

TEST_F(PaintedFrames, GetTheirCoatAtRestToo) {
    const auto rested = [&](const FakeParts& parts) {
        const auto scene = opened(parts);
        RestRefiner refiner;
        refiner.start(frameOf(parts, request()));
        ViewFrame shown;
        for (int shows = 0; refiner.wantsMore() && shows < 2;) shows += refiner.step(*scene->scene, shown);
        EXPECT_GE(shown.rays, 8);
        return shown;
    };
    expectOneCoat(rested(mParts), rested(mPainted));
}

TEST_F(PaintedFrames, AreHeldAgainstPaintedTruths) {
    const auto error = [&](const FakeParts& parts) {
        const auto scene = opened(parts);
        const auto frame = frameOf(parts, request());
        TruthMaker maker;
        const std::atomic<bool> stop = false;
        const auto truth = maker.measure(*scene->scene, views(), 0, request().way, *frame, stop);
        return truth->error.psnr_db;
    };
    const double plain = error(mParts), painted = error(mPainted);
    EXPECT_LT(plain, kIdenticalPsnr_db);
    EXPECT_NEAR(painted, plain, 3) << "as near as without";
}

TEST_F(PaintedFrames, AreWrittenOnlyWithTheirCoat) {
    const auto framed = [&](const FakeParts& parts) {
        auto scene = opened(parts);
        auto frame = std::make_unique<StereoFrame>(*scene->scene, "linear");
        frame->render(request().pose);
        frame->paint();
        EyePair pair;
        pair.left = frame->left();
        pair.right = frame->right();
        return pair;
    };
    expectOneCoat(framed(mParts), framed(mPainted));
}

}  // namespace
}  // namespace stereonav
