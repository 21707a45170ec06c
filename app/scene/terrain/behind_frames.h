// A thread that works behind the one that makes frames, and hands over what it has made, newest first.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "engine/base/lone_loops.h"
#include "engine/base/parallel.h"
#include "engine/base/progress.h"
#include "engine/base/thread_priority.h"

namespace stereonav {

// Made: what is handed over; Made{} stands for nothing. Last among the members of its owner, so that the
// thread ends before what it reads.
template <typename Made>
class BehindFrames {
public:
    BehindFrames() : mProgress(std::make_shared<Progress>()) {}
    // Returns promptly where the work looks at progress() or loops by parallelFor().
    ~BehindFrames() {
        mStop = true;
        mProgress->cancel();
        if (mThread.joinable()) mThread.join();
    }
    BehindFrames(const BehindFrames&) = delete;
    BehindFrames& operator=(const BehindFrames&) = delete;

    // Begins the work, on one thread that gives way to those that make frames; later calls do nothing. An
    // error ends it without a word: the scene has ended, or memory does not suffice, and what is shown stays.
    template <typename Work>
    void begin(Work work) {
        if (mThread.joinable()) return;
        mThread = std::thread([this, work = std::move(work)] {
            stepBehindTheWindow();
            stepBehindTheWindow();  // and after the thread that makes frames
            loopOnThisThreadAlone();
            interruptLoopsBy(&mStop);
            try {
                work();
            } catch (const std::exception&) {
                // What was handed over before stays.
            }
            mDone = true;
        });
    }

    // Hands over; for the work's thread.
    void give(Made made) {
        {
            const std::lock_guard lock(mMutex);
            mNewest = std::move(made);
        }
        ++mCount;
    }

    // Returns the newest since the last call, Made{} where there is none.
    Made take() {
        const std::lock_guard lock(mMutex);
        return std::exchange(mNewest, Made{});
    }

    Progress& progress() { return *mProgress; }
    std::uint64_t count() const { return mCount; }  // grows with each hand-over
    bool done() const { return mDone; }             // whether no more will come

private:
    std::mutex mMutex;
    Made mNewest{};
    std::atomic<std::uint64_t> mCount = 0;
    std::atomic<bool> mStop = false, mDone = false;
    std::shared_ptr<Progress> mProgress;
    std::thread mThread;
};

}  // namespace stereonav
