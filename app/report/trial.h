// Ways of making the right eye, measured over frames of a scene's flight: their time and error, for the
// report's charts of the right eye and of the quality dial.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/report/run.h"
#include "engine/stereo/right_eye.h"

namespace stereonav {

struct Variant {
    std::string name, detail;
    WarpSetting setting;
    bool isDefault = false;
};

// Returns a method with its own settings.
Variant methodVariant(RightEyeMethod method);
// Returns the same way with one setting changed.
Variant tuned(RightEyeMethod method, float WarpSetting::*what, const char* name, float value);

// Returns the poses of frames of a flight; the start alone where the scene has none.
std::vector<Pose> posesOf(const Scene& scene, int frames);

// Returns the variants in the charts of a scene's right eyes: its methods, and one with other thresholds.
std::vector<Variant> rightEyeVariants(const Scene& scene);
// Returns the scene's eyes in those charts: 1/30 of the zero-parallax distance apart.
StereoSetting chartedEyes(const Scene& scene);

// Return the root mean square error in 8-bit levels.
double rmsOfPsnr(double psnr_db);
double rmsOf(const Plane<PackedColor>& truth, const Plane<PackedColor>& picture);

// Measures as many of `most` places of a flight as `seconds` allow, at least one, and returns their number.
// measure: measures the places `some`, numbered among `of` places along the flight. The first place is
// measured alone, and its time decides how many follow.
int measureWhatFits(int most, double seconds,
                    const std::function<void(const std::vector<int>& some, int of)>& measure);

// Measures variants over frames, in turn in each repeat, so that changes in the machine's speed affect all
// equally.
class RightEyeTrial {
public:
    RightEyeTrial(const ReportScene& scene, const StereoSetting& stereo, std::vector<Variant> variants);

    // Measures as many of the frames as `seconds` allow, at least one.
    void run(ReportRun& run, const std::string& what, int frames, double seconds);

    // Returns the points; for variants with a calibration also how often their bound was kept.
    std::vector<WayPoint> points() const;
    int frames() const { return mFrames; }
    int repeats() const { return mRepeats; }

private:
    // Sums over the frames of one repeat, and over all frames.
    struct Sums {
        std::vector<double> right_ms, warp_ms, fill_ms;  // sums over frames, by repeat
        double least_ms = 0;                             // sum of each frame's fastest repeat
        double squares = 0, worst = 0, ssim = 0, holes = 0, kept = 0, bound_db = 0;
    };

    void chooseRepeats(double first_ms, std::size_t frames, double seconds);
    void frame(ReportRun& run, const StereoViews& views, const std::string& what);
    void measureError(std::size_t n);
    void repeat(int r);
    WayPoint pointOf(const Variant& v, const Sums& sums) const;

    bool mBounds = false;
    const Scene& mScene;
    FrameMaker& mMaker;
    RightFromLeft& mRightMaker;
    StereoSetting mStereo;
    std::vector<Variant> mVariants;
    std::vector<Sums> mSums;
    StereoViews mViews;
    EyePair mFull;  // both eyes cast
    EyeImage mRight;
    int mRepeats = 0, mFrames = 0;
    double mTimed_ms = 0;
    std::vector<double> mFastest;  // fastest times of the present frame, by variant
};

}  // namespace stereonav
