// A progress bar on stderr: redrawn in place on a terminal; elsewhere one line every ten seconds, so
// that logs stay short and short jobs say nothing.
#pragma once

#include <mutex>
#include <string>

#include "engine/base/progress.h"
#include "engine/base/stopwatch.h"

namespace stereonav {

class ProgressBar {
public:
    // shown: else it says nothing.
    explicit ProgressBar(bool shown = true);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    Progress& progress() { return mProgress; }
    // Takes the bar off the terminal, so that other lines can follow.
    void clear();

private:
    void show(double fraction, const std::string& what);

    std::mutex mMutex;  // reports come from any thread
    Stopwatch mSinceStart;
    double mNext_ms;
    bool mShown, mTerminal, mDrawn = false;
    Progress mProgress;
};

// "[=====>    ]  52 % what", as wide as asked.
std::string progressLine(double fraction, const std::string& what, int barWidth);

}  // namespace stereonav
