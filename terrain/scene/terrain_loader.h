// Makes a terrain that can be cast from a scene description.
#pragma once

#include "engine/base/progress.h"
#include "terrain/read/scene_file.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

// Loads a terrain: reads, checks, projects, fills, colours. Throws Error with file and place; Cancelled.
TerrainScene loadTerrain(const SceneFile& scene, Progress& progress);

}  // namespace stereonav
