// A terrain as the commands use it.
#pragma once

#include "app/scene_loading.h"

namespace stereonav {

// Reads or makes the terrain that the options name. Throws Error, Cancelled.
LoadedScene loadTerrainScene(const SceneOptions& options, SimdTarget simd, Progress& progress);

}  // namespace stereonav
