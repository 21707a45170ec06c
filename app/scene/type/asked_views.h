// Eyes and lens of a scene, as options set them.
#pragma once

#include "app/options/scene_options.h"
#include "engine/scene/scene.h"

namespace stereonav {

// Sets separation, zero parallax and field of view as the options say.
void adjustViews(const SceneOptions& options, Scene& scene);

}  // namespace stereonav
