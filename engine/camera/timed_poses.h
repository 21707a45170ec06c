// The frames of a recorded path with the path's own clock, on which what moves by itself moves too.
#pragma once

#include <vector>

#include "engine/camera/recorded_path.h"

namespace stereonav {

struct TimedPose {
    Pose pose;
    double time = 0;  // seconds since the path's start
};

// As RecordedPath::frames and framesAtRate.
std::vector<TimedPose> timedFrames(const RecordedPath& path, int count);
std::vector<TimedPose> timedFramesAtRate(const RecordedPath& path, double framesPerSecond);

}  // namespace stereonav
