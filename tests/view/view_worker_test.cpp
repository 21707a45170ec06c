// The thread beside the window: it never makes the window wait, takes the newest request, reports progress,
// and hands over failures.
#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <future>
#include <thread>
#include <vector>

#include "app/view/worker.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/frame/cast_frames.h"
#include "tests/support/held_memory.h"
#include "tests/support/one_method_frames.h"
#include "tests/support/wait_for.h"
#include "tests/view/fake_scene.h"
#include "tests/view/worked_scenes.h"

namespace stereonav {
namespace {

using namespace std::chrono_literals;

// A medium whose pictures take for ever from a certain number of rows on, until they are dropped.
class SlowMedium final : public test::OneMethodFrames {
public:
    explicit SlowMedium(int endless) : mEndless(endless) {}
    void makeOne(const EyeView& view, double, EyePair& frame) override {
        ++begun;
        if (view.height >= mEndless)
            parallelFor(1'000'000, [&](int) {
                ++steps;
                std::this_thread::sleep_for(1ms);
            });
        frame.left.resize(view.width, view.height);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                frame.left.color.at(x, y) = static_cast<PackedColor>(view.height);
                frame.left.viewDepth.at(x, y) = 50;
            }
    }

    std::atomic<int> begun = 0, steps = 0;  // pictures; steps of those that take for ever

private:
    int mEndless;
};

OpenScene mediumOf(std::shared_ptr<SlowMedium> frames) {
    FakeParts parts;
    parts.frames = frames.get();
    parts.owner = std::move(frames);
    parts.swept = true;
    return openOf(parts);
}

FrameRequest mediumRequest(long long version, double scale, bool flying) {
    FrameRequest request = requestAt(version, 7);
    request.way.method = "alone";
    request.whole = {40, 20};
    request.scale = scale;
    request.lens.width = static_cast<int>(std::lround(40 * scale));
    request.lens.height = static_cast<int>(std::lround(20 * scale));
    request.flying = flying;
    return request;
}

// A resting medium is shown small first, where that is asked for, and then in full.
TEST(ViewWorker, MakesAMediumInFullOnceItRests) {
    ViewWorker worker([](Progress&) { return mediumOf(std::make_shared<SlowMedium>(1000)); }, [] {});
    worker.request(mediumRequest(1, 0.5, true));
    auto frame = nextFrame(worker);
    ASSERT_NE(frame, nullptr);
    letItTurn(worker);
    EXPECT_EQ(worker.takeFrame(), nullptr) << "it moves";
    worker.request(mediumRequest(2, 0.5, false));
    ASSERT_TRUE(test::waitFor([&] {
        if (auto next = worker.takeFrame()) frame = next;
        return frame->request.version == 2 && frame->left.width() == 40;
    }));
    EXPECT_EQ(frame->request.scale, 1);
    EXPECT_EQ(frame->request.lens.height, 20);
    EXPECT_EQ(frame->right.color.at(3, 3), 20u);
    letItTurn(worker);
    EXPECT_EQ(worker.takeFrame(), nullptr) << "once";
}

// Pictures are dropped in flight, where the next large one was begun before the time of the last was known;
// and at rest, when something moves again.
TEST(ViewWorker, DropsWhatTakesTooLongOfAMedium) {
    for (const bool flying : {true, false}) {
        SCOPED_TRACE(flying);
        const auto medium = std::make_shared<SlowMedium>(20);
        ViewWorker worker([&](Progress&) { return mediumOf(medium); }, [] {});
        worker.request(mediumRequest(1, 1, flying));
        ASSERT_TRUE(test::waitFor([&] { return medium->steps > 0; }));
        if (flying) {
            worker.request(mediumRequest(2, 0.9, true));
            const int before = medium->steps;
            ASSERT_TRUE(test::waitFor([&] { return medium->steps > before + 500 || medium->begun > 1; }));
            EXPECT_EQ(medium->begun, 1) << "not for so little";
        }
        worker.request(mediumRequest(3, 0.5, true));
        const auto frame = nextFrame(worker);
        ASSERT_NE(frame, nullptr);
        EXPECT_EQ(frame->request.version, 3);
        EXPECT_EQ(frame->left.width(), 20);
    }
    // The full picture that follows a small one at rest.
    const auto medium = std::make_shared<SlowMedium>(20);
    ViewWorker worker([&](Progress&) { return mediumOf(medium); }, [] {});
    worker.request(mediumRequest(1, 0.5, false));
    ASSERT_NE(nextFrame(worker), nullptr);
    ASSERT_TRUE(test::waitFor([&] { return medium->steps > 0; }));
    EXPECT_EQ(worker.takeFrame(), nullptr);
    std::atomic<bool> ran = false;
    worker.ask([&](const OpenScene&) { ran = true; });
    EXPECT_TRUE(test::waitFor([&] { return ran.load(); })) << "what is asked for goes first";
    worker.request(mediumRequest(2, 0.5, false));
    const auto frame = nextFrame(worker);
    ASSERT_NE(frame, nullptr);
    EXPECT_EQ(frame->request.version, 2);
}

// Memory that was freed in pieces between others stays with the C library, until the window rests.
TEST(ViewWorker, GivesBackWhatIsFreeAtRest) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "the sanitizer's own memory stays";
#endif
    ViewWorker worker([](Progress&) { return sceneOf(std::make_shared<Wall>()); }, [] {});
    // Every second one of many is freed: none of them lies at the end, where memory is returned at once.
    constexpr std::size_t kBytes = 64 << 10, kPieces = 4800;
    std::vector<std::unique_ptr<char[]>> pieces(kPieces);
    for (auto& piece : pieces) {
        piece.reset(new char[kBytes]);
        std::fill_n(piece.get(), kBytes, 'a');
    }
    for (std::size_t n = 0; n < kPieces; n += 2) pieces[n].reset();  // 157 MB
    const double free = test::bytesHeld();
    worker.request(requestAt(1, 7));
    ASSERT_NE(nextFrame(worker), nullptr);
    EXPECT_TRUE(test::waitFor([&] { return test::bytesHeld() < free - 100e6; }))
        << free << " to " << test::bytesHeld();
}

// A resting picture is cast again until that changes nothing more, and only where that was asked for.
TEST(ViewWorker, RefinesWhatRests) {
    ViewWorker worker([](Progress&) { return sceneOf(std::make_shared<Wall>()); }, [] {});
    FrameRequest request = requestAt(1, 7);
    for (const bool refines : {true, false}) {
        SCOPED_TRACE(refines);
        request.refines = refines;
        ++request.version;
        worker.request(request);
        const auto drawn = nextFrame(worker);
        ASSERT_NE(drawn, nullptr);
        EXPECT_EQ(drawn->rays, 1);
        if (!refines) {
            expectNoMoreAtRest(worker, request.version);
            continue;
        }
        const auto refined = nextFrame(worker);
        ASSERT_NE(refined, nullptr);
        EXPECT_EQ(refined->rays, 8) << "a wall of one colour";
        EXPECT_GT(refined->expected_db, 60);
        EXPECT_EQ(refined->request.version, request.version);
        EXPECT_EQ(refined->left.viewDepth.at(5, 5), drawn->left.viewDepth.at(5, 5));
        for (int x = 0; x < 40; ++x) {
            ASSERT_EQ(refined->left.color.at(x, 9), 7u);
            ASSERT_EQ(refined->right.color.at(x, 9), 7u);
        }
        expectNoMoreAtRest(worker, request.version);  // that was enough
    }
    // One eye is refined, too; a picture that is made smaller, and a truth, are not.
    request.refines = true;
    for (int kind = 0; kind < 3; ++kind) {
        SCOPED_TRACE(kind);
        ++request.version;
        request.twoEyes = kind != 0;
        request.scale = kind == 1 ? 0.5 : 1;
        request.truth = kind == 2 ? TruthView::FullCast : TruthView::None;
        worker.request(request);
        ASSERT_NE(nextFrame(worker), nullptr);
        if (kind == 0)
            EXPECT_NE(nextFrame(worker), nullptr);
        else
            expectNoMoreAtRest(worker, request.version);
    }
}

TEST(ViewWorker, LoadsAndRendersBothEyes) {
    std::atomic<int> woken = 0;
    ViewWorker worker([](Progress&) { return sceneOf(std::make_shared<Wall>()); }, [&] { ++woken; });
    ASSERT_TRUE(test::waitFor([&] { return worker.scenes().newest() != nullptr; }));
    EXPECT_EQ(worker.takeFrame(), nullptr);
    worker.request(requestAt(1, 7));
    const auto frame = nextFrame(worker);
    ASSERT_NE(frame, nullptr);
    EXPECT_EQ(frame->request.version, 1);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 40; ++x) {
            ASSERT_EQ(frame->left.color.at(x, y), 7u);
            ASSERT_EQ(frame->right.color.at(x, y), 7u);
        }
    // A wall at twice the zero-parallax distance: half of the parallax at infinity, by the formula separation
    // / zero parallax / window width, the window being 2 tan(0.4) * 2 wide.
    const double expected = 2.0 / 50.0 / (4 * std::tan(0.4)) / 2;
    EXPECT_NEAR(frame->nearParallax, expected, 1e-6);
    EXPECT_NEAR(frame->farParallax, expected, 1e-6);
    EXPECT_EQ(worker.takeFrame(), nullptr) << "each frame is handed out once";
    EXPECT_TRUE(test::waitFor([&] { return woken >= 2; }));
}

TEST(ViewWorker, OneEyeNeedsNoRightOne) {
    ViewWorker worker([](Progress&) { return sceneOf(std::make_shared<Wall>()); }, [] {});
    FrameRequest request = requestAt(1, 3);
    request.twoEyes = false;
    worker.request(request);
    const auto frame = nextFrame(worker);
    ASSERT_NE(frame, nullptr);
    EXPECT_TRUE(frame->right.color.empty());
    EXPECT_EQ(frame->left.width(), 40);
}

// While a frame is held the caller does everything that it can.
TEST(ViewWorker, TheCallerNeverWaitsAndTheNewestRequestWins) {
    const auto wall = std::make_shared<Wall>();
    ViewWorker worker([&](Progress&) { return sceneOf(wall); }, [] {});
    wall->open = false;
    worker.request(requestAt(1, 1));
    ASSERT_TRUE(test::waitFor([&] { return wall->begun > 0; }));
    const std::future<void> calls = std::async(std::launch::async, [&] {
        for (int i = 2; i <= 200; ++i) {
            worker.request(requestAt(i, i));
            EXPECT_EQ(worker.takeFrame(), nullptr);
            EXPECT_NE(worker.scenes().newest(), nullptr);
            EXPECT_FALSE(worker.scenes().loading().busy);
            EXPECT_FALSE(worker.takeTruth());
        }
    });
    EXPECT_TRUE(test::waitFor([&] { return calls.wait_for(0s) == std::future_status::ready; }));
    wall->open = true;
    std::vector<long long> versions;
    std::shared_ptr<const ViewFrame> frame;
    EXPECT_TRUE(test::waitFor([&] {
        if (auto next = worker.takeFrame()) {
            frame = next;
            versions.push_back(frame->request.version);
        }
        return frame && frame->request.version == 200;
    }));
    ASSERT_NE(frame, nullptr);
    EXPECT_EQ(frame->left.color.at(0, 0), 200u);
    letItTurn(worker);
    EXPECT_EQ(worker.takeFrame(), nullptr);
    // The first may have been replaced by the last before it was taken.
    EXPECT_THAT(versions, testing::AnyOf(testing::ElementsAre(1, 200), testing::ElementsAre(200)));
    EXPECT_EQ(wall->begun, 4) << "two eyes of two frames: requests in between are left out";
}

// Light that changes meanwhile: the frame is drawn again without a request, until nothing changes.
TEST(ViewWorker, DrawsAgainWhenTheLightHasChanged) {
    std::atomic<std::uint64_t> changes{0};
    std::atomic<int> seen{0}, looks{0};
    ViewWorker worker(
        [&](Progress&) {
            FakeParts scene = partsOf(std::make_shared<Wall>());
            scene.seen = [&](const EyeView& view, const EyeImage& image) {
                EXPECT_EQ(image.width(), view.width);
                if (++seen < 4) ++changes;
            };
            scene.lightChanges = [&] {
                ++looks;
                return changes.load();
            };
            return openOf(scene);
        },
        [] {});
    worker.request(requestAt(1, 7));
    EXPECT_TRUE(test::waitFor([&] { return seen == 4; }));
    const int before = looks;
    ASSERT_TRUE(test::waitFor([&] { return looks >= before + 4; })) << "it is looked for changes on and on";
    EXPECT_EQ(seen, 4) << "nothing has changed since";
}

TEST(ViewWorker, FramesThatAreHeldStayAsTheyAre) {
    ViewWorker worker([](Progress&) { return sceneOf(std::make_shared<Wall>()); }, [] {});
    std::vector<std::shared_ptr<const ViewFrame>> held;
    for (int i = 1; i <= 6; ++i) {
        worker.request(requestAt(i, 10 * i));
        held.push_back(nextFrame(worker));
        ASSERT_NE(held.back(), nullptr);
    }
    for (int i = 1; i <= 6; ++i)
        EXPECT_EQ(held[static_cast<std::size_t>(i) - 1]->left.color.at(5, 5), 10u * i);
}

}  // namespace
}  // namespace stereonav
