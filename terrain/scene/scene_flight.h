// First pose and flight for scenes that define none, computed from any ground.
#pragma once

#include "engine/camera/recorded_path.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

// Returns a viewpoint over low ground near the border, well above it, facing the highest ground. clearance:
// least height above the ground in metres, >= 0. pitch: radians upwards.
Pose defaultStartPose(const Heightfield& ground, double clearance, double pitch);

// Duration of defaultFlight(), seconds.
constexpr double kDefaultFlightSeconds = 24.0;
// Returns a fixed flight: an inward spiral scaled with the ground's extent, at even speed, looking ahead and
// a little down, banking mildly. Everywhere along it, between samples too, the position is at least
// `clearance` metres above the ground (and higher, for a comfortable view).
RecordedPath defaultFlight(const Heightfield& ground, double clearance);

}  // namespace stereonav
