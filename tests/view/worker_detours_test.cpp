// The threads beside the window when wishes change: what was loaded, failed, drawn or measured for an earlier
// one is not taken for the later one, and a cancel leaves the scene as it is.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "app/view/worker.h"
#include "engine/base/error.h"
#include "tests/support/gate.h"
#include "tests/support/one_method_frames.h"
#include "tests/view/fake_scene.h"

namespace stereonav {
namespace {

using test::Gate;

// One colour for each scene, at the distance that is asked for.
class NumberedFrames final : public test::OneMethodFrames {
public:
    explicit NumberedFrames(PackedColor number) : mNumber(number) {}
    void makeOne(const EyeView& view, double, EyePair& frame) override {
        if (before) before(view.eye.x);
        frame.left.resize(view.width, view.height);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                frame.left.color.at(x, y) = mNumber + static_cast<PackedColor>(view.eye.x);
                frame.left.viewDepth.at(x, y) = 50;
            }
    }
    std::function<void(double x)> before;

private:
    PackedColor mNumber;
};

OpenScene numbered(PackedColor number, const std::function<void(double)>& before = nullptr) {
    FakeParts parts;
    auto frames = std::make_shared<NumberedFrames>(number);
    frames->before = before;
    parts.frames = frames.get();
    parts.owner = std::move(frames);
    parts.name = std::to_string(number);
    return openOf(parts);
}

FrameRequest requestFrom(long long version, double x) {
    FrameRequest request;
    request.version = version;
    request.pose = poseFromAngles({x, 0, 0}, 0, 0, 0);
    request.lens.width = 16;
    request.lens.height = 8;
    request.stereo = {0, 50};
    request.way.method = "alone";
    return request;
}

class WorkerDetours : public testing::Test {
protected:
    void begin(const std::function<void(double)>& before = nullptr) {
        mWorker = std::make_unique<ViewWorker>([before](Progress&) { return numbered(100, before); }, [] {});
        ASSERT_TRUE(test::waitFor(
            [this] { return mWorker->scenes().newest() && !mWorker->scenes().loading().busy; }));
    }
    std::string shown() const { return mWorker->scenes().newest()->scene->name; }
    void settle() {
        ASSERT_TRUE(test::waitFor([this] { return !mWorker->scenes().loading().busy; }));
    }
    // Returns a load, or change, that waits at the gate and is not told of its end.
    SceneLoader::Load late(PackedColor number, bool fails = false) {
        return [this, number, fails](Progress&) {
            mGate.pass();
            if (fails) throw Error("late.tif", "", "is cut off", "copy it again");
            return numbered(number);
        };
    }
    SceneLoader::Change lateChange(PackedColor number, bool fails = false) {
        return [this, number, fails](const OpenScene&, Progress& progress) {
            return late(number, fails)(progress);
        };
    }

    Gate mGate;
    std::unique_ptr<ViewWorker> mWorker;  // last: it ends first
};

TEST_F(WorkerDetours, ALoadThatWasReplacedIsNotTakenThoughItCameToItsEnd) {
    begin();
    for (const bool fails : {false, true}) {
        SCOPED_TRACE(fails);
        mGate.close();
        const int before = mGate.came();
        mWorker->scenes().reload(late(200, fails));
        mGate.await(before + 1);
        mWorker->scenes().reload([](Progress&) { return numbered(300); });
        mGate.open();
        ASSERT_TRUE(test::waitFor([this] { return shown() == "300"; }));
        settle();
        EXPECT_EQ(mWorker->scenes().takeProblem(), "") << "it is of a wish that was given up";
    }
}

// a, b, a: the second a is loaded, and neither b nor the first a replaces it.
TEST_F(WorkerDetours, ThereAndBackLoadsWhatWasAskedForLast) {
    begin();
    std::atomic<int> loads = 0;
    const auto again = [&](Progress&) {
        ++loads;
        return numbered(100);
    };
    mWorker->scenes().reload(late(200));
    mGate.await();
    mWorker->scenes().reload(again);
    mWorker->scenes().reload([&](Progress&) {
        ++loads;
        return numbered(200);
    });
    mWorker->scenes().reload(again);
    mGate.open();
    settle();
    EXPECT_EQ(shown(), "100");
    EXPECT_EQ(loads, 1) << "wishes that were not begun are passed over";
}

TEST_F(WorkerDetours, WhatIsCancelledLeavesTheSceneAsItIs) {
    begin();
    const auto first = mWorker->scenes().newest();
    for (const bool fails : {false, true})
        for (const bool change : {false, true}) {
            SCOPED_TRACE(std::string(change ? "change" : "load") + (fails ? ", failing" : ""));
            mGate.close();
            const int before = mGate.came();
            change ? mWorker->scenes().change(lateChange(200, fails))
                   : mWorker->scenes().reload(late(200, fails));
            mGate.await(before + 1);
            mWorker->scenes().change(lateChange(300));
            if (!change) mWorker->scenes().reload(late(400));
            mWorker->scenes().cancel();
            mGate.open();
            settle();
            EXPECT_EQ(mWorker->scenes().newest(), first);
            EXPECT_EQ(mWorker->scenes().takeProblem(), "");
            EXPECT_EQ(mGate.came(), before + 1) << "what waited was not begun";
        }
    mWorker->request(requestFrom(1, 3));
    ASSERT_TRUE(test::waitFor([this] { return mWorker->takeFrame() != nullptr; })) << "it goes on";
}

// A failure is reported once, and not after another wish: it would be taken for that one's.
TEST_F(WorkerDetours, AFailureIsOfTheNewestWishAlone) {
    begin();
    const auto failing = [](Progress&) -> OpenScene { throw Error("bad.tif", "", "is none", "no"); };
    const auto failed = [&] { return test::waitFor([this] { return !mWorker->scenes().loading().busy; }); };
    mWorker->scenes().reload(failing);
    ASSERT_TRUE(failed());
    mWorker->scenes().reload([](Progress&) { return numbered(300); });
    ASSERT_TRUE(test::waitFor([this] { return shown() == "300"; }));
    EXPECT_EQ(mWorker->scenes().takeProblem(), "") << "nobody asked before the next wish came";
    mWorker->scenes().reload(failing);
    ASSERT_TRUE(failed());
    mWorker->scenes().change([](const OpenScene&, Progress&) { return numbered(400); });
    ASSERT_TRUE(test::waitFor([this] { return shown() == "400"; }));
    EXPECT_EQ(mWorker->scenes().takeProblem(), "");
    mWorker->scenes().reload(failing);
    ASSERT_TRUE(failed());
    EXPECT_EQ(mWorker->scenes().takeProblem(), "bad.tif: is none; no");
    EXPECT_EQ(mWorker->scenes().takeProblem(), "");
    EXPECT_EQ(shown(), "400");
    // A change fails while another one waits.
    mGate.close();
    const int before = mGate.came();
    mWorker->scenes().change(lateChange(500, true));
    mGate.await(before + 1);
    mWorker->scenes().change([](const OpenScene& now, Progress&) {
        EXPECT_EQ(now.scene->name, "400") << "what failed is not what it is made from";
        return numbered(600);
    });
    mGate.open();
    ASSERT_TRUE(test::waitFor([this] { return shown() == "600"; }));
    EXPECT_EQ(mWorker->scenes().takeProblem(), "");
}

// A change that waits for a load is dropped with it by the next load.
TEST_F(WorkerDetours, AChangeThatWasAskedForBeforeALoadIsNotMadeAfterIt) {
    begin();
    std::atomic<bool> changed = false;
    mWorker->scenes().reload(late(200));
    mGate.await();
    mWorker->scenes().change([&](const OpenScene&, Progress&) {
        changed = true;
        return numbered(250);
    });
    mWorker->scenes().reload([](Progress&) { return numbered(300); });
    mGate.open();
    settle();
    EXPECT_EQ(shown(), "300");
    EXPECT_FALSE(changed);
}

// --- frames

// The last frame asked for is there in the end, and it shows the scene of that time.
TEST_F(WorkerDetours, FramesEndWithTheNewestRequestOfTheNewestScene) {
    Gate frame;
    begin([&](double x) {
        if (x == 1) frame.pass();
    });
    mWorker->request(requestFrom(1, 1));
    frame.await();
    for (const auto& [version, x] : {std::pair(2, 2.0), {3, 3.0}, {4, 2.0}})
        mWorker->request(requestFrom(version, x));
    mWorker->scenes().reload([](Progress&) { return numbered(300); });
    ASSERT_TRUE(test::waitFor([this] { return shown() == "300"; }));
    frame.open();
    std::shared_ptr<const ViewFrame> newest;
    ASSERT_TRUE(test::waitFor([&] {
        if (auto next = mWorker->takeFrame()) newest = next;
        return newest && newest->request.version == 4;
    }));
    EXPECT_EQ(newest->left.color.at(0, 0), 302u) << "of the other scene, from where it was asked for";
    EXPECT_EQ(newest->request.pose.position.x, 2);
}

// Versions of frames only grow: a frame that was asked for earlier never comes after a later one.
TEST_F(WorkerDetours, NoEarlierFrameComesAfterALaterOne) {
    begin();
    long long last = 0;
    for (int n = 1; n <= 300; ++n) {
        mWorker->request(requestFrom(n, n % 2));
        const auto frame = mWorker->takeFrame();
        if (!frame) continue;
        ASSERT_GT(frame->request.version, last);
        ASSERT_EQ(frame->left.color.at(0, 0), 100u + static_cast<unsigned>(frame->request.version % 2));
        last = frame->request.version;
    }
    ASSERT_TRUE(test::waitFor([&] {
        const auto frame = mWorker->takeFrame();
        if (frame) last = frame->request.version;
        return last == 300;
    }));
}

// Tasks for the thread that makes frames get the scene of that time, in their order.
TEST_F(WorkerDetours, TasksGetTheNewestScene) {
    Gate frame;
    begin([&](double) { frame.pass(); });
    mWorker->request(requestFrom(1, 1));
    frame.await();
    std::vector<std::string> names;
    std::atomic<int> ran = 0;
    const auto ask = [&](const std::string& which) {
        mWorker->ask([&, which](const OpenScene& open) {
            names.push_back(which + open.scene->name);
            ++ran;
        });
    };
    ask("a");
    mWorker->scenes().reload([](Progress&) { return numbered(300); });
    ASSERT_TRUE(test::waitFor([this] { return shown() == "300"; }));
    ask("b");
    frame.open();
    ASSERT_TRUE(test::waitFor([&] { return ran == 2; }));
    EXPECT_EQ(names, (std::vector<std::string>{"a300", "b300"}));
}

}  // namespace
}  // namespace stereonav
