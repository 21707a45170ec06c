// A way of making both eyes, with the time of its frames and their error, for the report's charts.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/report/trial.h"

namespace stereonav {

class BothEyes {
public:
    BothEyes(std::size_t repeats, double frames) : mMs(repeats, 0.0), mFrames(frames) {}

    // Adds the time of a frame in one repeat.
    void addTime(std::size_t repeat, double ms) { mMs[repeat] += ms / mFrames; }
    // Adds the error of a frame; to be called once per frame.
    void addError(const Plane<PackedColor>& left, const Plane<PackedColor>& right, const EyePair& made) {
        for (const double rms : {rmsOf(left, made.left.color), rmsOf(right, made.right.color)}) {
            mSquares += rms * rms / (2 * mFrames);
            mWorst = std::max(mWorst, rms);
        }
    }
    WayPoint point(const std::string& name, const std::string& detail, bool isDefault) const {
        return {{name, spreadOf(mMs), std::sqrt(mSquares), isDefault}, detail, mWorst};
    }

private:
    std::vector<double> mMs;  // time of the mean frame, by repeat
    double mFrames;
    double mSquares = 0, mWorst = 0;  // RMS error in 8-bit levels
};

}  // namespace stereonav
