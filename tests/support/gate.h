// A gate for work of another thread: a test waits until the work has come to it, does what has to happen
// meanwhile, and opens it. Nothing depends on speed.
#pragma once

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>

#include "tests/support/wait_for.h"

namespace stereonav::test {

class Gate {
public:
    // To be called by the work: says that it is here, and waits until the gate is open.
    void pass() {
        std::unique_lock lock(mMutex);
        ++mCame;
        mChanged.notify_all();
        mChanged.wait(lock, [this] { return mOpen; });
    }
    // To be called by the test: waits until `many` threads have come to the gate, whether they have passed or
    // not.
    void await(int many = 1) {
        std::unique_lock lock(mMutex);
        ASSERT_TRUE(mChanged.wait_for(lock, kLongestWait, [&] { return mCame >= many; }))
            << mCame << " have come";
    }
    void open() { set(true); }
    void close() { set(false); }
    int came() const {
        const std::lock_guard lock(mMutex);
        return mCame;
    }

private:
    void set(bool open) {
        {
            const std::lock_guard lock(mMutex);
            mOpen = open;
        }
        mChanged.notify_all();
    }

    mutable std::mutex mMutex;
    std::condition_variable mChanged;
    bool mOpen = false;
    int mCame = 0;
};

}  // namespace stereonav::test
