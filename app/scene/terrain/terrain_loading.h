// Terrains for the commands.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/options/output_place.h"
#include "app/options/scene_options.h"
#include "engine/base/progress.h"
#include "engine/scene/scene.h"
#include "engine/simd/simd_target.h"
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
