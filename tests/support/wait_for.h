// The only way to wait in a test: until something has happened, however slow or busy the machine is.
#pragma once

#include <chrono>
#include <thread>

namespace stereonav::test {

// Far more than any waiting needs: only a test that fails waits so long.
constexpr std::chrono::seconds kLongestWait{300};

// Asks again and again until the answer counts as true. Returns the last answer.
template <typename Ask>
auto waitFor(const Ask& ask) {
    const auto end = std::chrono::steady_clock::now() + kLongestWait;
    while (true) {
        auto answer = ask();
        if (answer || std::chrono::steady_clock::now() >= end) return answer;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

}  // namespace stereonav::test
