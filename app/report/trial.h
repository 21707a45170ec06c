// Ways of making the right eye, run over frames of a scene's flight: what each takes and how wrong it is.
// What the report's charts of the right eye and of the quality dial are made of.
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

// A method with its own settings.
Variant methodVariant(RightEyeMethod method);
// The same way with one setting changed.
Variant tuned(RightEyeMethod method, float WarpSetting::*what, const char* name, float value);

// What the charts of a scene's right eyes compare: its methods, and one with other thresholds.
std::vector<Variant> rightEyeVariants(const Scene& scene);
// The scene's eyes as those charts have them: 1/30 of the zero-parallax distance apart.
StereoSetting chartedEyes(const Scene& scene);

// Root mean square error in 8-bit levels.
double rmsOfPsnr(double psnr_db);

// Of `most` places of a flight as many as `seconds` allow, one at least, and how many. measure: these of so
// many. The first is measured for itself, and tells how long one takes.
int measureWhatFits(int most, double seconds,
                    const std::function<void(const std::vector<int>& some, int of)>& measure);

// Runs variants over frames, one after another in each repeat, so that the machine's moods meet all alike.
class RightEyeTrial {
public:
    RightEyeTrial(const ReportScene& scene, const StereoSetting& stereo, std::vector<Variant> variants);

    // As many of the frames as `seconds` allow, at least one.
    void run(ReportRun& run, const std::string& what, int frames, double seconds);

    // Of variants with a calibration also how often their bound was kept.
    std::vector<WayPoint> points() const;
    int frames() const { return mFrames; }
    int repeats() const { return mRepeats; }

private:
    // Sums over the frames of one repeat, and over frames.
    struct Sums {
        std::vector<double> right_ms, warp_ms, fill_ms;  // by repeat, over frames
        double least_ms = 0;                             // of each frame the fastest repeat, over frames
        double squares = 0, worst = 0, ssim = 0, holes = 0, kept = 0, bound_db = 0;
    };

    std::vector<Pose> posesOf(int frames) const;
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
    EyePair mFull;  // each eye cast
    EyeImage mRight;
    int mRepeats = 0, mFrames = 0;
    double mTimed_ms = 0;
    std::vector<double> mFastest;  // of the frame at hand, by variant
};

}  // namespace stereonav
