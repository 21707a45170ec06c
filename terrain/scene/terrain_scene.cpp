#include "terrain/scene/terrain_scene.h"

#include "terrain/scene/fine_heights.h"
#include "terrain/scene/landmark.h"
#include "terrain/scene/terrain_illumination.h"

namespace stereonav {

TerrainScene::TerrainScene() = default;
TerrainScene::~TerrainScene() = default;
TerrainScene::TerrainScene(TerrainScene&&) noexcept = default;
TerrainScene& TerrainScene::operator=(TerrainScene&&) noexcept = default;

double TerrainScene::heightAt(const glm::dvec2& world) const {
    return tiled ? tiled->fine->heightAt(world) : ground.heightAt(world);
}

}  // namespace stereonav
