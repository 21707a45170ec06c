#include "terrain/terrain_scene.h"

#include "terrain/landmark.h"
#include "terrain/terrain_illumination.h"

namespace stereonav {

TerrainScene::TerrainScene() = default;
TerrainScene::~TerrainScene() = default;
TerrainScene::TerrainScene(TerrainScene&&) noexcept = default;
TerrainScene& TerrainScene::operator=(TerrainScene&&) noexcept = default;

}  // namespace stereonav
