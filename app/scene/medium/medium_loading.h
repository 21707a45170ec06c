// Scenes shown as media: they are loaded as usual, their content becomes a medium, and sweeps replace rays.
#pragma once

#include "app/scene/type/scene_type.h"

namespace stereonav {

// Loads a scene of this type as the medium that the options name. Throws Error, Cancelled.
std::unique_ptr<Scene> loadMediumScene(const SceneType& type, const SceneOptions& options, SimdTarget simd,
                                       Progress& progress);

}  // namespace stereonav
