// Stands in for terrain where the program is built without it: everything that needs it says so.
#include <filesystem>

#include "app/command/scene_facts.h"
#include "app/options/built_without.h"
#include "app/scene/scene_type.h"

namespace stereonav {
namespace {

[[noreturn]] void without() {
    throwBuiltWithout("terrain", "STEREONAV_TERRAIN");
}

}  // namespace

const SceneType& terrainType() {
    static const SceneType type{
        .noun = "terrain",
        .builtIn = {"", "terrain"},
        .owns = [](const std::string& file) { return !std::filesystem::is_directory(file); },
        .optionsFor = [](const std::string&) { return scene_type::kTerrains; },
        .load = [](const SceneOptions&, SimdTarget, Progress&) -> std::unique_ptr<Scene> { without(); },
        .makeMedium = [](const SceneOptions&, SimdTarget, Progress&, ShownMedium&) { without(); },
        .bake = [](const BakeOptions&) -> int { without(); },
        .hasGround = true};
    return type;
}

std::optional<Fact> factOfCurvature(const Scene&) {
    return std::nullopt;
}

int runMesh(const MeshOptions&) {
    without();
}

int runViewshed(const ViewshedOptions&) {
    without();
}

int runMeasure(const MeasureOptions&) {
    without();
}

int runProfile(const ProfileOptions&) {
    without();
}

int runSun(const SunOptions&) {
    without();
}

}  // namespace stereonav
