// `view --bench`: what a flight in the window is like, measured. The window flies, rests and draws as it
// always does; this says when it is to do which, notes when a picture was shown and of which moment it was,
// and keeps some pictures, which are held against truths when the flight is over. No window and no clock.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "app/view/worker.h"
#include "engine/base/progress.h"
#include "engine/image/plane.h"
#include "engine/scene/facts.h"

namespace stereonav {

// A picture as it came to the screen.
struct ShownPicture {
    using Eye = std::shared_ptr<const Plane<PackedColor>>;
    Eye left, right;    // right: null or empty of one eye
    FrameRequest of;    // what it shows: the pose it was cast for, or warped to
    FrameRequest cast;  // of the picture that was cast
    bool warped = false;
};

class ViewBench {
public:
    static constexpr double kLongestFlight = 20, kRest = 10.2;  // seconds
    static constexpr int kSamples = 24;  // pictures in motion that are held against their truth

    // whole: the flight is flown to its end; else it is broken off where it is longer than the longest.
    explicit ViewBench(bool whole = false) : mWhole(whole) {}

    enum class Wish { None, Fly, Stop, Judge };
    // What the window is to do now; each once. ready: a picture is there and rests; flying: the flight goes
    // on. duration: of the flight, seconds.
    Wish step(double now, bool ready, bool flying, double duration);
    bool judging() const { return mStage == Stage::Judge; }

    // A picture was shown at this time, seconds. now: what was asked for at that moment.
    void shown(const ShownPicture& picture, const FrameRequest& now, double at);
    // A picture was cast.
    void cast(const ViewFrame& frame);

    // Holds the kept pictures against what they should have been. On the thread that makes frames; throws
    // Cancelled.
    void judge(const Scene& scene, Progress& progress);
    // After judge(), or of what there is.
    Facts facts() const;

private:
    enum class Stage { Wait, Fly, Rest, Judge };
    struct Kept {
        ShownPicture picture;
        FrameRequest now;
    };
    void keepSample(const ShownPicture& picture, const FrameRequest& now, double at);
    void keepRest(double now);
    void judgeRest(const Scene& scene, Progress& progress);

    bool mWhole;
    Stage mStage = Stage::Wait;
    double mReadySince = -1, mStarted = 0, mStopped = 0, mDuration = 0, mLast = -1;
    std::vector<double> mBetween, mAge, mDelay, mShownAge;  // milliseconds
    int mCoarse = 0;                                        // pictures cast that lacked detail
    std::vector<double> mCast;                              // milliseconds a cast picture took
    std::vector<double> mScale, mGuard;  // of cast pictures; the second: share of pixels beyond what is shown
    int mSizeChanges = 0;
    std::vector<Kept> mSamples;
    std::optional<ShownPicture> mNewest;
    std::optional<ShownPicture> mAfterOne, mAfterTen;  // what was shown a second and ten after the stop
    int mWarped = 0, mJudged = 0;                      // mJudged: moments in motion
    std::optional<double> mMovingPsnr, mMovingTruePsnr, mNowPsnr, mOnePsnr, mTenPsnr;
    std::optional<double> mOneOfPair, mTenOfPair;  // of media: against the exact pair as it is in flight
    int mTruthRays = 0;                            // a pixel, of those at rest
    double mTruthEffort = 1;                       // of media
};

}  // namespace stereonav
