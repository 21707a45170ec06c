// Keyframes: poses at times, through which a flight is made, and which a recorded one is reduced to.
#pragma once

#include <optional>
#include <vector>

#include "engine/camera/keyframe_curve.h"
#include "engine/camera/recorded_path.h"

namespace stereonav {

// Keyframes in order of time.
using Keyframes = std::vector<PathSample>;

// Each changes the list and returns the place of the keyframe in it. Throw Error, and change nothing, for
// poses and times that are not finite, times that another keyframe has, and places that the list does not
// have.
std::size_t insertKeyframe(Keyframes& keyframes, const PathSample& keyframe);
void removeKeyframe(Keyframes& keyframes, std::size_t place);

// Returns the poses with times from 0 on: each step takes what its way takes at that speed, or its turn at
// half a radian a second, at least a tenth of a second. metresPerSecond: above 0. Throws Error.
Keyframes timedKeyframes(const std::vector<Pose>& poses, double metresPerSecond);

// The flight through them (KeyframeCurve), 60 samples a second and the keyframes themselves; fewer where that
// makes more than a million. Throws Error for fewer than two keyframes.
RecordedPath pathThrough(const Keyframes& keyframes, bool easeEnds = true);

// Returns the fewest keyframes found whose flight, without eased ends, is nowhere further from the path than
// `metres` and `radians`, at the times of the path's samples; the first and the last sample among them. Both
// above 0. Throws Error.
Keyframes keyframesOf(const RecordedPath& path, double metres, double radians);

}  // namespace stereonav
