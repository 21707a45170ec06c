// Pauses while waiting for messages: short at first, then longer, so that waiting costs next to nothing.
#pragma once

#include <algorithm>
#include <chrono>
#include <thread>

namespace stereonav {

class Naps {
public:
    // Sleeps for 20 microseconds, and twice as long after each call, up to 2 ms. busy: a message is being
    // moved, which happens only in calls of the message library: yields instead of sleeping.
    void nap(bool busy) {
        if (busy) return std::this_thread::yield();
        std::this_thread::sleep_for(std::chrono::microseconds(mNap_us));
        mNap_us = std::min(2 * mNap_us, kLongest_us);
    }
    void wake() { mNap_us = kShortest_us; }

private:
    static constexpr int kShortest_us = 20, kLongest_us = 2000;
    int mNap_us = kShortest_us;
};

}  // namespace stereonav
