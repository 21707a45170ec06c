// The types of scenes, and which of them a name stands for. A new type is a SceneType in a file of its own
// and a line in the table.
#pragma once

#include <span>
#include <string>

#include "app/scene/type/scene_type.h"

namespace stereonav {

std::span<const SceneType* const> sceneTypes();

// Returns whether the name is that of a built-in scene, even if a file in the working folder has it too.
bool isBuiltIn(const std::string& name);

// Returns the type of a scene by its name. Throws Error for an unknown name, with the names that are
// possible.
const SceneType& sceneTypeNamed(const std::string& name);

}  // namespace stereonav
