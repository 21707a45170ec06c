// `view --bench`: measures a flight in the window. The window flies, rests and draws as usual; this object
// decides when it does which, notes when a picture was shown and of which moment it was, and keeps some
// pictures for comparison with truths after the flight. Needs no window and no clock.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "app/view/view_frame.h"
#include "engine/base/progress.h"
#include "engine/image/plane.h"
#include "engine/scene/facts.h"

namespace stereonav {

// A picture as it was shown on the screen.
struct ShownPicture {
    using Eye = std::shared_ptr<const Plane<PackedColor>>;
    Eye left, right;    // right: null or empty for one eye
    FrameRequest of;    // request that it shows: the pose that it was cast for, or warped to
    FrameRequest cast;  // request of the picture that was cast
    bool warped = false;
};

class ViewBench {
public:
    static constexpr double kLongestFlight = 20, kRest = 10.2;  // seconds
    static constexpr int kSamples = 24;  // number of pictures in motion that are compared with their truth

    // whole: fly the flight to its end; otherwise it is ended at the longest duration.
    explicit ViewBench(bool whole = false) : mWhole(whole) {}

    enum class Wish { None, Fly, Stop, Judge };
    // Returns what the window has to do now; each wish is returned once. ready: there is a picture and it
    // rests; flying: the flight goes on; duration: seconds of the whole flight.
    Wish step(double now, bool ready, bool flying, double duration);
    bool judging() const { return mStage == Stage::Judge; }

    // Notes a picture that was shown at this time in seconds. now: the request of that moment.
    void shown(const ShownPicture& picture, const FrameRequest& now, double at);
    // Notes a picture that was cast.
    void cast(const ViewFrame& frame);

    // Compares the kept pictures with their truths. On the thread that makes frames; throws Cancelled.
    void judge(const Scene& scene, Progress& progress);
    // Returns the results: all after judge(), or those that there are.
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
    std::vector<double> mBetween, mAge, mDelay, mShownAge;  // in milliseconds
    int mCoarse = 0;                                        // cast pictures that lacked detail
    std::vector<double> mCast;                              // milliseconds of each cast picture
    // For each cast picture: scale times effort; area outside the visible part, as a share of that part.
    std::vector<double> mScale, mGuard;
    int mSizeChanges = 0;
    std::vector<Kept> mSamples;
    std::optional<ShownPicture> mNewest;
    std::optional<ShownPicture> mAfterOne, mAfterTen;  // pictures shown one and ten seconds after the stop
    int mWarped = 0, mJudged = 0;                      // mJudged: number of moments in motion
    std::optional<double> mMovingPsnr, mMovingTruePsnr, mNowPsnr, mOnePsnr, mTenPsnr;
    std::optional<double> mOneOfPair, mTenOfPair;  // PSNR in dB, media only: against the exact pair
    int mTruthRays = 0;                            // rays per pixel of the truths of pictures at rest
    double mTruthEffort = 1;                       // for media
};

}  // namespace stereonav
