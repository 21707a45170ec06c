#include "app/scene/file_glance.h"

#include <filesystem>

#include "app/options/scene_file_options.h"
#include "app/scene/scene_type_table.h"

namespace stereonav {
namespace {

// Returns the scene that a scene file names; "" for a terrain's scene file and for other files.
std::string namedIn(const std::string& scene) {
    return std::filesystem::path(scene).extension() == ".toml" ? readSceneFileOptions(scene).scene : "";
}

Facts factsOfKind(const SceneType& type, const std::string& scene) {
    return {factForText("kind", std::string(type.noun) + (isBuiltIn(scene) ? ", built in" : ""))};
}

}  // namespace

Facts glanceAt(const std::string& scene, Progress& progress) {
    constexpr const char* kLooking = "looking";
    progress.report(0, kLooking);
    const SceneType& type = sceneTypeNamed(scene);  // throws where nothing has this name
    const std::string named = namedIn(scene);
    if (!named.empty()) {
        Facts facts{factForText("kind", "scene of " + std::filesystem::path(named).filename().string())};
        const Facts inside = glanceAt(named, progress);
        facts.insert(facts.end(), inside.begin(), inside.end());
        return facts;
    }
    Facts facts = factsOfKind(type, scene);
    if (type.glance && !isBuiltIn(scene)) {
        const Facts more = type.glance(scene, progress);
        facts.insert(facts.end(), more.begin(), more.end());
    }
    progress.report(1, kLooking);
    return facts;
}

}  // namespace stereonav
