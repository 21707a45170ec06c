// Progress of a long job, and the request to stop it. The job calls report() now and then, from any thread.
// report() throws Cancelled once a listener (a bar, a window) has called cancel(), or once the whole run is
// to stop (stop.h). A function that takes a Progress reports 0 first, never less than before, and 1 last; it
// gives the functions that it calls a part of its Progress (the third constructor). A job that had to guess
// says so by note().
#pragma once

#include <atomic>
#include <cmath>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/stop.h"

namespace stereonav {

class Progress {
public:
    using Listener = std::function<void(double fraction, const std::string& what)>;  // fraction: 0 to 1
    using Reader = std::function<void(const std::string& note)>;
    Progress() = default;
    explicit Progress(Listener listener, Reader reader = {})
        : mListener(std::move(listener)), mReader(std::move(reader)) {}
    // Makes a part of another Progress, between two of its fractions, 0 to 1. The other must outlive it.
    Progress(Progress& whole, double from, double to)
        : mListener([&whole, from, to](double fraction, const std::string& what) {
              whole.report(std::lerp(from, to, fraction), what);
          }),
          mReader([&whole](const std::string& note) { whole.note(note); }),
          mWhole(&whole) {}

    void cancel() { mCancelled = true; }
    bool cancelled() const { return mCancelled || stopWished() || (mWhole && mWhole->cancelled()); }

    // Reports the fraction that is done, in [0, 1]. Throws Cancelled once cancel() was called, or the run is
    // to stop.
    void report(double fraction, const std::string& what) {
        if (mCancelled) throw Cancelled();
        throwIfStopped();
        if (mListener) mListener(fraction, what);
    }

    // Notes a fact about the result that the user should know, one line: something that was guessed or left
    // out.
    void note(const std::string& note) {
        if (mReader) mReader(note);
    }

private:
    Listener mListener;
    Reader mReader;
    std::atomic<bool> mCancelled = false;
    const Progress* mWhole = nullptr;  // the progress that this is a part of
};

// Steps of one job that are done in any order, on any threads. They are reported under a lock: without it two
// threads could report their counts in the wrong order.
class ProgressSteps {
public:
    // Reports the first step's beginning. Throws as Progress::report() does.
    ProgressSteps(Progress& progress, std::size_t count, std::string what)
        : mProgress(progress), mCount(count), mWhat(std::move(what)) {
        mProgress.report(0, mWhat);
        if (mCount == 0) mProgress.report(1, mWhat);
    }

    // Reports one more step, after it was done. Throws as Progress::report() does.
    void done() {
        const std::lock_guard lock(mMutex);
        ++mDone;
        mProgress.report(static_cast<double>(mDone) / static_cast<double>(mCount), mWhat);
    }

private:
    Progress& mProgress;
    const std::size_t mCount;
    const std::string mWhat;
    std::mutex mMutex;
    std::size_t mDone = 0;  // guarded by mMutex
};

}  // namespace stereonav
