// The right eye compared with its truth: shown in its place, and measured at rest, from which a request
// interrupts the frame maker at once.
#include <gmock/gmock.h>

#include <atomic>
#include <cmath>
#include <random>

#include "app/view/frame_truth.h"
#include "app/view/status.h"
#include "app/view/worker.h"
#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/frame/cast_frames.h"
#include "engine/metrics/difference_picture.h"
#include "engine/metrics/image_difference.h"
#include "tests/support/wait_for.h"
#include "tests/view/fake_scene.h"
#include "tests/view/striped_scene.h"

namespace stereonav {
namespace {

FrameRequest requestOf(TruthView truth, std::string_view method = "linear") {
    FrameRequest request;
    request.version = 7;
    request.pose = poseFromAngles({0, 0, 0}, 0, 0, 0);
    request.lens.width = 160;
    request.lens.height = 80;
    request.stereo = {0.5, 12.0};
    request.way.method = method;
    request.truth = truth;
    return request;
}

class Looker {
public:
    explicit Looker(const FakeParts& parts) : mWorker([parts](Progress&) { return openOf(parts); }, [] {}) {}
    std::shared_ptr<const ViewFrame> frame(const FrameRequest& request) {
        mWorker.request(request);
        return next();
    }
    std::shared_ptr<const ViewFrame> next() {
        return test::waitFor([&] { return mWorker.takeFrame(); });
    }
    std::optional<FrameTruth> truth() {
        return test::waitFor([&] { return mWorker.takeTruth(); });
    }
    // Waits until the thread that makes frames has also done its own work: it was asked for something else
    // repeatedly.
    void letItTurn() {
        for (int n = 0; n < 20; ++n) {
            const auto ran = std::make_shared<std::atomic<bool>>(false);
            mWorker.ask([ran](const OpenScene&) { *ran = true; });
            ASSERT_TRUE(test::waitFor([&] { return ran->load(); }));
        }
    }
    ViewWorker& worker() { return mWorker; }

private:
    ViewWorker mWorker;
};

void expectSame(const Plane<PackedColor>& a, const Plane<PackedColor>& b, const char* what) {
    ASSERT_EQ(a.width(), b.width());
    ASSERT_EQ(a.height(), b.height());
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) ASSERT_EQ(a.at(x, y), b.at(x, y)) << what << " " << x << " " << y;
}

TEST(ViewTruth, IsShownInThePlaceOfTheRightEye) {
    StripedScene scene;
    Looker looker(scene.parts());
    const auto made = looker.frame(requestOf(TruthView::None));
    ASSERT_NE(made, nullptr);
    EXPECT_EQ(made->truthNote, "");
    EXPECT_FALSE(made->truthError);
    // The reference is another renderer, eye by eye.
    const Stripes stripes;
    const FrameRequest& request = made->request;
    const StereoViews views = makeStereoViews(request.pose, request.lens, request.stereo);
    EyeImage truth;
    truth.resize(160, 80);
    renderEye(stripes, views.right, truth);

    const auto full = looker.frame(requestOf(TruthView::FullCast));
    expectSame(full->right.color, truth.color, "full cast");
    expectSame(full->left.color, made->left.color, "left eye");
    EXPECT_EQ(full->request.way.method, "full") << "whose times are shown";
    EXPECT_EQ(full->truthNote, "");

    const auto difference = looker.frame(requestOf(TruthView::Difference));
    expectSame(difference->right.color, differenceTimes(truth.color, made->right.color, 5), "difference");
    expectSame(difference->left.color, made->left.color, "left eye");
    ASSERT_TRUE(difference->truthError);
    EXPECT_NEAR(difference->truthError->psnr_db, psnrOf(truth.color, made->right.color), 1e-9);
    EXPECT_GT(difference->truthError->largest, 0);

    const auto holes = looker.frame(requestOf(TruthView::Holes));
    RightEye eye;
    EyeImage right;
    eye.render(stripes, views, made->left, {}, right);
    const PackedColor red = packColor({linearFromSrgb(0.9f), linearFromSrgb(0.25f), linearFromSrgb(0.2f)});
    Plane<PackedColor> painted = made->right.color;
    int count = 0;
    for (int y = 0; y < 80; ++y)
        for (int x = 0; x < 160; ++x)
            if (eye.holeMask().at(x, y)) painted.at(x, y) = red, ++count;
    EXPECT_GT(count, 50);
    EXPECT_LT(count, 160 * 80 / 2);
    expectSame(holes->right.color, painted, "holes");
}

TEST(ViewTruth, SaysWhyThereIsNone) {
    StripedScene scene;
    Looker looker(scene.parts());
    for (const TruthView view : {TruthView::Difference, TruthView::Holes}) {
        const auto exact = looker.frame(requestOf(view, "full"));
        EXPECT_THAT(exact->truthNote, testing::HasSubstr("in full"));
        const auto plain = looker.frame(requestOf(TruthView::None, "full"));
        expectSame(exact->right.color, plain->right.color, "as it is");
    }
    for (const TruthView view : {TruthView::FullCast, TruthView::Difference, TruthView::Holes}) {
        FrameRequest request = requestOf(view);
        request.twoEyes = false;
        EXPECT_THAT(looker.frame(request)->truthNote, testing::HasSubstr("one eye"));
    }
}

TEST(ViewTruth, ErrorsAreThoseOfTheMetrics) {
    std::mt19937 random(5);
    std::uniform_int_distribution<std::uint32_t> any(0, 0x3fffffffu), few(0, 40);
    for (const auto& [width, height] : {std::pair{1, 1}, std::pair{37, 70}, std::pair{64, 5}}) {
        Plane<PackedColor> a(width, height), b(width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                a.at(x, y) = any(random);
                b.at(x, y) = few(random) == 0 ? any(random) : a.at(x, y);
            }
        b.at(0, 0) = a.at(0, 0) ^ 0x200;
        const PictureError error = errorOf(a, b);
        EXPECT_NEAR(error.psnr_db, psnrOf(a, b), 1e-9);
        const ImageDifference all = differenceOf(a, b, Plane<std::uint8_t>(width, height));
        EXPECT_LE(error.largest, all.rgb_max);
        EXPECT_GE(error.largest, all.rgb_max / std::sqrt(3.0) - 1e-3);
        EXPECT_GT(error.wrongShare, 0);
        Plane<PackedColor> shown = b;
        showDifference(a, shown);
        expectSame(shown, differenceTimes(a, b, kTruthTimes), "difference");
        const PictureError none = errorOf(a, a);
        EXPECT_EQ(none.psnr_db, kIdenticalPsnr_db);
        EXPECT_EQ(none.largest, 0);
        EXPECT_EQ(none.wrongShare, 0);
    }
}

TEST(ViewTruth, IsMeasuredOnceAtRest) {
    StripedScene scene;
    Looker looker(scene.parts());
    const Stopwatch watch;
    const auto frame = looker.frame(requestOf(TruthView::None));
    const auto truth = looker.truth();
    ASSERT_TRUE(truth);
    EXPECT_GE(watch.elapsed_ms(), static_cast<double>(ViewWorker::kRest.count())) << "not while one flies";
    EXPECT_EQ(truth->version, 7);
    EXPECT_EQ(truth->note, "");
    EyeImage right;
    right.resize(160, 80);
    const StereoViews views =
        makeStereoViews(frame->request.pose, frame->request.lens, frame->request.stereo);
    renderEye(*scene.stripes, views.right, right);
    EXPECT_NEAR(truth->error.psnr_db, psnrOf(right.color, frame->right.color), 1e-9);
    EXPECT_THAT(truthText(*truth), testing::HasSubstr(" of 255 at most"));
    const int tiles = scene.stripes->tiles;
    looker.letItTurn();
    EXPECT_EQ(scene.stripes->tiles, tiles) << "once";
    EXPECT_FALSE(looker.worker().takeTruth());
    // Painted holes are not part of the frame as made.
    looker.frame(requestOf(TruthView::Holes));
    const auto painted = looker.truth();
    ASSERT_TRUE(painted);
    EXPECT_EQ(painted->error.psnr_db, truth->error.psnr_db);
    // Differences are measured while they are made.
    looker.frame(requestOf(TruthView::Difference));
    const auto difference = looker.worker().takeTruth();
    ASSERT_TRUE(difference);
    EXPECT_EQ(difference->error.psnr_db, truth->error.psnr_db);
    FrameRequest exact = requestOf(TruthView::None, "full");
    looker.frame(exact);
    EXPECT_EQ(truthText(*looker.truth()), "error none");
    exact.twoEyes = false;
    looker.frame(exact);
    EXPECT_THAT(truthText(*looker.truth()), testing::HasSubstr("one eye"));
}

TEST(ViewTruth, ARequestEndsTheMeasureWithinATile) {
    constexpr int kThreads = 2;  // fewer than tiles, on every machine
    const int threads = threadCount();
    setThreadCount(kThreads);
    StripedScene scene;
    Looker looker(scene.parts());
    scene.stripes->holdRight = true;  // it is warped, except where it is measured
    ASSERT_NE(looker.frame(requestOf(TruthView::None)), nullptr);
    ASSERT_TRUE(test::waitFor([&] { return scene.stripes->ofRightEye > 0; }));
    FrameRequest next = requestOf(TruthView::None);
    next.version = 8;
    next.twoEyes = false;
    looker.worker().request(next);
    scene.stripes->holdRight = false;
    const auto frame = looker.next();
    ASSERT_NE(frame, nullptr);
    EXPECT_EQ(frame->request.version, 8);
    const auto truth = looker.truth();
    ASSERT_TRUE(truth);
    EXPECT_EQ(truth->version, 8) << "what was stopped says nothing, but the next rest does";
    EXPECT_LE(scene.stripes->ofRightEye, kThreads) << "a tile of each thread";
    setThreadCount(threads);
}

// Frames whose eyes are made together: there is no warp, but each eye can be made separately.
class Together : public FrameMaker {
public:
    std::span<const std::string_view> methods() const override { return kMethods; }
    std::string_view defaultMethod() const override { return kMethods[0]; }
    std::string_view exactMethod() const override { return kMethods[1]; }
    std::string_view whatMethodsMake() const override { return "both eyes"; }
    void make(const StereoViews& views, double, const FrameWay& way, EyePair& frame) override {
        fill(views.left, 300, frame.left);
        fill(views.right, way.method == kMethods[1] ? 400 : 390, frame.right);
        frame.timings = {};
        frame.timings.both_ms = took_ms;
    }
    void makeOne(const EyeView& view, double, EyePair& frame) override {
        if (fails) throw std::runtime_error("no more memory");
        fill(view, 400, frame.left);
        frame.right = {};
    }
    bool fails = false;
    double took_ms = 10;

private:
    static void fill(const EyeView& view, PackedColor color, EyeImage& image) {
        image.resize(view.width, view.height);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) image.color.at(x, y) = color, image.viewDepth.at(x, y) = 10;
    }
    static constexpr std::array<std::string_view, 2> kMethods{"sweep", "two-sweeps"};
};

TEST(ViewTruth, EyesThatAreSweptAreHeldAgainstTheirOwnSweep) {
    Together frames;
    FakeParts parts;
    parts.frames = &frames;
    Looker looker(parts);
    const auto full = looker.frame(requestOf(TruthView::FullCast, "sweep"));
    EXPECT_EQ(full->right.color.at(3, 3), 400u);
    EXPECT_THAT(full->truthNote, testing::HasSubstr("own sweep"));
    const auto difference = looker.frame(requestOf(TruthView::Difference, "sweep"));
    EXPECT_THAT(difference->truthNote, testing::HasSubstr("own sweep"));
    ASSERT_TRUE(difference->truthError);
    EXPECT_LT(difference->truthError->psnr_db, kIdenticalPsnr_db);
    const auto holes = looker.frame(requestOf(TruthView::Holes, "sweep"));
    EXPECT_EQ(holes->right.color.at(3, 3), 390u) << "as it is";
    EXPECT_THAT(holes->truthNote, testing::HasSubstr("no holes"));
    looker.worker().takeTruth();
    frames.fails = true;
    looker.frame(requestOf(TruthView::None, "sweep"));
    const auto failed = looker.truth();
    ASSERT_TRUE(failed);
    EXPECT_THAT(failed->note, testing::HasSubstr("no more memory")) << "and the window stays";
    EXPECT_NE(looker.frame(requestOf(TruthView::None, "sweep")), nullptr);
    // Work that can not be stopped would delay the next request.
    looker.worker().takeTruth();
    frames.took_ms = 300;
    looker.frame(requestOf(TruthView::None, "sweep"));
    const auto slow = looker.truth();
    ASSERT_TRUE(slow);
    EXPECT_THAT(slow->note, testing::HasSubstr("too long"));
}

// Eyes that have to fit are fitted before anybody sees them.
TEST(ViewTruth, TheFirstPictureComesWithEyesThatFit) {
    StripedScene scene;
    Looker looker(scene.parts());
    FrameRequest request = requestOf(TruthView::None);
    request.stereo = {2.0, 12.0};
    const auto own = looker.frame(request);
    EXPECT_EQ(comfortReading(*own).state, ComfortState::TooMuch);
    EXPECT_EQ(own->request.stereo.separation, 2.0);
    request.fitEyes = true;
    const auto fitted = looker.frame(request);
    EXPECT_EQ(comfortReading(*fitted).state, ComfortState::Comfortable);
    EXPECT_LT(fitted->request.stereo.separation, 2.0);
    EXPECT_TRUE(fitted->request.fitEyes);
    request.stereo = {0.05, 12.0};
    const auto kept = looker.frame(request);
    EXPECT_EQ(kept->request.stereo.separation, 0.05) << "what fits stays";
    EXPECT_EQ(kept->request.stereo.zeroParallax, 12.0);
    EXPECT_EQ(kept->parallax.known(), 160 * 80);
}

}  // namespace
}  // namespace stereonav
