// The study of a scene's slices: read beside the frames once it is needed, for the slice view or for a panel,
// and then owned by the session.
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

    // Returns the session's study, and asks for it; null until it is there, or where there is none.
    std::shared_ptr<const SliceStudy> wanted(ViewSession& session);
    // Notes that there is a picture: nothing is read before the first, which the user is waiting for.
    void noteFrame() { mFrame = true; }
    bool busy() const { return mReading.busy(); }
    // Returns the progress while it is read.
    std::optional<double> fraction() const;
    void cancel() { mReading.cancel(); }
    // Drops the study, for another session.
    void abandon();
    // Begins reading where the session needs the study, and hands it over; to be called each turn.
    void follow(ViewSession& session, Notices& notices);

private:
    std::function<void()> mWake;
    bool mFrame = false, mFailed = false;
    SliceReading mReading;
};

}  // namespace stereonav
