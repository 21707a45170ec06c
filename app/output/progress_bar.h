// A progress bar on stderr: redrawn in place on a terminal; elsewhere one line every ten seconds, so
// that logs stay short and short jobs say nothing. Between reports it says how long the present work takes,
// and of a long loop how much of it is done. What the work has to note goes there too, in lines that stay.
#pragma once

#include <atomic>
#include <mutex>
#include <set>
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
    void tell(const std::string& note);
    void showAgain(double share);  // while a loop runs that reports nothing
    void draw(double now_ms);

    std::mutex mMutex;  // reports come from any thread
    Stopwatch mSinceStart;
    std::atomic<double> mNext_ms;
    double mFraction = 0, mReported_ms = 0;    // the last report
    double mLoopShare = 0, mLoopStart_ms = 0;  // of the loop looked at last
    double mLineInterval_ms = 0;
    std::string mWhat;
    std::set<std::string> mTold;
    bool mShown, mTerminal, mDrawn = false;
    Progress mProgress;
};

// "[=====>    ]  52 % what", as wide as asked.
std::string progressLine(double fraction, const std::string& what, int barWidth);

}  // namespace stereonav
