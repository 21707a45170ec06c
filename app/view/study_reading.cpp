#include "app/view/study_reading.h"

#include "app/view/notices.h"
#include "engine/base/error.h"

namespace stereonav {

std::shared_ptr<const SliceStudy> StudyReading::wanted(ViewSession& session) {
    if (!session.slices().study() && !mReading.busy() && mFrame) session.slices().wishStudy();
    return session.slices().study();
}

std::optional<double> StudyReading::fraction() const {
    return mReading.busy() ? std::optional(mReading.fraction()) : std::nullopt;
}

void StudyReading::abandon() {
    mReading.abandon();
    mFailed = false;
}

void StudyReading::follow(ViewSession& session, Notices& notices) {
    // Panels ask with each layout, but not again after a failure; the key V does.
    if (!mReading.busy() && session.slices().takeStudyWish() && (!mFailed || session.slices().wantsView())) {
        mFailed = false;
        mReading.start(session.openShared(), mWake);
    }
    const auto drop = [&] {
        mFailed = true;
        session.slices().dropStudyWish();
    };
    try {
        auto study = mReading.take();
        if (!study) return;
        session.slices().takeStudyWish();  // asked for again meanwhile
        if (session.slices().wantsView())
            session.slices().show(std::move(study));
        else
            session.slices().keepStudy(std::move(study));
    } catch (const Cancelled&) {
        drop();
        session.notify("the slices were not read; V reads them again");
    } catch (const std::exception& error) {
        drop();
        notices.fail(error.what());
    }
}

}  // namespace stereonav
