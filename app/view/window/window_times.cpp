#include "app/view/window/window_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "engine/text/printed.h"

namespace stereonav {
namespace {

void print(const char* what, std::vector<double>& times) {
    if (times.empty()) return;
    std::sort(times.begin(), times.end());
    const auto at = [&](double share) {
        return times[static_cast<std::size_t>(std::floor(share * static_cast<double>(times.size() - 1)))];
    };
    printLine(stderr, fmt::format("{:<7} {:6} times  median {:7.2f} ms  p99 {:7.2f} ms  longest {:7.2f} ms",
                                  what, times.size(), at(0.5), at(0.99), times.back()));
}

}  // namespace

WindowTimes::WindowTimes() : mOn(std::getenv("STEREONAV_WINDOW_TIMES") != nullptr) {}

WindowTimes::~WindowTimes() {
    if (!mOn) return;
    print("layout", mLayout);
    print("draw", mDraw);
    print("turn", mTurn);
}

void WindowTimes::add(double layout_ms, double draw_ms, double turn_ms, bool drew) {
    if (!mOn) return;
    mLayout.push_back(layout_ms);
    if (drew) mDraw.push_back(draw_ms);
    mTurn.push_back(turn_ms);
}

}  // namespace stereonav
