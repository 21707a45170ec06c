// Stands in for volume light where the program is built without it: everything that needs it says so.

#include <nlohmann/json.hpp>

#include "app/built_without.h"
#include "app/info_text.h"
#include "app/medium_loading.h"
#include "app/medium_options.h"
#include "engine/medium/medium_transfer.h"

namespace stereonav {
namespace {

[[noreturn]] void without() {
    throwBuiltWithout("volume light", "STEREONAV_MEDIUM");
}

}  // namespace

LoadedScene loadMediumScene(const SceneOptions&, SimdTarget, Progress&) {
    without();
}

void addMedium(const LoadedScene&, ViewScene&) {
    without();
}

bool showsMedium(const SceneOptions& options) {
    return options.medium.any() || kindOf(options.scene) == SceneKind::Medium;
}

void checkMediumOptions(const SceneOptions& options) {
    if (showsMedium(options)) without();
}

nlohmann::ordered_json mediumJson(const LoadedScene&) {
    without();
}

std::string mediumText(const LoadedScene&) {
    without();
}

std::string mediumPresetNames() {
    return "none";
}

}  // namespace stereonav
