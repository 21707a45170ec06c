// The picture that the window shows: the newest frame, the way it is shown, and the rate of frames. Needs the
// window's context.
#pragma once

#include <deque>
#include <memory>
#include <string>

#include "app/view/asked_frames.h"
#include "app/view/frame_rate.h"
#include "app/view/late_card.h"
#include "app/view/late_view.h"
#include "app/view/screenshots.h"
#include "app/view/session.h"
#include "app/view/status_words.h"
#include "app/view/view_bench.h"
#include "engine/display/stereo_presenter.h"
#include "engine/display/window.h"

namespace stereonav {

// The way in which a picture is shown.
enum class PictureWay {
    Cast,             // the newest frame as it was cast or swept
    LateByProcessor,  // warped to the present place of the eyes
    LateByCard,
    Slices  // slices of a study, instead of the frame
};

// Figures of one frame, for small plots.
struct FrameCost {
    double left_ms = 0, right_ms = 0;            // eyes made together count for the left one
    double warp_ms = 0, fill_ms = 0, holes = 0;  // holes: percentage of the right eye's pixels
};

class FramePresenter {
public:
    // window must outlive this object. readsBack: also keeps pictures that the graphics card warped, for
    // comparison with truths.
    FramePresenter(const Window& window, bool readsBack) : mCard(window), mReadsBack(readsBack) {}

    // Returns the newest frame; null before the first.
    const ViewFrame* frame() const { return mFrame.get(); }
    const std::shared_ptr<const ViewFrame>& shared() const { return mFrame; }
    // Returns the picture that is shown; without eyes where it is not one of the scene.
    const ShownPicture& picture() const { return mPicture; }
    // Returns the size of an eye that is shown in pixels; 0 for slices, and before the first frame.
    glm::ivec2 eyeSize() const;
    // Returns how late the picture is that is shown; empty where it is no warped one.
    std::optional<LatePicture> late() const;
    double framesPerSecond() const { return mRate.value(); }       // 0: not known
    const std::deque<FrameCost>& costs() const { return mCosts; }  // newest last
    void forgetCosts() { mCosts.clear(); }

    // Takes a frame of this session.
    void take(std::shared_ptr<const ViewFrame> frame, const AskedFrames& asked, bool lateWarp);
    // Chooses the way to show a picture now, and shows it when it is due. refresh: seconds per refresh of the
    // monitor.
    void show(ViewSession& session, AskedFrames& asked, bool lateWarp, double refresh);
    // Shows the session's slices in this size.
    void showSlices(ViewSession& session, const SizeOption& eye, Screenshots& screenshots);
    void leaveSlices();
    // Returns the seconds until the next warped picture is due; empty where none is warped.
    std::optional<double> wait(const AskedFrames& asked, bool lateWarp, double refresh) const;

    // Returns whether there is a picture that was not drawn.
    bool fresh() const { return mFresh; }
    bool takeFresh() { return std::exchange(mFresh, false); }
    // Notes that the picture was drawn; seconds: duration of the turn.
    void drew(double seconds);
    StereoPresenter& eyes() { return mEyes; }
    const StereoPresenter& eyes() const { return mEyes; }

private:
    PictureWay wayOf(const ViewSession& session, const AskedFrames& asked, bool lateWarp);
    bool lateDue(const AskedFrames& asked, double refresh) const;
    double latePeriod(double refresh) const { return mPace.period(refresh, 0); }
    void showFrame();
    void showLate(PictureWay way, const FrameRequest& now);

    std::shared_ptr<const ViewFrame> mFrame;
    bool mCame = false;  // whether it was not shown yet
    ShownPicture mPicture;
    PictureWay mWay = PictureWay::Cast;  // way of the picture that is shown
    bool mFresh = false;
    StereoPresenter mEyes;
    LateView mLate;
    LateCard mCard;
    LatePace mPace;
    double mLateShown = 0;  // time of the last warped picture in seconds
    FrameRate mRate;
    std::deque<FrameCost> mCosts;
    long long mSlices = 0;  // version of the slices that are shown; 0: none
    bool mReadsBack;
};

}  // namespace stereonav
