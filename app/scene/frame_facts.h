// How frames of a scene are made, as facts for `info` and the report.
#pragma once

#include <optional>
#include <string>

#include "engine/scene/facts.h"
#include "engine/scene/scene.h"
#include "engine/stereo/frame_plan.h"

namespace stereonav {

// plan: empty for media, which have no choice to make: both eyes come from one sweep.
Facts factsOfFrames(const Scene& scene, const std::optional<FramePlan>& plan);

// Returns the planes that are warped: "colour, depth, hole mask".
std::string planesText(const FramePlan& plan);

}  // namespace stereonav
