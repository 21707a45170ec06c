// Refusal of options that do not apply: all are reported together, each with the reason and what to do.
#pragma once

#include <optional>
#include <string>

#include "app/options/scene_options.h"
#include "app/options/scene_types.h"

namespace stereonav {

// Throws Error with one line that names every option that conflicts with the scene, with another option, or
// with what another option chooses. type: the scene's; 0: a command without a scene.
void refuseWhatDoesNotApply(const GivenOptions& given, SceneSet type, const std::string& scene);

// Checks the options of a scene in the same way. Does nothing without a type, where the scene's name stands
// for no scene: that is reported when the scene is loaded.
void refuseWhatDoesNotApply(const SceneOptions& options, std::optional<SceneSet> type);

}  // namespace stereonav
