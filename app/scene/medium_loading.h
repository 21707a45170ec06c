// Media for the commands: built in, volumes and the colon under --medium, terrain as a height volume.
#pragma once

#include "app/scene/scene_loading.h"
#include "app/scene/scene_type.h"

namespace stereonav {

// Loads a scene of this type as the medium that the options name. Throws Error, Cancelled.
std::unique_ptr<Scene> loadMediumScene(const SceneType& type, const SceneOptions& options, SimdTarget simd,
                                       Progress& progress);

}  // namespace stereonav
