// Measures wall-clock time in milliseconds, from its construction on.
#pragma once

#include <chrono>

namespace stereonav {

class Stopwatch {
public:
    double elapsed_ms() const {
        return std::chrono::duration<double, std::milli>(Clock::now() - mStart).count();
    }
    // Returns the time since the start or the last lap, and starts the next lap.
    double lap_ms() {
        const auto now = Clock::now();
        const double ms = std::chrono::duration<double, std::milli>(now - mStart).count();
        mStart = now;
        return ms;
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point mStart = Clock::now();
};

}  // namespace stereonav
