// The type of scenes for meshes: glTF files.
#pragma once

#include "app/scene/type_of_scene.h"

namespace stereonav {

const SceneType& meshType();

}  // namespace stereonav
