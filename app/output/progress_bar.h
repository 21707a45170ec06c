// A progress bar on stderr: redrawn in place on a terminal; elsewhere one line every ten seconds, so that
// logs stay short and short jobs print nothing. Between reports it shows how long the present work has taken,
// and the share of a long loop that is done. Notes of the work are printed on lines that stay.
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
    // shown: false: the bar prints nothing.
    explicit ProgressBar(bool shown = true);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    Progress& progress() { return mProgress; }
    // Removes the bar from the terminal, so that other lines can follow.
    void clear();

private:
    void show(double fraction, const std::string& what);
    void tell(const std::string& note);
    void showAgain(double share);  // called during loops that report nothing
    void draw(double now_ms);

    std::mutex mMutex;  // reports come from any thread
    Stopwatch mSinceStart;
    std::atomic<double> mNext_ms;
    double mFraction = 0, mReported_ms = 0;    // last report
    double mLoopShare = 0, mLoopStart_ms = 0;  // the loop that was seen last
    double mLineInterval_ms = 0;
    std::string mWhat;
    std::set<std::string> mTold;
    bool mShown, mTerminal, mDrawn = false;
    Progress mProgress;
};

// Returns "[=====>    ]  52 % what" with a bar of this width.
std::string progressLine(double fraction, const std::string& what, int barWidth);

}  // namespace stereonav
