// What the command line says of a medium: checked, and put into a scene.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "app/options/scene_options.h"
#include "engine/medium/sweep/medium_scene.h"

namespace stereonav {

// All that can be checked without the scene: files and names. Throws Error.
void checkMediumOptions(const SceneOptions& options);

// Model, phase function, light and fineness; what is not given stays. Throws Error.
void applyMediumOptions(const MediumOptions& options, MediumScene& scene);

}  // namespace stereonav
