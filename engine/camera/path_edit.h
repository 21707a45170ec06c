// Changes to recorded paths, each a new path whose clock begins at 0. Where a path is cut, as flights through
// a lumen in several segments are (a way within a millisecond that is far faster than the rest), it stays
// cut: what lies between was never flown. All throw Error for an empty path.
#pragma once

#include <optional>

#include "engine/camera/recorded_path.h"

namespace stereonav {

// Returns the part from `from` to `to`, seconds since the path's start, cut to its ends. Throws Error unless
// both are finite and from < to with something of the path between them.
RecordedPath trimmed(const RecordedPath& path, double from, double to);

// Positions and rotations averaged over time by a Gaussian of this standard deviation, made of four extended
// box filters (Gwosdek et al., "Theoretical foundations of Gaussian convolution by extended box filtering",
// 2011). Both ends, and those of cuts, stay as they are. Sampled 60 times a second or finer, at most 100,000
// poses between cuts. At most a quarter of a stretch's own time is taken. 0 changes nothing; throws Error
// below, or NaN.
RecordedPath smoothed(const RecordedPath& path, double seconds);

// Returns the same way at an even speed: pauses are gone, and so are places where it was flown slower or
// faster. Who turns standing keeps the time of that; who turns while moving turns no faster than a radian a
// second, or than before. metresPerSecond: none keeps the duration. A path that does not move is as it was.
// Throws Error for a speed that is not above 0 or not finite.
RecordedPath evenlyPaced(const RecordedPath& path, std::optional<double> metresPerSecond = std::nullopt);

}  // namespace stereonav
