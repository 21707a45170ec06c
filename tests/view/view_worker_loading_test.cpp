// The thread beside the window loads scenes and changes them: the newest wish wins, the shown scene goes on
// meanwhile, and failures are handed over.
#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <future>
#include <thread>
#include <vector>

#include "app/view/worker.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/frame/cast_frames.h"
#include "tests/support/wait_for.h"
#include "tests/view/worked_scenes.h"

namespace stereonav {
namespace {

TEST(ViewWorkerLoading, ReportsProgressAndStopsLoadingWhenClosed) {
    std::atomic<bool> cancelled = false;
    {
        ViewWorker worker(
            [&](Progress& progress) -> OpenScene {
                try {
                    test::waitFor([&] { return progress.report(0.25, "reading"), false; });
                } catch (const Cancelled&) {
                    cancelled = true;
                    throw;
                }
                return {};
            },
            [] {});
        ASSERT_TRUE(test::waitFor([&] { return worker.scenes().loading().what == "reading"; }));
        EXPECT_EQ(worker.scenes().loading().fraction, 0.25);
        EXPECT_EQ(worker.scenes().newest(), nullptr);
    }
    EXPECT_TRUE(cancelled);
}

TEST(ViewWorkerLoading, WhatLoadingThrowsArrivesAtTheWindow) {
    ViewWorker worker([](Progress&) -> OpenScene { throw Error("a.tif", "", "is cut off", "copy it again"); },
                      [] {});
    std::string message;
    ASSERT_TRUE(test::waitFor([&] {
        try {
            worker.scenes().newest();
            return false;
        } catch (const Error& error) {
            message = error.what();
            return true;
        }
    }));
    EXPECT_EQ(message, "a.tif: is cut off; copy it again");
}

TEST(ViewWorkerLoading, WhatRenderingThrowsArrivesAtTheWindow) {
    ViewWorker worker([](Progress&) { return sceneOf(std::make_shared<Wall>()); }, [] {});
    FrameRequest request = requestAt(1, 1);
    request.stereo.zeroParallax = -1;
    worker.request(request);
    EXPECT_TRUE(test::waitFor([&] {
        try {
            worker.takeFrame();
            return false;
        } catch (const Error&) {
            return true;
        }
    }));
}

TEST(ViewWorkerLoading, AnotherSceneTakesThePlaceWhileFramesGoOn) {
    std::atomic<bool> go = false;
    ViewWorker worker([](Progress&) { return sceneOf(std::make_shared<Wall>()); }, [] {});
    ASSERT_TRUE(test::waitFor([&] { return worker.scenes().newest() != nullptr; }));
    ASSERT_TRUE(test::waitFor([&] { return !worker.scenes().loading().busy; }));
    const auto first = worker.scenes().newest();
    worker.scenes().reload([&](Progress& progress) {
        test::waitFor([&] { return progress.report(0.5, "again"), go.load(); });
        return sceneOf(std::make_shared<Wall>());
    });
    ASSERT_TRUE(test::waitFor([&] { return worker.scenes().loading().what == "again"; }));
    EXPECT_TRUE(worker.scenes().loading().busy);
    for (int i = 1; i <= 5; ++i) {
        worker.request(requestAt(i, i));
        const auto frame = nextFrame(worker);
        ASSERT_NE(frame, nullptr) << "frames do not wait for the other scene";
        EXPECT_EQ(frame->left.color.at(0, 0), static_cast<PackedColor>(i));
    }
    EXPECT_EQ(worker.scenes().newest(), first);
    go = true;
    EXPECT_TRUE(test::waitFor([&] { return worker.scenes().newest() != first; }));
    EXPECT_TRUE(test::waitFor([&] { return !worker.scenes().loading().busy; }));
    EXPECT_EQ(worker.scenes().takeProblem(), "");
}

TEST(ViewWorkerLoading, TheNewestReloadReplacesOneThatIsNotDone) {
    ViewWorker worker([](Progress&) { return sceneOf(std::make_shared<Wall>()); }, [] {});
    ASSERT_TRUE(test::waitFor([&] { return worker.scenes().newest() != nullptr; }));
    std::atomic<bool> cancelled = false;
    worker.scenes().reload([&](Progress& progress) -> OpenScene {
        try {
            test::waitFor([&] { return progress.report(0.1, "slow"), false; });
        } catch (const Cancelled&) {
            cancelled = true;
            throw;
        }
        return {};
    });
    ASSERT_TRUE(test::waitFor([&] { return worker.scenes().loading().what == "slow"; }));
    worker.scenes().reload([](Progress&) { return sceneOf(std::make_shared<Wall>(), "seven"); });
    EXPECT_TRUE(test::waitFor([&] { return worker.scenes().newest()->scene->name == "seven"; }));
    EXPECT_TRUE(cancelled);
    EXPECT_EQ(worker.scenes().takeProblem(), "");
}

// The last of the wishes that come during a change is done after it, from the scene that it made.
TEST(ViewWorkerLoading, ChangesAreMadeFromTheNewestSceneOneAfterAnother) {
    std::atomic<int> begun = 0, go = 0;
    ViewWorker worker([](Progress&) { return sceneOf(std::make_shared<Wall>(), "first"); }, [] {});
    ASSERT_TRUE(test::waitFor([&] { return worker.scenes().newest() != nullptr; }));
    const auto wish = [&](const std::string& name, int mayGo) {
        worker.scenes().change([&, name, mayGo](const OpenScene& now, Progress& progress) {
            ++begun;
            test::waitFor([&] { return progress.report(0.5, name), go >= mayGo; });
            return sceneOf(std::make_shared<Wall>(), now.scene->name + " " + name);
        });
    };
    wish("a", 1);
    ASSERT_TRUE(test::waitFor([&] { return begun == 1; }));
    EXPECT_TRUE(worker.scenes().loading().busy);
    wish("b", 1);
    wish("c", 2);
    go = 1;
    ASSERT_TRUE(test::waitFor([&] { return begun == 2; })) << "what is at work is not given up";
    EXPECT_EQ(worker.scenes().newest()->scene->name, "first a");
    go = 2;
    ASSERT_TRUE(test::waitFor([&] { return worker.scenes().newest()->scene->name == "first a c"; }));
    EXPECT_TRUE(test::waitFor([&] { return !worker.scenes().loading().busy; }));
    EXPECT_EQ(begun, 2) << "one that was not begun is passed over";
    // Loading again drops earlier wishes.
    go = 0;
    wish("d", 3);
    ASSERT_TRUE(test::waitFor([&] { return begun == 3; }));
    wish("e", 3);
    worker.scenes().reload([](Progress&) { return sceneOf(std::make_shared<Wall>(), "again"); });
    ASSERT_TRUE(test::waitFor([&] { return worker.scenes().newest()->scene->name == "again"; }));
    EXPECT_TRUE(test::waitFor([&] { return !worker.scenes().loading().busy; }));
    EXPECT_EQ(begun, 3);
    EXPECT_EQ(worker.scenes().takeProblem(), "");
}

TEST(ViewWorkerLoading, AReloadThatFailsLeavesTheSceneAndSaysSoOnce) {
    ViewWorker worker([](Progress&) { return sceneOf(std::make_shared<Wall>()); }, [] {});
    ASSERT_TRUE(test::waitFor([&] { return worker.scenes().newest() != nullptr; }));
    const auto first = worker.scenes().newest();
    worker.scenes().reload(
        [](Progress&) -> OpenScene { throw Error("--seed", "", "hits nothing", "click in air"); });
    std::string problem;
    ASSERT_TRUE(test::waitFor([&] { return !(problem = worker.scenes().takeProblem()).empty(); }));
    EXPECT_EQ(problem, "--seed: hits nothing; click in air");
    EXPECT_EQ(worker.scenes().takeProblem(), "");
    EXPECT_EQ(worker.scenes().newest(), first);
    worker.request(requestAt(1, 4));
    EXPECT_NE(nextFrame(worker), nullptr) << "it is still drawn";
}

}  // namespace
}  // namespace stereonav
