// The study that a scene's slices are of: read beside the frames once somebody wants it, for the slice view
// or for a panel, and then the session's.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "app/view/loading.h"

namespace stereonav {

class Notices;

class StudyReading {
public:
    // wake: called from another thread when it is read.
    explicit StudyReading(std::function<void()> wake) : mWake(std::move(wake)) {}

    // The session's; null until it is there, or where there is none. Asks for it.
    std::shared_ptr<const SliceStudy> wanted(ViewSession& session);
    // A picture is there: before the first, which is what is waited for, nothing is read.
    void noteFrame() { mFrame = true; }
    bool busy() const { return mReading.busy(); }
    // How much of it, while it is read.
    std::optional<double> fraction() const;
    void cancel() { mReading.cancel(); }
    // Another session begins.
    void abandon();
    // Each turn: begins what the session wants, and hands over what was read.
    void follow(ViewSession& session, Notices& notices);

private:
    std::function<void()> mWake;
    bool mFrame = false, mFailed = false;
    SliceReading mReading;
};

}  // namespace stereonav
