// The picture that the window shows: the newest frame, which way it takes there, and how often one comes.
// Lives in the window's context.
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
#include "app/view/view_bench.h"
#include "engine/display/stereo_presenter.h"
#include "engine/display/window.h"

namespace stereonav {

// Which way a picture takes to the window.
enum class PictureWay {
    Cast,             // the newest frame as it was cast or swept
    LateByProcessor,  // warped to where the eyes are now
    LateByCard,
    Slices  // of a study, in the frame's place
};

// Figures of one frame, for small plots.
struct FrameCost {
    double left_ms = 0, right_ms = 0;            // of eyes made together the left one has it all
    double warp_ms = 0, fill_ms = 0, holes = 0;  // holes: percent of the right eye's pixels
};

class FramePresenter {
public:
    // window: outlives this. readsBack: pictures that the card warped are kept too, to be held against
    // truths.
    FramePresenter(const Window& window, bool readsBack) : mCard(window), mReadsBack(readsBack) {}

    // The newest; null before the first.
    const ViewFrame* frame() const { return mFrame.get(); }
    const std::shared_ptr<const ViewFrame>& shared() const { return mFrame; }
    // What is shown; without eyes where that is none of the scene.
    const ShownPicture& picture() const { return mPicture; }
    // Pixels of an eye that is shown; 0 of slices, and before the first.
    glm::ivec2 eyeSize() const;
    // How old a picture is that was warped, and in how much of the size it was cast; "": cast as it is.
    std::string ageText() const;
    double framesPerSecond() const { return mRate.value(); }       // 0: not known
    const std::deque<FrameCost>& costs() const { return mCosts; }  // newest last
    void forgetCosts() { mCosts.clear(); }

    // A frame of this session has come.
    void take(std::shared_ptr<const ViewFrame> frame, const AskedFrames& asked, bool lateWarp);
    // Chooses the way of the picture for now, and shows it where it is due. refresh: seconds of the monitor.
    void show(ViewSession& session, AskedFrames& asked, bool lateWarp, double refresh);
    // The slices that the session shows, of this size.
    void showSlices(ViewSession& session, const SizeOption& eye, Screenshots& screenshots);
    void leaveSlices();
    // Seconds until the next warped picture is due; none where none is warped.
    std::optional<double> wait(const AskedFrames& asked, bool lateWarp, double refresh) const;

    // A picture is there that was not drawn.
    bool fresh() const { return mFresh; }
    bool takeFresh() { return std::exchange(mFresh, false); }
    // That picture was drawn; seconds that the turn took.
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
    bool mCame = false;  // it was not shown yet
    ShownPicture mPicture;
    PictureWay mWay = PictureWay::Cast;  // of what is shown
    bool mFresh = false;
    StereoPresenter mEyes;
    LateView mLate;
    LateCard mCard;
    LatePace mPace;
    double mLateShown = 0;  // when the last warped picture came: seconds
    FrameRate mRate;
    std::deque<FrameCost> mCosts;
    long long mSlices = 0;  // the version of those that are shown; 0: none are
    bool mReadsBack;
};

}  // namespace stereonav
