// Times of the window's own work: layout, drawing, and the whole turn between two checks of events, which is
// the delay of a key or picture. For tests/bench/window_times.sh; does nothing without the environment
// variable STEREONAV_WINDOW_TIMES.
#pragma once

#include <vector>

namespace stereonav {

class WindowTimes {
public:
    WindowTimes();
    ~WindowTimes();  // prints medians, 99th percentiles and maxima to standard error
    WindowTimes(const WindowTimes&) = delete;
    WindowTimes& operator=(const WindowTimes&) = delete;

    bool on() const { return mOn; }
    // Adds a turn. drew: whether it drew; times in milliseconds.
    void add(double layout_ms, double draw_ms, double turn_ms, bool drew);

private:
    bool mOn;
    std::vector<double> mLayout, mDraw, mTurn;
};

}  // namespace stereonav
