// The data for a coarser scene's successor are prepared once, beside the window, and the work ends with the
// scene.
#include "app/view/scene_preparation.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>

#include "engine/base/error.h"
#include "engine/scene/capabilities.h"
#include "tests/support/gate.h"
#include "tests/support/wait_for.h"
#include "tests/view/fake_frames.h"

namespace stereonav {
namespace {

using Prepare = std::function<void(Progress&)>;

class Coarse final : public Scene, StandIn {
public:
    Coarse(std::string tiles, Prepare prepare) : mTiles(std::move(tiles)), mPrepare(std::move(prepare)) {
        if (mPrepare) offer<const StandIn>(*this);
    }
    FrameMaker& frames() const override { return mFrames; }
    std::unique_ptr<Flight> makeFlight() const override { return nullptr; }
    Facts describe() const override { return {}; }

private:
    const std::string& name() const override { return mTiles; }
    std::string what() const override { return "making " + mTiles; }
    void prepare(Progress& progress) const override { mPrepare(progress); }

    std::string mTiles;
    Prepare mPrepare;
    mutable FakeFrames mFrames;
};

std::shared_ptr<const OpenScene> opened(const std::string& tiles, Prepare prepare) {
    OpenScene open;
    open.scene = std::make_shared<Coarse>(tiles, std::move(prepare));
    return std::make_shared<const OpenScene>(std::move(open));
}

void untilCancelled(Progress& progress) {
    test::waitFor([&] { return progress.report(0.25, ""), false; });
}

class Preparation : public testing::Test {
protected:
    // Takes the result like the window, turn by turn, until there is one.
    bool wait(const std::shared_ptr<const OpenScene>& shown) {
        return test::waitFor([&] {
            mPreparation.follow(shown);
            return mPreparation.take();
        });
    }

    std::atomic<int> mWoken = 0;
    ScenePreparation mPreparation{[this] { ++mWoken; }};
};

TEST_F(Preparation, HasNothingToDoForOtherScenes) {
    const auto whole = opened("", nullptr);
    mPreparation.follow(whole);
    EXPECT_FALSE(mPreparation.work());
    EXPECT_FALSE(mPreparation.take());
}

TEST_F(Preparation, IsDoneOnceForAScene) {
    std::atomic<int> times = 0;
    std::atomic<bool> go = false;
    const auto shown = opened("a", [&](Progress& progress) {
        ++times;
        progress.report(0.5, "");
        test::waitFor([&] { return go.load(); });
    });
    mPreparation.follow(shown);
    ASSERT_TRUE(mPreparation.work());
    EXPECT_EQ(mPreparation.work()->what, "making a");
    EXPECT_FALSE(mPreparation.take());
    go = true;
    EXPECT_TRUE(wait(shown));
    EXPECT_EQ(mWoken, 1);
    mPreparation.follow(shown);  // the scene is shown until the whole has been loaded
    EXPECT_FALSE(mPreparation.work());
    EXPECT_FALSE(mPreparation.take());
    EXPECT_EQ(times, 1);
}

// The same ground under other settings is another scene that lacks the same data.
TEST_F(Preparation, GoesOnForASceneOfTheSameName) {
    std::atomic<int> times = 0;
    std::atomic<bool> go = false;
    const auto work = [&](Progress&) {
        ++times;
        test::waitFor([&] { return go.load(); });
    };
    mPreparation.follow(opened("a", work));
    const auto again = opened("a", work);
    mPreparation.follow(again);
    go = true;
    EXPECT_TRUE(wait(again));
    EXPECT_EQ(times, 1);
}

TEST_F(Preparation, IsDroppedWithItsScene) {
    mPreparation.follow(opened("a", untilCancelled));
    std::atomic<int> times = 0;
    const auto other = opened("b", [&](Progress&) { ++times; });
    EXPECT_TRUE(wait(other)) << "neither an error of the first, nor taken for the second";
    EXPECT_EQ(times, 1);
}

// a, b, a: work that is finished for a while b was shown is not taken for b, and a is loaded again once it is
// shown again, though the work had finished before it was cancelled.
TEST_F(Preparation, IsTakenForTheSceneThatCameBack) {
    for (const bool heard : {true, false}) {
        SCOPED_TRACE(heard);
        ScenePreparation preparation{[] {}};
        test::Gate gate;
        const auto a = opened("a", [&](Progress& progress) {
            gate.pass();
            if (heard) progress.report(0.5, "");
        });
        const auto plain = opened("", nullptr);
        preparation.follow(a);
        gate.await();
        preparation.follow(plain);
        EXPECT_FALSE(preparation.work()) << "nobody waits for it";
        preparation.follow(a);
        gate.open();
        bool taken = false;
        EXPECT_TRUE(test::waitFor([&] {
            preparation.follow(a);
            return taken = preparation.take();
        })) << "it is looked for again";
        EXPECT_TRUE(taken);
        EXPECT_EQ(gate.came(), 2);
        preparation.follow(a);
        EXPECT_FALSE(preparation.work()) << "once";
    }
}

TEST_F(Preparation, AFailureOfASceneThatIsGoneIsNotTold) {
    test::Gate gate;
    mPreparation.follow(opened("a", [&](Progress&) {
        gate.pass();
        throw Error("cache", "tiles", "no room", "make some");
    }));
    gate.await();
    const auto other = opened("b", [](Progress&) {});
    mPreparation.follow(other);
    gate.open();
    EXPECT_TRUE(wait(other)) << "b's own";
}

TEST_F(Preparation, IsNotBegunAgainOnceCancelledOrFailed) {
    const auto slow = opened("a", untilCancelled);
    mPreparation.follow(slow);
    mPreparation.cancel();
    EXPECT_THROW(wait(slow), Cancelled);
    mPreparation.follow(slow);
    EXPECT_FALSE(mPreparation.work());
    const auto bad = opened("b", [](Progress&) { throw Error("cache", "tiles", "no room", "make some"); });
    EXPECT_THROW(wait(bad), Error);
    mPreparation.follow(bad);
    EXPECT_FALSE(mPreparation.work());
}

}  // namespace
}  // namespace stereonav
