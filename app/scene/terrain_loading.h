// A terrain as the commands use it.
#pragma once

#include "app/scene/scene_loading.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

GroundTiles tilesOf(TilesChoice choice);

// The files that a .toml scene names. Throws Error.
std::vector<NamedPlace> filesOfTerrain(const std::string& toml);

// Reads or makes the terrain that the options name. Throws Error, Cancelled.
TerrainScene terrainOf(const SceneOptions& options, Progress& progress);
// The same as a scene whose rays are cast.
std::unique_ptr<Scene> loadTerrainScene(const SceneOptions& options, SimdTarget simd, Progress& progress);

}  // namespace stereonav
