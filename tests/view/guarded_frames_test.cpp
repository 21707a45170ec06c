// Frames in flight that are cast wider than they are shown, from the thread that makes them to the picture.
#include <gtest/gtest.h>

#include <memory>

#include "app/view/late_view.h"
#include "app/view/worker.h"
#include "tests/support/wait_for.h"
#include "tests/view/fake_scene.h"

namespace stereonav {
namespace {

// A wall at one view depth; its colours encode the direction of each pixel.
class GuardedWall final : public FrameMaker {
public:
    std::span<const std::string_view> methods() const override { return kMethods; }
    std::string_view defaultMethod() const override { return kMethods[0]; }
    std::string_view exactMethod() const override { return kMethods[0]; }
    std::string_view whatMethodsMake() const override { return "both eyes"; }
    void make(const StereoViews& views, double time, const FrameWay&, EyePair& frame) override {
        makeOne(views.right, time, frame);
        std::swap(frame.left, frame.right);
        makeOne(views.left, time, frame);
    }
    void makeOne(const EyeView& view, double, EyePair& frame) override {
        EyeImage& eye = frame.left;
        eye.resize(view.width, view.height);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const glm::dvec3 at = view.rayDirection(x + 0.5, y + 0.5);
                eye.color.at(x, y) = packColor(glm::vec3(0.5) + 0.3f * glm::vec3(at));
                eye.viewDepth.at(x, y) = 100;
            }
    }

private:
    static constexpr std::array<std::string_view, 1> kMethods{"wall"};
};

std::shared_ptr<const ViewFrame> guardedFrame(ViewWorker& worker) {
    return test::waitFor([&] { return worker.takeFrame(); });
}

int largestChannelApart(PackedColor a, PackedColor b) {
    int most = 0;
    for (int k = 0; k < 30; k += 10)
        most = std::max(most, std::abs(static_cast<int>(a >> k & 1023u) - static_cast<int>(b >> k & 1023u)));
    return most;
}

// A frame for the late warp may be cast wider than it is shown; its figures are those of the visible part.
TEST(GuardedFrames, AreCastWiderAndShownAsAsked) {
    ViewWorker worker(
        [](Progress&) {
            FakeParts parts;
            auto frames = std::make_shared<GuardedWall>();
            parts.frames = frames.get();
            parts.owner = std::move(frames);
            return openOf(parts);
        },
        [] {});
    FrameRequest request;
    request.version = 1;
    request.pose = poseFromAngles({0, 0, 100}, 0, 0, 0);
    request.lens.width = 40;
    request.lens.height = 20;
    request.stereo = {2.0, 50.0};
    request.way.method = "wall";
    request.late = request.flying = true;
    worker.request(request);
    const auto plain = guardedFrame(worker);
    request.version = 2;
    request.guard = {5, 3};
    worker.request(request);
    const auto wide = guardedFrame(worker);
    ASSERT_TRUE(plain && wide);
    EXPECT_EQ(plain->left.width(), 40);
    for (const EyeImage* eye : {&wide->left, &wide->right}) {
        EXPECT_EQ(eye->width(), 50);
        EXPECT_EQ(eye->height(), 26);
    }
    EXPECT_EQ(wide->request.lens.width, 40);
    EXPECT_DOUBLE_EQ(wide->nearParallax, plain->nearParallax);
    EXPECT_DOUBLE_EQ(wide->farParallax, plain->farParallax);
    ASSERT_TRUE(wide->late[0].ready() && wide->late[1].ready());
    EXPECT_EQ(wide->late[1].view().width, 50);
    // The frame can not be shown as it is, and has everything that is seen from there.
    FrameRequest now = request;
    now.guard = {0, 0};
    EXPECT_FALSE(sameView(wide->request, now));
    EXPECT_TRUE(sameView(plain->request, now));
    ASSERT_TRUE(LateView::fits(*wide, now));
    EXPECT_LT(LateView::seenBeyond(*wide, now).x, 1e-5);
    LateView late;
    const auto eyes = late.warp(*wide, now);
    ASSERT_EQ((*eyes)[0].width(), 40);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 40; ++x)
            ASSERT_LE(largestChannelApart((*eyes)[1].at(x, y), plain->right.color.at(x, y)), 2);
    now.pose = poseFromAngles(now.pose.position, 0.05, 0, 0);
    EXPECT_NEAR(LateView::seenBeyond(*wide, now).x, LateView::seenBeyond(*plain, now).x, 1e-3);
}

}  // namespace
}  // namespace stereonav
