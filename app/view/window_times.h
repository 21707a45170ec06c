// How long the window's own work takes: what it lays out, what it draws, and the whole turn between two looks
// at the events, which is how late a key or a picture can be. For tests/bench/window_times.sh; without the
// environment variable STEREONAV_WINDOW_TIMES nothing is kept.
#pragma once

#include <vector>

namespace stereonav {

class WindowTimes {
public:
    WindowTimes();
    ~WindowTimes();  // prints medians, 99th percentiles and the longest to standard error
    WindowTimes(const WindowTimes&) = delete;
    WindowTimes& operator=(const WindowTimes&) = delete;

    bool on() const { return mOn; }
    // drew: whether this turn drew; milliseconds.
    void add(double layout_ms, double draw_ms, double turn_ms, bool drew);

private:
    bool mOn;
    std::vector<double> mLayout, mDraw, mTurn;
};

}  // namespace stereonav
