// Ways of making both eyes with their schedules, by threads: figures beside the stereo paper's table of times
// and its section on partitions.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/report/run.h"
#include "engine/base/parallel.h"
#include "engine/stereo/right_eye.h"

namespace stereonav {

// Returns 1, the paper's 4, 8, 12 and 16 as far as this machine has them, and all of its threads.
std::vector<int> paperThreads(int all);

// Returns a chart without series.
LineChart emptySpeedups(const std::string& title);

// Restores the thread count at the end of its life.
class ThreadsBack {
public:
    ~ThreadsBack();

private:
    int mBefore = threadCount();
};

struct StereoWay {
    std::string name;
    WarpSetting setting;
    Schedule leftSchedule = Schedule::Dynamic;
    bool coherent = true;  // otherwise holes are cast as if nothing were known
};

// Milliseconds per frame over the repeats; the least is the sum of each frame's fastest repeat.
struct StereoTimes {
    Spread left, warp, fill, right;
};

// Counts over all frames.
struct StereoCounts {
    long long surfacePixels = 0, holePixels = 0;   // counted like in surface_difference.h
    double rightEnd = 0, middle = 0, leftEnd = 0;  // holes in these parts of the picture
    double squares = 0, compared = 0;              // sums of the error over channels and frames

    double holesOfWarped_percent() const;
    double psnr_db() const;
};

class StereoTrial {
public:
    // scene must outlive this object. The separation is 1/30 of the zero-parallax distance.
    StereoTrial(const Scene& scene, std::vector<StereoWay> ways, int frames);

    // Measures by threads, with all ways and counts in turn in each repeat; at least `least` repeats.
    void time(ReportRun& run, const std::string& what, const std::vector<int>& threads, int least, int most,
              double seconds);
    const StereoTimes& times(int threads, std::size_t way) const { return mTimes.at(threads)[way]; }

    StereoCounts counts(std::size_t way);
    int frames() const { return static_cast<int>(mViews.size()); }

private:
    void castLeft(const StereoViews& views, Schedule schedule);

    const Scene& mScene;
    std::vector<StereoWay> mWays;
    std::vector<StereoViews> mViews;
    std::map<int, std::vector<StereoTimes>> mTimes;
    RightEye mEye;
    EyeImage mLeft, mRight;
};

}  // namespace stereonav
