// The flights through a colon that instruments look along.
#pragma once

#include <string>
#include <vector>

#include "app/scene/volume_inside.h"
#include "colon/instruments/coverage.h"
#include "colon/scene/colon_scene.h"
#include "engine/camera/pose.h"

namespace stereonav {

constexpr double kFlightStep = 0.002;  // metres between poses, where nothing else is said

struct ColonFlights {
    std::vector<Pose> there, back;
};

// The colon's own, from rectum to caecum and back, or a recorded one (file) and the same backwards; `step`
// metres between poses. Throws Error naming the file.
ColonFlights colonFlights(const ColonScene& colon, const std::string& file, double step,
                          const Coverage::FreeDistance& freeDistance, const ColonInterior& inside);

}  // namespace stereonav
