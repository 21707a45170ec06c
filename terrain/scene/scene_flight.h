// Where to stand and how to fly when a scene does not say it: computed from any ground.
#pragma once

#include "engine/camera/recorded_path.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

// A viewpoint over low ground near the border, well above it, facing the highest ground.
// clearance: metres, >= 0, kept in any case. pitch: radians upwards.
Pose defaultStartPose(const Heightfield& ground, double clearance, double pitch);

// A fixed flight of kDefaultFlightSeconds: an inward spiral scaled with the ground's extent, at even
// speed, looking ahead and a little down, banking mildly. Everywhere along it, between samples too,
// the position is at least `clearance` metres above the ground (and higher, for a comfortable view).
constexpr double kDefaultFlightSeconds = 24.0;
RecordedPath defaultFlight(const Heightfield& ground, double clearance);

}  // namespace stereonav
