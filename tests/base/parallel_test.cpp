// Parallel loops over every schedule and several thread counts: each index once, the partition of
// the static schedules, exceptions, and loops inside loops.
#include "engine/base/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <tuple>
#include <vector>

#include "engine/base/loop_watch.h"
#include "engine/base/progress.h"

namespace stereonav {
namespace {

constexpr Schedule kSchedules[] = {Schedule::Dynamic, Schedule::Interleaved, Schedule::Contiguous};

class ParallelFor : public testing::TestWithParam<std::tuple<Schedule, int>> {
protected:
    void SetUp() override {
        mBefore = threadCount();
        setThreadCount(threads());
    }
    void TearDown() override { setThreadCount(mBefore); }
    Schedule schedule() const { return std::get<0>(GetParam()); }
    int threads() const { return std::get<1>(GetParam()); }

private:
    int mBefore = 1;
};

TEST_P(ParallelFor, ThreadCountIsWhatWasSet) {
    EXPECT_EQ(threadCount(), threads());
}

TEST_P(ParallelFor, VisitsEveryIndexOnce) {
    for (const int count : {0, 1, 2, 3, 7, 64, 1001}) {
        std::vector<std::atomic<int>> visits(count);
        parallelFor(
            count, [&](int i) { ++visits.at(i); }, schedule());
        for (int i = 0; i < count; ++i) EXPECT_EQ(visits[i], 1) << "index " << i << " of " << count;
    }
}

TEST_P(ParallelFor, NegativeCountDoesNothing) {
    int visits = 0;
    parallelFor(
        -3, [&](int) { ++visits; }, schedule());
    EXPECT_EQ(visits, 0);
}

TEST_P(ParallelFor, RethrowsTheBodysException) {
    try {
        parallelFor(
            100,
            [](int i) {
                if (i == 42) throw std::out_of_range("42");
            },
            schedule());
        FAIL() << "the exception was lost";
    } catch (const std::out_of_range& error) {
        EXPECT_STREQ(error.what(), "42");
    }
}

TEST_P(ParallelFor, WorksAgainAfterAnException) {
    EXPECT_THROW(parallelFor(
                     10, [](int) { throw std::runtime_error("no"); }, schedule()),
                 std::runtime_error);
    std::atomic<int> visits = 0;
    parallelFor(
        10, [&](int) { ++visits; }, schedule());
    EXPECT_EQ(visits, 10);
}

TEST_P(ParallelFor, MayBeNested) {
    std::vector<std::atomic<int>> visits(12 * 9);
    parallelFor(
        12,
        [&](int outer) {
            parallelFor(
                9, [&](int inner) { ++visits[outer * 9 + inner]; }, schedule());
        },
        schedule());
    for (std::size_t i = 0; i < visits.size(); ++i) EXPECT_EQ(visits[i], 1) << "index " << i;
}

TEST_P(ParallelFor, NeverUsesMoreThreadsThanSet) {
    std::mutex mutex;
    std::map<std::thread::id, int> used;
    parallelFor(
        200,
        [&](int) {
            std::lock_guard lock(mutex);
            ++used[std::this_thread::get_id()];
        },
        schedule());
    EXPECT_LE(static_cast<int>(used.size()), threads());
}

INSTANTIATE_TEST_SUITE_P(All, ParallelFor,
                         testing::Combine(testing::ValuesIn(kSchedules), testing::Values(1, 2, 3, 5)));

// A static schedule runs a slot on one thread, in rising order: neighbours in the same slot see one
// another's writes without any lock.
TEST(ParallelSchedule, StaticSlotsRunInOrder) {
    const int before = threadCount();
    constexpr int kThreads = 3, kCount = 32;
    setThreadCount(kThreads);
    std::vector<std::atomic<int>> order(kCount);
    std::atomic<int> clock = 0;
    parallelFor(
        kCount, [&](int i) { order[i] = ++clock; }, Schedule::Interleaved);
    for (int i = kThreads; i < kCount; ++i) EXPECT_GT(order[i], order[i - kThreads]) << "index " << i;
    parallelFor(
        kCount, [&](int i) { order[i] = ++clock; }, Schedule::Contiguous);
    for (int i = 1; i < kCount; ++i) {
        const bool sameRun = i != kCount * 1 / kThreads && i != kCount * 2 / kThreads;
        if (sameRun) {
            EXPECT_GT(order[i], order[i - 1]) << "index " << i;
        }
    }
    setThreadCount(before);
}

TEST(ParallelSchedule, CountBelowOneIsOneThread) {
    const int before = threadCount();
    setThreadCount(0);
    EXPECT_EQ(threadCount(), 1);
    setThreadCount(-4);
    EXPECT_EQ(threadCount(), 1);
    setThreadCount(before);
}

// The looks of a program's first thread at its loops.
class LoopWatch : public testing::Test {
protected:
    void SetUp() override {
        mBefore = threadCount();
        watchLoops([this](double share) { mShares.push_back(share); });
    }
    void TearDown() override {
        watchLoops({});
        setThreadCount(mBefore);
    }
    std::vector<double> mShares;
    int mBefore = 1;
};

TEST_F(LoopWatch, SeesTheShareThatIsDone) {
    setThreadCount(1);
    parallelFor(4, [](int) {});
    EXPECT_EQ(mShares, (std::vector<double>{0, 0.25, 0.5, 0.75}));
    for (const int threads : {2, 3, 8}) {
        setThreadCount(threads);
        mShares.clear();
        parallelFor(1000, [](int) {});
        EXPECT_TRUE(std::is_sorted(mShares.begin(), mShares.end())) << threads;
        for (const double share : mShares) ASSERT_TRUE(share >= 0 && share < 1) << share;
    }
}

TEST_F(LoopWatch, SeesTheOutermostLoopAlone) {
    setThreadCount(1);
    parallelFor(2, [](int) { parallelFor(2, [](int) {}); });
    EXPECT_EQ(mShares, (std::vector<double>{0, 0, 0, 0.5, 0.5, 0.5}));
}

TEST_F(LoopWatch, SeesTheStepsOfAPlainLoop) {
    setThreadCount(1);
    for (int again = 0; again < 2; ++again) {
        mShares.clear();
        LoopSteps steps(4);
        for (int n = 0; n < 4; ++n, steps.next()) parallelFor(1, [](int) {});
        EXPECT_EQ(mShares, (std::vector<double>{0, 0.25, 0.5, 0.75}));
    }
    mShares.clear();
    EXPECT_THROW(parallelFor(2,
                             [](int i) {
                                 if (i) throw std::runtime_error("1");
                             }),
                 std::runtime_error);
    parallelFor(2, [](int) {});
    EXPECT_EQ(mShares, (std::vector<double>{0, 0.5, 0, 0.5})) << "a loop that ended early is over";
}

TEST_F(LoopWatch, SeesNothingOfOtherThreads) {
    setThreadCount(1);
    parallelFor(2, [](int) {
        std::thread([] {
            LoopSteps(5).next();
            parallelFor(3, [](int) {});
        }).join();
    });
    EXPECT_EQ(mShares, (std::vector<double>{0, 0.5}));
}

// A flag ends what this thread has started, soon, and no other thread's loops.
TEST_P(ParallelFor, ALoopIsInterruptedByAFlag) {
    constexpr int kEndless = 100'000'000;
    std::atomic<bool> stop = false;
    std::atomic<int> ran = 0;
    interruptLoopsBy(&stop);
    EXPECT_NO_THROW(parallelFor(
        100, [&](int) { ++ran; }, schedule()));
    EXPECT_EQ(ran, 100) << "not set";
    EXPECT_THROW(parallelFor(
                     kEndless,
                     [&](int) {
                         if (++ran == 500) stop = true;
                     },
                     schedule()),
                 Cancelled);
    EXPECT_LT(ran, kEndless);
    const int before = ran;
    EXPECT_THROW(parallelFor(
                     100, [&](int) { ++ran; }, schedule()),
                 Cancelled)
        << "nor is another begun";
    EXPECT_EQ(ran, before);
    std::thread([&] {
        EXPECT_NO_THROW(parallelFor(
            100, [&](int) { ++ran; }, schedule()));
    }).join();
    EXPECT_EQ(ran, before + 100) << "another thread's";
    interruptLoopsBy(nullptr);
    EXPECT_NO_THROW(parallelFor(
        100, [&](int) { ++ran; }, schedule()));
    EXPECT_EQ(ran, before + 200);
}

}  // namespace
}  // namespace stereonav
