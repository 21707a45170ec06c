// Stands in for volume light where the program is built without it: everything that needs it says so.

#include "app/options/built_without.h"
#include "app/scene/medium_loading.h"
#include "app/scene/medium_of.h"
#include "app/scene/medium_options.h"
#include "app/view/sweep.h"
#include "engine/medium/model/medium_transfer.h"

namespace stereonav {
namespace {

[[noreturn]] void without() {
    throwBuiltWithout("volume light", "STEREONAV_MEDIUM");
}

}  // namespace

std::unique_ptr<Scene> loadMediumScene(const SceneType&, const SceneOptions&, SimdTarget, Progress&) {
    without();
}

void makeFromTerrain(const SceneOptions&, SimdTarget, Progress&, ShownMedium&) {
    without();
}

void makeFromVolume(const SceneOptions&, SimdTarget, Progress&, ShownMedium&) {
    without();
}

const SceneType& builtInMediumType() {
    static const SceneType type{.noun = "medium",
                                .builtIn = {"cloud", "wax"},
                                .optionsFor = [](const std::string&) { return scene_type::kBuiltInMedium; }};
    return type;
}

void checkMediumOptions(const SceneOptions&) {
    without();
}

ViewSweep::ViewSweep(SweepChoice choice) : mChoice(choice) {
    without();
}

ViewSweep::~ViewSweep() = default;

void ViewSweep::use(const Scene&) {
    without();
}

std::string ViewSweep::takeNotice() {
    return "";
}

std::string mediumPresetNames() {
    return "none";
}

}  // namespace stereonav
