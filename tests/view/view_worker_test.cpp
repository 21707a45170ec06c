// The thread beside the window: it never makes the window wait, takes the newest request, reports
// progress, and hands over what went wrong.
#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "app/view/worker.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/frame/cast_frames.h"
#include "tests/view/fake_scene.h"
#include "tests/support/one_method_frames.h"

namespace stereonav {
namespace {

using namespace std::chrono_literals;

// A wall at one view depth, whose colour is the whole metres of the eye's height; as slow as wished.
class Wall : public EyeRenderer {
public:
    explicit Wall(std::chrono::milliseconds pause = 0ms) : mPause(pause) {}
    int tileCount(const EyeView&) const override { return 1; }
    void renderTile(const EyeView& view, int, EyeImage& image) const override {
        std::this_thread::sleep_for(mPause);
        for (int y = 0; y < view.height; ++y) paint(view, y, 0, view.width, image);
    }
    void renderPixels(const EyeView& view, PixelRect, std::span<const PixelIndex> pixels,
                      EyeImage& image) const override {
        for (const PixelIndex& p : pixels) paint(view, p.y, p.x, p.x + 1, image);
    }
    bool mayHitBeyondEdge(const EyeView&, PixelRect, double, double) const override { return false; }

    static constexpr float kDepth = 100.0f;

private:
    static void paint(const EyeView& view, int y, int x0, int x1, EyeImage& image) {
        for (int x = x0; x < x1; ++x) {
            image.color.at(x, y) = static_cast<PackedColor>(view.eye.z);
            image.viewDepth.at(x, y) = kDepth;
        }
    }
    std::chrono::milliseconds mPause;
};

FakeParts partsOf(std::shared_ptr<Wall> wall) {
    FakeParts scene;
    struct Cast {
        std::shared_ptr<Wall> wall;
        CastFrames frames;
    };
    CastFrames frames(*wall);
    auto cast = std::make_shared<Cast>(Cast{std::move(wall), std::move(frames)});
    scene.frames = &cast->frames;
    scene.owner = std::move(cast);
    return scene;
}

OpenScene sceneOf(std::shared_ptr<Wall> wall, const std::string& name = "") {
    FakeParts parts = partsOf(std::move(wall));
    parts.name = name;
    return openOf(parts);
}

FrameRequest requestAt(long long version, double height) {
    FrameRequest request;
    request.version = version;
    request.pose.position = {0, 0, height};
    request.pose = poseFromAngles(request.pose.position, 0, 0, 0);
    request.lens.width = 40;
    request.lens.height = 20;
    request.stereo = {2.0, 50.0};
    request.way.method = "full";
    return request;
}

template <typename Condition>
bool within(std::chrono::milliseconds limit, const Condition& condition) {
    const Stopwatch watch;
    while (!condition()) {
        if (watch.elapsed_ms() > static_cast<double>(limit.count())) return false;
        std::this_thread::sleep_for(1ms);
    }
    return true;
}

std::shared_ptr<const ViewFrame> nextFrame(ViewWorker& worker) {
    std::shared_ptr<const ViewFrame> frame;
    within(10s, [&] { return (frame = worker.takeFrame()) != nullptr; });
    return frame;
}

// Pictures of so many rows and more take for ever, until they are dropped.
class SlowMedium final : public test::OneMethodFrames {
public:
    explicit SlowMedium(int endless) : mEndless(endless) {}
    void makeOne(const EyeView& view, double, EyePair& frame) override {
        if (view.height >= mEndless) parallelFor(1'000'000, [](int) { std::this_thread::sleep_for(1ms); });
        frame.left.resize(view.width, view.height);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                frame.left.color.at(x, y) = static_cast<PackedColor>(view.height);
                frame.left.viewDepth.at(x, y) = 50;
            }
    }

private:
    int mEndless;
};

OpenScene mediumOf(int endless) {
    FakeParts parts;
    auto frames = std::make_shared<SlowMedium>(endless);
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

// A medium that rests is shown small first, where that is asked for, and then in full.
TEST(ViewWorker, MakesAMediumInFullOnceItRests) {
    ViewWorker worker([](Progress&) { return mediumOf(1000); }, [] {});
    worker.request(mediumRequest(1, 0.5, true));
    auto frame = nextFrame(worker);
    ASSERT_NE(frame, nullptr);
    EXPECT_FALSE(within(200ms, [&] { return worker.takeFrame() != nullptr; })) << "it moves";
    worker.request(mediumRequest(2, 0.5, false));
    ASSERT_TRUE(within(10s, [&] {
        if (auto next = worker.takeFrame()) frame = next;
        return frame->request.version == 2 && frame->left.width() == 40;
    }));
    EXPECT_EQ(frame->request.scale, 1);
    EXPECT_EQ(frame->request.lens.height, 20);
    EXPECT_EQ(frame->right.color.at(3, 3), 20u);
    EXPECT_FALSE(within(200ms, [&] { return worker.takeFrame() != nullptr; })) << "once";
}

// In flight, where the next large one was begun before anybody knew how long they take; and at rest, when
// something moves again.
TEST(ViewWorker, DropsWhatTakesTooLongOfAMedium) {
    for (const bool flying : {true, false}) {
        SCOPED_TRACE(flying);
        ViewWorker worker([](Progress&) { return mediumOf(20); }, [] {});
        worker.request(mediumRequest(1, 1, flying));
        EXPECT_FALSE(within(100ms, [&] { return worker.takeFrame() != nullptr; }));
        if (flying) worker.request(mediumRequest(2, 0.9, true));  // not for so little
        worker.request(mediumRequest(3, 0.5, true));
        const auto frame = nextFrame(worker);
        ASSERT_NE(frame, nullptr);
        EXPECT_EQ(frame->request.version, 3);
        EXPECT_EQ(frame->left.width(), 20);
    }
    // The full one that follows a small one at rest.
    ViewWorker worker([](Progress&) { return mediumOf(20); }, [] {});
    worker.request(mediumRequest(1, 0.5, false));
    ASSERT_NE(nextFrame(worker), nullptr);
    EXPECT_FALSE(within(100ms, [&] { return worker.takeFrame() != nullptr; }));
    std::atomic<bool> ran = false;
    worker.ask([&](const OpenScene&) { ran = true; });
    EXPECT_TRUE(within(10s, [&] { return ran.load(); })) << "what is asked for goes first";
    worker.request(mediumRequest(2, 0.5, false));
    const auto frame = nextFrame(worker);
    ASSERT_NE(frame, nullptr);
    EXPECT_EQ(frame->request.version, 2);
}

// A picture that rests is cast again until that changes nothing more, and only where that was asked for.
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
        std::shared_ptr<const ViewFrame> refined;
        within(refines ? 10s : 600ms, [&] { return (refined = worker.takeFrame()) != nullptr; });
        ASSERT_EQ(refined != nullptr, refines);
        if (!refines) continue;
        EXPECT_EQ(refined->rays, 8) << "a wall of one colour";
        EXPECT_GT(refined->expected_db, 60);
        EXPECT_EQ(refined->request.version, request.version);
        EXPECT_EQ(refined->left.viewDepth.at(5, 5), drawn->left.viewDepth.at(5, 5));
        for (int x = 0; x < 40; ++x) {
            ASSERT_EQ(refined->left.color.at(x, 9), 7u);
            ASSERT_EQ(refined->right.color.at(x, 9), 7u);
        }
        EXPECT_FALSE(within(500ms, [&] { return worker.takeFrame() != nullptr; })) << "that was enough";
    }
    // Of one eye too; not of a picture that is made smaller, and not of a truth.
    request.refines = true;
    for (int kind = 0; kind < 3; ++kind) {
        SCOPED_TRACE(kind);
        ++request.version;
        request.twoEyes = kind != 0;
        request.scale = kind == 1 ? 0.5 : 1;
        request.truth = kind == 2 ? TruthView::FullCast : TruthView::None;
        worker.request(request);
        ASSERT_NE(nextFrame(worker), nullptr);
        std::shared_ptr<const ViewFrame> refined;
        within(kind == 0 ? 10s : 600ms, [&] { return (refined = worker.takeFrame()) != nullptr; });
        EXPECT_EQ(refined != nullptr, kind == 0);
    }
}

TEST(ViewWorker, LoadsAndRendersBothEyes) {
    std::atomic<int> woken = 0;
    ViewWorker worker([](Progress&) { return sceneOf(std::make_shared<Wall>()); }, [&] { ++woken; });
    ASSERT_TRUE(within(10s, [&] { return worker.scene() != nullptr; }));
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
    // A wall at twice the zero-parallax distance: half of the parallax at infinity, by the formula
    // separation / zero parallax / window width, the window being 2 tan(0.4) * 2 wide.
    const double expected = 2.0 / 50.0 / (4 * std::tan(0.4)) / 2;
    EXPECT_NEAR(frame->nearParallax, expected, 1e-6);
    EXPECT_NEAR(frame->farParallax, expected, 1e-6);
    EXPECT_EQ(worker.takeFrame(), nullptr) << "each frame is handed out once";
    EXPECT_TRUE(within(10s, [&] { return woken >= 2; }));
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

TEST(ViewWorker, TheCallerNeverWaitsAndTheNewestRequestWins) {
    ViewWorker worker([](Progress&) { return sceneOf(std::make_shared<Wall>(50ms)); }, [] {});
    ASSERT_TRUE(within(10s, [&] { return worker.scene() != nullptr; }));
    double longest = 0;
    for (int i = 1; i <= 200; ++i) {
        const Stopwatch watch;
        worker.request(requestAt(i, i));
        worker.takeFrame();
        longest = std::max(longest, watch.elapsed_ms());
        std::this_thread::sleep_for(1ms);
    }
    EXPECT_LT(longest, 40.0) << "less than the 100 ms of a frame of two eyes";
    int frames = 0;
    std::shared_ptr<const ViewFrame> frame;
    ASSERT_TRUE(within(10s, [&] {
        if (auto next = worker.takeFrame()) {
            frame = next;
            ++frames;
        }
        return frame && frame->request.version == 200;
    }));
    EXPECT_EQ(frame->left.color.at(0, 0), 200u);
    EXPECT_LE(frames, 3) << "requests in between are left out";
}

// Light that is worked out meanwhile: the frame is drawn again without being asked for, until nothing
// changes.
TEST(ViewWorker, DrawsAgainWhenTheLightHasChanged) {
    std::atomic<std::uint64_t> changes{0};
    std::atomic<int> seen{0};
    ViewWorker worker(
        [&](Progress&) {
            FakeParts scene = partsOf(std::make_shared<Wall>());
            scene.seen = [&](const EyeView& view, const EyeImage& image) {
                EXPECT_EQ(image.width(), view.width);
                if (++seen < 4) ++changes;
            };
            scene.lightChanges = [&] { return changes.load(); };
            return openOf(scene);
        },
        [] {});
    worker.request(requestAt(1, 7));
    EXPECT_TRUE(within(10s, [&] { return seen == 4; }));
    std::this_thread::sleep_for(400ms);
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

TEST(ViewWorker, ReportsProgressAndStopsLoadingWhenClosed) {
    std::atomic<bool> cancelled = false;
    const Stopwatch watch;
    {
        ViewWorker worker(
            [&](Progress& progress) -> OpenScene {
                try {
                    for (int i = 0; i < 10000; ++i) {
                        progress.report(0.25, "reading");
                        std::this_thread::sleep_for(1ms);
                    }
                } catch (const Cancelled&) {
                    cancelled = true;
                    throw;
                }
                return {};
            },
            [] {});
        ASSERT_TRUE(within(5s, [&] { return worker.loading().what == "reading"; }));
        EXPECT_EQ(worker.loading().fraction, 0.25);
        EXPECT_EQ(worker.scene(), nullptr);
    }
    EXPECT_TRUE(cancelled);
    EXPECT_LT(watch.elapsed_ms(), 5000.0);
}

TEST(ViewWorker, WhatLoadingThrowsArrivesAtTheWindow) {
    ViewWorker worker([](Progress&) -> OpenScene { throw Error("a.tif", "", "is cut off", "copy it again"); },
                      [] {});
    std::string message;
    ASSERT_TRUE(within(10s, [&] {
        try {
            worker.scene();
            return false;
        } catch (const Error& error) {
            message = error.what();
            return true;
        }
    }));
    EXPECT_EQ(message, "a.tif: is cut off; copy it again");
    EXPECT_THROW(worker.takeFrame(), Error);
}

TEST(ViewWorker, WhatRenderingThrowsArrivesAtTheWindow) {
    ViewWorker worker([](Progress&) { return sceneOf(std::make_shared<Wall>()); }, [] {});
    FrameRequest request = requestAt(1, 1);
    request.stereo.zeroParallax = -1;
    worker.request(request);
    EXPECT_TRUE(within(10s, [&] {
        try {
            worker.takeFrame();
            return false;
        } catch (const Error&) {
            return true;
        }
    }));
}

TEST(ViewWorker, AnotherSceneTakesThePlaceWhileFramesGoOn) {
    std::atomic<bool> go = false;
    ViewWorker worker([](Progress&) { return sceneOf(std::make_shared<Wall>()); }, [] {});
    ASSERT_TRUE(within(10s, [&] { return worker.scene() != nullptr; }));
    ASSERT_TRUE(within(10s, [&] { return !worker.loading().busy; }));
    const auto first = worker.scene();
    worker.reload([&](Progress& progress) {
        while (!go) {
            progress.report(0.5, "again");
            std::this_thread::sleep_for(1ms);
        }
        return sceneOf(std::make_shared<Wall>());
    });
    ASSERT_TRUE(within(10s, [&] { return worker.loading().what == "again"; }));
    EXPECT_TRUE(worker.loading().busy);
    for (int i = 1; i <= 5; ++i) {
        worker.request(requestAt(i, i));
        const auto frame = nextFrame(worker);
        ASSERT_NE(frame, nullptr) << "frames do not wait for the other scene";
        EXPECT_EQ(frame->left.color.at(0, 0), static_cast<PackedColor>(i));
    }
    EXPECT_EQ(worker.scene(), first);
    go = true;
    EXPECT_TRUE(within(10s, [&] { return worker.scene() != first; }));
    EXPECT_TRUE(within(10s, [&] { return !worker.loading().busy; }));
    EXPECT_EQ(worker.takeReloadProblem(), "");
}

TEST(ViewWorker, TheNewestReloadReplacesOneThatIsNotDone) {
    ViewWorker worker([](Progress&) { return sceneOf(std::make_shared<Wall>()); }, [] {});
    ASSERT_TRUE(within(10s, [&] { return worker.scene() != nullptr; }));
    std::atomic<bool> cancelled = false;
    worker.reload([&](Progress& progress) -> OpenScene {
        try {
            while (true) {
                progress.report(0.1, "slow");
                std::this_thread::sleep_for(1ms);
            }
        } catch (const Cancelled&) {
            cancelled = true;
            throw;
        }
    });
    ASSERT_TRUE(within(10s, [&] { return worker.loading().what == "slow"; }));
    worker.reload([](Progress&) { return sceneOf(std::make_shared<Wall>(), "seven"); });
    EXPECT_TRUE(within(10s, [&] { return worker.scene()->scene->name == "seven"; }));
    EXPECT_TRUE(cancelled);
    EXPECT_EQ(worker.takeReloadProblem(), "");
}

// Of wishes that come while one is at work the last is done after it, from the scene that it made.
TEST(ViewWorker, ChangesAreMadeFromTheNewestSceneOneAfterAnother) {
    std::atomic<int> begun = 0, go = 0;
    ViewWorker worker([](Progress&) { return sceneOf(std::make_shared<Wall>(), "first"); }, [] {});
    ASSERT_TRUE(within(10s, [&] { return worker.scene() != nullptr; }));
    const auto wish = [&](const std::string& name, int mayGo) {
        worker.change([&, name, mayGo](const OpenScene& now, Progress& progress) {
            ++begun;
            while (go < mayGo) {
                progress.report(0.5, name);
                std::this_thread::sleep_for(1ms);
            }
            return sceneOf(std::make_shared<Wall>(), now.scene->name + " " + name);
        });
    };
    wish("a", 1);
    ASSERT_TRUE(within(10s, [&] { return begun == 1; }));
    EXPECT_TRUE(worker.loading().busy);
    wish("b", 1);
    wish("c", 2);
    go = 1;
    ASSERT_TRUE(within(10s, [&] { return begun == 2; })) << "what is at work is not given up";
    EXPECT_EQ(worker.scene()->scene->name, "first a");
    go = 2;
    ASSERT_TRUE(within(10s, [&] { return worker.scene()->scene->name == "first a c"; }));
    EXPECT_TRUE(within(10s, [&] { return !worker.loading().busy; }));
    EXPECT_EQ(begun, 2) << "one that was not begun is passed over";
    // Loading again does away with what was asked for before it.
    go = 0;
    wish("d", 3);
    ASSERT_TRUE(within(10s, [&] { return begun == 3; }));
    wish("e", 3);
    worker.reload([](Progress&) { return sceneOf(std::make_shared<Wall>(), "again"); });
    ASSERT_TRUE(within(10s, [&] { return worker.scene()->scene->name == "again"; }));
    EXPECT_TRUE(within(10s, [&] { return !worker.loading().busy; }));
    EXPECT_EQ(begun, 3);
    EXPECT_EQ(worker.takeReloadProblem(), "");
}

TEST(ViewWorker, AReloadThatFailsLeavesTheSceneAndSaysSoOnce) {
    ViewWorker worker([](Progress&) { return sceneOf(std::make_shared<Wall>()); }, [] {});
    ASSERT_TRUE(within(10s, [&] { return worker.scene() != nullptr; }));
    const auto first = worker.scene();
    worker.reload([](Progress&) -> OpenScene { throw Error("--seed", "", "hits nothing", "click in air"); });
    std::string problem;
    ASSERT_TRUE(within(10s, [&] { return !(problem = worker.takeReloadProblem()).empty(); }));
    EXPECT_EQ(problem, "--seed: hits nothing; click in air");
    EXPECT_EQ(worker.takeReloadProblem(), "");
    EXPECT_EQ(worker.scene(), first);
    worker.request(requestAt(1, 4));
    EXPECT_NE(nextFrame(worker), nullptr) << "it is still drawn";
}

}  // namespace
}  // namespace stereonav
