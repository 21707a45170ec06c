// Options that do not apply: all are told together, each with the reason and what to do.
#pragma once

#include <optional>
#include <string>

#include "app/options/scene_options.h"
#include "app/options/scene_types.h"

namespace stereonav {

// type: the scene's; 0: a command without one. Throws Error with one line, naming every option of the table
// that does not go with the scene, with another option that was given, or with what another one chooses.
void refuseWhatDoesNotApply(const GivenOptions& given, SceneSet type, const std::string& scene);

// Checks what SceneOptions hold in the same way. Does nothing without a type, where the scene's name stands
// for none: that is told when it is loaded.
void refuseWhatDoesNotApply(const SceneOptions& options, std::optional<SceneSet> type);

}  // namespace stereonav
