// What `info` says of a scene, as JSON and as lines.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/scene/scene_loading.h"

namespace stereonav {

// Of one that offers const TerrainScene.
nlohmann::ordered_json terrainJson(const Scene& scene);
std::string terrainText(const Scene& scene);

// Of one that offers const ColonScene.
nlohmann::ordered_json colonJson(const Scene& scene);
std::string colonText(const Scene& scene);

// What holds how much memory; nothing that the scene does not have is named.
struct Held {
    std::string what;
    std::size_t bytes = 0;
};
nlohmann::ordered_json heldJson(const std::vector<Held>& held);
// "32.1 MB: values 20.0, cells 12.1"
std::string heldText(const std::vector<Held>& held);
std::size_t bytesOf(const std::vector<Held>& held);

// Of one that offers MediumScene: make a frame at the start pose, for what the sweep then holds.
nlohmann::ordered_json mediumJson(const Scene& scene);
std::string mediumText(const Scene& scene);

// "  name        value\n"
std::string infoLine(const char* name, const std::string& value);

}  // namespace stereonav
