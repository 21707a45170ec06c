#include "terrain/scene/terrain_scene.h"

#include "terrain/scene/landmark.h"
#include "terrain/scene/terrain_illumination.h"

namespace stereonav {

TerrainScene::TerrainScene() = default;
TerrainScene::~TerrainScene() = default;
TerrainScene::TerrainScene(TerrainScene&&) noexcept = default;
TerrainScene& TerrainScene::operator=(TerrainScene&&) noexcept = default;

}  // namespace stereonav
