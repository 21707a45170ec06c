// Frames a second while they flow; keeps its value while the picture stands still.
#pragma once

#include "engine/base/stopwatch.h"

namespace stereonav {

class FrameRate {
public:
    // flowing: the next frame is already asked for, so that the time until it counts.
    void count(bool flowing) {
        constexpr double kWeight = 0.15;  // of the newest frame in the mean time between frames
        const double seconds = mWatch.lap_ms() / 1000;
        if (mFlowing) mMean = mMean > 0 ? mMean + kWeight * (seconds - mMean) : seconds;
        mFlowing = flowing;
    }
    // 0: nothing is known before the first frames that followed each other.
    double value() const { return mMean > 0 ? 1 / mMean : 0; }

private:
    Stopwatch mWatch;
    double mMean = 0;  // seconds
    bool mFlowing = false;
};

}  // namespace stereonav
