// Flights through a colon for instruments that look along them.
#pragma once

#include <string>
#include <vector>

#include "app/scene/volume/inside.h"
#include "colon/instruments/coverage.h"
#include "colon/scene/colon_scene.h"
#include "engine/camera/pose.h"

namespace stereonav {

constexpr double kFlightStep = 0.002;  // default distance between poses in metres

struct ColonFlights {
    std::vector<Pose> there, back;
};

// Returns the colon's own flights, from rectum to caecum and back, or those of a file, and the same
// backwards; `step` metres between poses. Throws Error that names the file.
ColonFlights colonFlights(const ColonScene& colon, const std::string& file, double step,
                          const Coverage::FreeDistance& freeDistance, const ColonInterior& inside);

}  // namespace stereonav
