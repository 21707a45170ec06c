// What `info` says of a scene, as JSON and as lines.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/medium_scene.h"
#include "colon/colon_scene.h"
#include "terrain/terrain_scene.h"

namespace stereonav {

nlohmann::ordered_json terrainJson(const TerrainScene& terrain);
std::string terrainText(const TerrainScene& terrain);

nlohmann::ordered_json colonJson(const ColonScene& colon);
std::string colonText(const ColonScene& colon);

nlohmann::ordered_json mediumJson(const MediumScene& scene);
std::string mediumText(const MediumScene& scene);

// "  name        value\n"
std::string infoLine(const char* name, const std::string& value);

}  // namespace stereonav
