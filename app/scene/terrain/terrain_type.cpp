#include "app/scene/terrain/terrain_type.h"

#include <filesystem>

#include "app/scene/terrain/medium_of_terrain.h"
#include "app/scene/terrain/terrain_facts.h"
#include "app/scene/terrain/terrain_loading.h"
#include "terrain/raster/elevation_folder.h"

namespace stereonav {
namespace {

// Accepts any file, and folders of elevation files.
bool isAnyFile(const std::string& file) {
    std::error_code code;
    return !std::filesystem::is_directory(file, code) || !elevationFilesIn(file).empty();
}

std::vector<NamedPlace> filesOfScene(const SceneOptions& options) {
    auto files = options.scene.ends_with(".toml") ? filesOfTerrain(options.scene) : std::vector<NamedPlace>{};
    files.push_back({"--tracks", options.ground.tracks});
    files.push_back({"--follow", options.ground.follow});
    return files;
}

}  // namespace

const SceneType& terrainType() {
    static const SceneType type{.noun = "terrain",
                                .builtIn = {"", "terrain"},
                                .owns = isAnyFile,
                                .optionsFor = [](const std::string&) { return scene_type::kTerrains; },
                                .filesOf = filesOfScene,
                                .glance = glanceAtTerrain,
                                .load = loadTerrainScene,
                                .makeMedium = makeFromTerrain,
                                .hasGround = true};
    return type;
}

}  // namespace stereonav
