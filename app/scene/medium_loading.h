// Media as the commands use them: built in, volumes and the colon under --medium, terrain as a height volume.
#pragma once

#include "app/scene/scene_loading.h"

namespace stereonav {

// What the options name, as showsMedium() knows it. Throws Error, Cancelled.
std::unique_ptr<Scene> loadMediumScene(const SceneOptions& options, SimdTarget simd, Progress& progress);

}  // namespace stereonav
