// A terrain as the commands use it.
#pragma once

#include "app/scene/scene_loading.h"

namespace stereonav {

// The files that a .toml scene names. Throws Error.
std::vector<NamedPlace> filesOfTerrain(const std::string& toml);

// Reads or makes the terrain that the options name. Throws Error, Cancelled.
LoadedScene loadTerrainScene(const SceneOptions& options, SimdTarget simd, Progress& progress);

}  // namespace stereonav
