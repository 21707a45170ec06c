// How frames of a scene are made, as facts: what `info` and the report say of it.
#pragma once

#include <optional>
#include <string>

#include "engine/scene/facts.h"
#include "engine/scene/scene.h"
#include "engine/stereo/frame_plan.h"

namespace stereonav {

// plan: none of media, of which there is nothing to weigh: both eyes come from one sweep.
Facts factsOfFrames(const Scene& scene, const std::optional<FramePlan>& plan);

// "colour, depth, hole mask"
std::string planesText(const FramePlan& plan);

}  // namespace stereonav
