#include "terrain/terrain_scene.h"

#include "terrain/landmark.h"

namespace stereonav {

TerrainScene::TerrainScene() = default;
TerrainScene::~TerrainScene() = default;
TerrainScene::TerrainScene(TerrainScene&&) noexcept = default;
TerrainScene& TerrainScene::operator=(TerrainScene&&) noexcept = default;

}  // namespace stereonav
