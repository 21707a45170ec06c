// Terrains for the commands.
#pragma once

#include "app/scene/scene_loading.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

GroundTiles tilesOf(TilesChoice choice);

// Returns the files that a .toml scene names. Throws Error.
std::vector<NamedPlace> filesOfTerrain(const std::string& toml);

// Reads or makes the terrain that the options name. Throws Error, Cancelled.
TerrainScene terrainOf(const SceneOptions& options, Progress& progress);
// Loads the same terrain as a scene whose rays are cast.
std::unique_ptr<Scene> loadTerrainScene(const SceneOptions& options, SimdTarget simd, Progress& progress);

}  // namespace stereonav
