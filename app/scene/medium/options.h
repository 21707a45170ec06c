// Options of a medium: checked, and applied to a scene.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "app/options/scene_options.h"
#include "engine/medium/sweep/medium_scene.h"

namespace stereonav {

// Checks everything that needs no scene: files and names. Throws Error.
void checkMediumOptions(const SceneOptions& options);

// Sets model, phase function, light and resolution; options that are not given change nothing. Throws Error.
void applyMediumOptions(const MediumOptions& options, MediumScene& scene);

}  // namespace stereonav
