// Stands in for terrain where the program is built without it: everything that needs it says so.
#include <nlohmann/json.hpp>

#include "app/command/bake_terrain.h"
#include "app/command/info_text.h"
#include "app/options/built_without.h"
#include "app/scene/medium_of.h"
#include "app/scene/terrain_loading.h"

namespace stereonav {
namespace {

[[noreturn]] void without() {
    throwBuiltWithout("terrain", "STEREONAV_TERRAIN");
}

}  // namespace

std::unique_ptr<Scene> loadTerrainScene(const SceneOptions&, SimdTarget, Progress&) {
    without();
}

std::vector<NamedPlace> filesOfTerrain(const std::string&) {
    without();
}

int bakeTerrain(const BakeOptions&) {
    without();
}

int runMesh(const MeshOptions&) {
    without();
}

nlohmann::ordered_json terrainJson(const Scene&) {
    without();
}

std::string terrainText(const Scene&) {
    without();
}

void makeFromTerrain(const SceneOptions&, Progress&, ShownMedium&) {
    without();
}

}  // namespace stereonav
