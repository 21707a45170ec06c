// The frames of a recorded path with times on the path's own clock, which also drives animated parts of a
// scene.
#pragma once

#include <vector>

#include "engine/camera/recorded_path.h"

namespace stereonav {

// A pose of a path, and the time at which it is flown.
struct TimedPose {
    Pose pose;
    double time = 0;  // seconds since the path's start
};

// Returns the poses of RecordedPath::frames with their times; timedFramesAtRate() those of framesAtRate. Both
// throw as those functions do.
std::vector<TimedPose> timedFrames(const RecordedPath& path, int count);
// Returns for each of `frames`, from timedFrames() of the path, the pose `seconds` later on the path, or
// earlier where the path ends before. Empty where the path is shorter than that.
std::vector<TimedPose> timedBeside(const RecordedPath& path, const std::vector<TimedPose>& frames,
                                   double seconds);
std::vector<TimedPose> timedFramesAtRate(const RecordedPath& path, double framesPerSecond);

}  // namespace stereonav
