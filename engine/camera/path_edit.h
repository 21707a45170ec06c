// Changes to recorded paths. Each function returns a new path whose clock begins at 0. A path may have jumps
// (moves within a millisecond that are far faster than the rest), as flights through a lumen in several
// segments have: these stay jumps, since nothing between their ends was flown. All functions throw Error for
// an empty path.
#pragma once

#include <optional>

#include "engine/camera/recorded_path.h"

namespace stereonav {

// Returns the part from `from` to `to`, seconds since the path's start, clamped to its ends. Throws Error
// unless both are finite, from < to, and part of the path lies between them.
RecordedPath trimmed(const RecordedPath& path, double from, double to);

// Returns the path with positions and rotations averaged over time by a Gaussian with this standard
// deviation, made of four extended box filters (Gwosdek et al., "Theoretical foundations of Gaussian
// convolution by extended box filtering", 2011). Both ends, and the ends at jumps, stay as they are. Sampled
// 60 times a second or finer, with at most 100,000 poses between jumps. The standard deviation is limited to
// a quarter of the duration of a stretch between jumps. 0 changes nothing; throws Error for negative values
// and NaN.
RecordedPath smoothed(const RecordedPath& path, double seconds);

// Returns the same path at an even speed, without pauses and slower or faster stretches. Turning on the spot
// keeps its time; turning while moving is no faster than a radian per second, or than before.
// metresPerSecond: empty keeps the duration. A path that does not move is unchanged. Throws Error for a speed
// that is not above 0 or not finite.
RecordedPath evenlyPaced(const RecordedPath& path, std::optional<double> metresPerSecond = std::nullopt);

}  // namespace stereonav
