// Records a flight: collects poses on its own clock and returns them as a path.
#pragma once

#include <vector>

#include "engine/camera/recorded_path.h"

namespace stereonav {

class PathRecorder {
public:
    // interval: seconds between samples, > 0; poses between samples are dropped, except the last one.
    explicit PathRecorder(double interval = 1.0 / 60) : mInterval(interval) {}

    // Starts anew with this pose at time 0.
    void start(const Pose& pose);
    // Notes the viewer's pose dt seconds later. Does nothing unless recording() and dt > 0.
    void step(double dt, const Pose& pose);
    // Ends the recording. Throws Error when nothing was recorded after the start.
    RecordedPath finish();

    bool recording() const { return mRecording; }
    double duration() const { return mTime; }  // seconds since the start
    // Returns the samples that finish() would now make a path of.
    const std::vector<PathSample>& samples() const { return mSamples; }

private:
    double mInterval;  // seconds
    bool mRecording = false;
    double mTime = 0;                  // seconds since the start
    std::vector<PathSample> mSamples;  // the last one is the newest pose, kept or not
    double mLastKept = 0;              // time of the last sample that stays
};

}  // namespace stereonav
