// Frames are reused, and so are the makers of truths and of late pictures: whatever kind of picture was asked
// for before, the next one has nothing of it, and equals that of a worker that made no other.
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/view/late_view.h"
#include "app/view/worker.h"
#include "tests/support/gate.h"
#include "tests/view/striped_scene.h"

namespace stereonav {
namespace {

FrameRequest plainRequest() {
    FrameRequest request;
    request.pose = poseFromAngles({0, 0, 0}, 0, 0, 0);
    request.lens.width = 96;
    request.lens.height = 48;
    request.stereo = {0.5, 12.0};
    request.way.method = "linear";
    return request;
}

struct Kind {
    const char* name;
    FrameRequest request;
};

std::vector<Kind> kindsOfPictures() {
    std::vector<Kind> kinds;
    const auto kind = [&](const char* name, const auto& change) {
        kinds.push_back({name, plainRequest()});
        change(kinds.back().request);
    };
    kind("both eyes", [](FrameRequest&) {});
    kind("one eye", [](FrameRequest& r) { r.twoEyes = false; });
    kind("full cast", [](FrameRequest& r) { r.truth = TruthView::FullCast; });
    kind("difference", [](FrameRequest& r) { r.truth = TruthView::Difference; });
    kind("holes", [](FrameRequest& r) { r.truth = TruthView::Holes; });
    kind("difference of one eye", [](FrameRequest& r) {
        r.truth = TruthView::Difference;
        r.twoEyes = false;
    });
    kind("of late", [](FrameRequest& r) { r.late = true; });
    kind("of late, one eye", [](FrameRequest& r) { r.late = true, r.twoEyes = false; });
    kind("wider", [](FrameRequest& r) { r.late = true, r.guard = {6, 3}; });
    kind("smaller", [](FrameRequest& r) { r.lens.width = 48, r.lens.height = 24, r.scale = 0.5; });
    kind("fitted", [](FrameRequest& r) { r.fitEyes = true; });
    kind("from elsewhere", [](FrameRequest& r) { r.pose = poseFromAngles({0.7, 1, 0.2}, 0.2, 0.1, 0); });
    kind("another method", [](FrameRequest& r) { r.way.method = "full"; });
    return kinds;
}

class Looked {
public:
    explicit Looked(const FakeParts& parts) : mWorker([parts](Progress&) { return openOf(parts); }, [] {}) {}
    std::shared_ptr<const ViewFrame> frame(FrameRequest request) {
        request.version = ++mVersion;
        mWorker.request(request);
        std::shared_ptr<const ViewFrame> frame;
        EXPECT_TRUE(test::waitFor([&] { return (frame = mWorker.takeFrame()) != nullptr; }));
        return frame;
    }
    // Runs until each frame of the pool has been one of those.
    void use(const FrameRequest& request) {
        std::vector<std::shared_ptr<const ViewFrame>> held;
        for (int n = 0; n < 2; ++n) held.push_back(frame(request));
    }
    ViewWorker& worker() { return mWorker; }

private:
    long long mVersion = 0;
    ViewWorker mWorker;
};

void expectSamePlane(const Plane<PackedColor>& a, const Plane<PackedColor>& b) {
    ASSERT_EQ(a.width(), b.width());
    ASSERT_EQ(a.height(), b.height());
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) ASSERT_EQ(a.at(x, y), b.at(x, y)) << x << " " << y;
}

void expectSameFrame(const ViewFrame& a, const ViewFrame& b) {
    expectSamePlane(a.left.color, b.left.color);
    expectSamePlane(a.right.color, b.right.color);
    EXPECT_EQ(a.left.viewDepth.at(3, 3), b.left.viewDepth.at(3, 3));
    EXPECT_EQ(a.request.way.method, b.request.way.method);
    EXPECT_EQ(a.request.stereo.separation, b.request.stereo.separation);
    EXPECT_EQ(a.nearParallax, b.nearParallax);
    EXPECT_EQ(a.farParallax, b.farParallax);
    EXPECT_EQ(a.parallax.counts, b.parallax.counts);
    EXPECT_EQ(a.parallax.unknown, b.parallax.unknown);
    EXPECT_EQ(a.depthAhead, b.depthAhead);
    EXPECT_EQ(a.truthNote, b.truthNote);
    ASSERT_EQ(a.truthError.has_value(), b.truthError.has_value());
    if (a.truthError) {
        EXPECT_EQ(a.truthError->psnr_db, b.truthError->psnr_db);
    }
    EXPECT_EQ(a.rays, b.rays);
    EXPECT_EQ(a.effort, b.effort);
    EXPECT_EQ(a.expected_db, b.expected_db);
    EXPECT_EQ(a.lacksDetail, b.lacksDetail);
    EXPECT_EQ(a.sweep, b.sweep);
    for (const std::size_t eye : {0u, 1u}) EXPECT_EQ(a.late[eye].ready(), b.late[eye].ready()) << eye;
}

TEST(FrameReuse, APictureHasNothingOfTheOneBefore) {
    const StripedScene scene;
    const std::vector<Kind> kinds = kindsOfPictures();
    std::vector<std::shared_ptr<const ViewFrame>> alone;
    for (const Kind& kind : kinds) {
        const StripedScene fresh;
        alone.push_back(Looked(fresh.parts()).frame(kind.request));
    }
    Looked looked(scene.parts());
    for (std::size_t before = 0; before < kinds.size(); ++before)
        for (std::size_t n = 0; n < kinds.size(); ++n) {
            SCOPED_TRACE(std::string(kinds[n].name) + " after " + kinds[before].name);
            looked.use(kinds[before].request);
            expectSameFrame(*looked.frame(kinds[n].request), *alone[n]);
            if (testing::Test::HasFatalFailure()) return;
        }
}

// The late warp uses the depths of the frame that it warps.
TEST(FrameReuse, ALateWarpIsOfTheFrameThatIsShown) {
    const StripedScene scene;
    Looked looked(scene.parts());
    FrameRequest late = plainRequest(), other = late;
    late.late = other.late = true;
    other.pose = poseFromAngles({3, 1, 0}, 0.3, 0, 0);
    const auto first = looked.frame(late);
    LateView view, fresh;
    FrameRequest now = late;
    now.pose = poseFromAngles({0.1, 0, 0}, 0, 0, 0);
    ASSERT_TRUE(LateView::fits(*first, now));
    const auto wanted = view.warp(*first, now);
    const Plane<PackedColor> left = (*wanted)[0], right = (*wanted)[1];
    looked.use(other);
    const auto elsewhere = looked.frame(other);
    EXPECT_NE((*view.warp(*elsewhere, now))[0].at(20, 20), 0u);
    const auto again = looked.frame(late);
    const auto warped = fresh.warp(*again, now);
    expectSamePlane((*warped)[0], left);
    expectSamePlane((*warped)[1], right);
    // A picture that is still shown is not overwritten.
    const auto held = fresh.warp(*again, now);
    fresh.warp(*elsewhere, now);
    expectSamePlane((*held)[0], left);
    // No frame fits where its eyes, or its truth, are not those that are asked for.
    now.twoEyes = false;
    EXPECT_FALSE(LateView::fits(*again, now));
    now.twoEyes = true;
    now.truth = TruthView::Holes;
    EXPECT_FALSE(LateView::fits(*again, now));
    EXPECT_FALSE(LateView::fits(*looked.frame(plainRequest()), late)) << "nobody asked for that";
}

// A measurement belongs to the frame of its number: after a new request an earlier one is not reported.
TEST(FrameReuse, ATruthIsOfTheNewestFrame) {
    const StripedScene scene;
    Looked looked(scene.parts());
    std::optional<FrameTruth> alone;
    for (const double x : {0.0, 3.0, 0.0}) {
        FrameRequest request = plainRequest();
        request.pose = poseFromAngles({x, 0, 0}, 0, 0, 0);
        const auto frame = looked.frame(request);
        std::optional<FrameTruth> truth;
        ASSERT_TRUE(test::waitFor([&] {
            truth = looked.worker().takeTruth();
            return truth && truth->version == frame->request.version;
        }));
        if (x == 0 && alone) {
            EXPECT_EQ(truth->error.psnr_db, alone->error.psnr_db) << "there and back";
        }
        if (x == 0) alone = truth;
    }
}

}  // namespace
}  // namespace stereonav
