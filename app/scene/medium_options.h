// What the command line says of a medium: checked, and put into a scene.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "app/command/commands.h"
#include "engine/medium/sweep/medium_scene.h"

namespace stereonav {

// As --medium of a terrain: the ground in its own colours.
constexpr const char* kGroundMedium = "ground";

// Whether the options ask for a sweep through a medium instead of rays.
bool showsMedium(const SceneOptions& options);

// All that can be checked without the scene: files and names. Throws Error.
void checkMediumOptions(const SceneOptions& options);

// Model, phase function, light and fineness; what is not given stays. Throws Error.
void applyMediumOptions(const MediumOptions& options, MediumScene& scene);

// --mist: a layer from below up to a height, and what it takes away of light that falls through it.
struct Mist {
    double top = 0;           // metres, world z
    double opticalDepth = 0;  // straight down, > 0
};
std::optional<Mist> mistFromText(const std::string& text);

}  // namespace stereonav
