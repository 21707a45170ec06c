// Frames per second while frames come continuously; keeps its value while the picture rests.
#pragma once

#include "engine/base/stopwatch.h"

namespace stereonav {

class FrameRate {
public:
    // Counts a frame. flowing: the next frame is already asked for, so that the time until it counts.
    void count(bool flowing) {
        constexpr double kWeight = 0.15;  // weight of the newest interval in the mean
        const double seconds = mWatch.lap_ms() / 1000;
        if (mFlowing) mMean = mMean > 0 ? mMean + kWeight * (seconds - mMean) : seconds;
        mFlowing = flowing;
    }
    // Returns the rate; 0 before the first two successive frames.
    double value() const { return mMean > 0 ? 1 / mMean : 0; }

private:
    Stopwatch mWatch;
    double mMean = 0;  // seconds
    bool mFlowing = false;
};

}  // namespace stereonav
