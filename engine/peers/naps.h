// Pauses of who waits for messages: short at first, then longer, so that waiting costs next to nothing.
#pragma once

#include <algorithm>
#include <chrono>
#include <thread>

namespace stereonav {

class Naps {
public:
    // Sleeps for 20 microseconds, after each call twice as long, up to 2 ms.
    // busy: bytes are moving, and move only while they are looked after.
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
