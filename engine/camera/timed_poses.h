// The frames of a recorded path with the path's own clock, on which what moves by itself moves too.
#pragma once

#include <vector>

#include "engine/camera/recorded_path.h"

namespace stereonav {

// A pose of a path, and when it is flown.
struct TimedPose {
    Pose pose;
    double time = 0;  // seconds since the path's start
};

// Returns the poses of RecordedPath::frames with their times. This and timedFramesAtRate(), which is of
// framesAtRate, throw as those do.
std::vector<TimedPose> timedFrames(const RecordedPath& path, int count);
// Returns for each of `frames`, which are timedFrames of the path, the pose `seconds` later, or earlier where
// the path is at its end: as the path is flown. Returns nothing where it is shorter than that.
std::vector<TimedPose> timedBeside(const RecordedPath& path, const std::vector<TimedPose>& frames,
                                   double seconds);
std::vector<TimedPose> timedFramesAtRate(const RecordedPath& path, double framesPerSecond);

}  // namespace stereonav
