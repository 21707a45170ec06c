// Work beside the window: its result is handed out once, and never after it was cancelled, however it ends.
#include "app/view/beside_work.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>

#include "engine/base/error.h"
#include "tests/support/gate.h"

namespace stereonav {
namespace {

using test::Gate;

class BesideWorkTest : public testing::Test {
protected:
    // Waits until it is handed out, or throws.
    std::optional<std::string> outcome() {
        std::optional<std::string> result;
        EXPECT_TRUE(test::waitFor([&] { return (result = mWork.take()) || !mWork.busy(); }));
        return result;
    }
    void start(const std::string& name) {
        mWork.start(
            [this, name](Progress&) {
                mGate.pass();
                return name;
            },
            [this] { ++mWoken; });
    }

    std::atomic<int> mWoken = 0;
    Gate mGate;
    BesideWork<std::string> mWork;  // last: its end is waited for first
};

TEST_F(BesideWorkTest, IsHandedOutOnce) {
    EXPECT_FALSE(mWork.busy());
    EXPECT_FALSE(mWork.take());
    mWork.cancel();  // does nothing
    start("a");
    EXPECT_TRUE(mWork.busy());
    EXPECT_FALSE(mWork.take());
    mGate.open();
    EXPECT_EQ(outcome(), "a");
    EXPECT_EQ(mWoken, 1);
    EXPECT_FALSE(mWork.busy());
    EXPECT_FALSE(mWork.take());
    start("b");
    EXPECT_EQ(outcome(), "b") << "the cancel of before is not of it";
}

// The wish to cancel comes when nothing checks for it any more.
TEST_F(BesideWorkTest, CancelledItIsNotHandedOutThoughItCameToItsEnd) {
    start("a");
    mGate.await();
    mWork.cancel();
    mGate.open();
    EXPECT_THROW(outcome(), Cancelled);
    EXPECT_FALSE(mWork.busy());
    // A result from before the wish that was not taken is not handed out, either.
    start("b");
    ASSERT_TRUE(test::waitFor([this] { return mWoken == 2; }));
    mWork.cancel();
    EXPECT_THROW(outcome(), Cancelled);
    start("c");
    EXPECT_EQ(outcome(), "c");
}

TEST_F(BesideWorkTest, WhatFailsIsToldUnlessItWasCancelled) {
    for (const bool cancelled : {false, true}) {
        SCOPED_TRACE(cancelled);
        Gate gate;
        mWork.start(
            [&](Progress&) -> std::string {
                gate.pass();
                throw Error("a.nrrd", "", "is cut off", "copy it again");
            },
            [] {});
        gate.await();
        if (cancelled) mWork.cancel();
        gate.open();
        try {
            outcome();
            ADD_FAILURE() << "expected what it threw";
        } catch (const Error&) {
            EXPECT_FALSE(cancelled);
        } catch (const Cancelled&) {
            EXPECT_TRUE(cancelled);
        }
        EXPECT_FALSE(mWork.busy());
    }
}

TEST_F(BesideWorkTest, ItsShareBeginsAnew) {
    Gate half;
    mWork.start(
        [&](Progress& progress) {
            progress.report(0.5, "");
            half.pass();
            progress.report(7, "more than all");
            return std::string("a");
        },
        [] {});
    half.await();
    EXPECT_EQ(mWork.fraction(), 0.5);
    half.open();
    outcome();
    EXPECT_EQ(mWork.fraction(), 1);
    start("b");
    EXPECT_EQ(mWork.fraction(), 0) << "of the next one nothing is done";
    mGate.open();
    outcome();
}

TEST_F(BesideWorkTest, EndsWithItsOwner) {
    std::atomic<bool> ended = false;
    {
        BesideWork<int> work;
        work.start(
            [&](Progress& progress) {
                try {
                    for (;;) progress.report(0, "");
                } catch (const Cancelled&) {
                    ended = true;
                    throw;
                }
                return 1;
            },
            [] {});
    }
    EXPECT_TRUE(ended);
}

}  // namespace
}  // namespace stereonav
