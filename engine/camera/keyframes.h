// Keyframes: poses at given times, from which a flight is made, and to which a recorded flight can be
// reduced.
#pragma once

#include <optional>
#include <vector>

#include "engine/camera/keyframe_curve.h"
#include "engine/camera/recorded_path.h"

namespace stereonav {

// Keyframes in order of time.
using Keyframes = std::vector<PathSample>;

// Each function changes the list and returns the keyframe's index in it. Throw Error, and change nothing, for
// poses and times that are not finite, times that another keyframe has, and indices out of range.
std::size_t insertKeyframe(Keyframes& keyframes, const PathSample& keyframe);
void removeKeyframe(Keyframes& keyframes, std::size_t place);

// Returns the poses with times from 0 on: each step takes as long as its distance takes at that speed, or its
// turn at half a radian per second, but at least a tenth of a second. metresPerSecond: above 0. Throws Error.
Keyframes timedKeyframes(const std::vector<Pose>& poses, double metresPerSecond);

// Returns the flight through the keyframes (KeyframeCurve): 60 samples per second and the keyframes
// themselves; fewer where those would be more than a million. Throws Error for fewer than two keyframes.
RecordedPath pathThrough(const Keyframes& keyframes, bool easeEnds = true);

// Returns a small set of keyframes whose flight, without eased ends, deviates from the path by no more than
// `metres` and `radians`, at the times of the path's samples; the first and the last sample are in the set.
// Both limits are above 0. Throws Error.
Keyframes keyframesOf(const RecordedPath& path, double metres, double radians);

}  // namespace stereonav
