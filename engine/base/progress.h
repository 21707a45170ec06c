// Progress of a long job, and the wish to stop it. The job calls report() now and then, from any
// thread; the listener (a bar, a window) may ask to cancel, which throws Cancelled out of report(), as a wish
// to stop the whole run does (stop.h).
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/stop.h"

namespace stereonav {

class Progress {
public:
    using Listener = std::function<void(double fraction, const std::string& what)>;
    Progress() = default;
    explicit Progress(Listener listener) : mListener(std::move(listener)) {}

    void cancel() { mCancelled = true; }
    bool cancelled() const { return mCancelled || stopWished(); }

    // fraction in [0, 1]. Throws Cancelled once cancel() was called, or the run is to stop.
    void report(double fraction, const std::string& what) {
        if (mCancelled) throw Cancelled();
        throwIfStopped();
        if (mListener) mListener(fraction, what);
    }

private:
    Listener mListener;
    std::atomic<bool> mCancelled = false;
};

}  // namespace stereonav
