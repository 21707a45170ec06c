// How a volume is lit, from options: baked light, or one of the models it is compared with.
#pragma once

#include <string>

#include "app/commands.h"
#include "colon/colon_scene.h"
#include "engine/base/progress.h"

namespace stereonav {

// --light, --sky, --turn, --exposure, --ambient and --shading into the scene's look. Throws Error, Cancelled.
void applyVolumeLight(const SceneOptions& options, ColonScene& scene, Progress& progress);

// Names for --shading, separated by commas.
std::string shadingNames();

}  // namespace stereonav
