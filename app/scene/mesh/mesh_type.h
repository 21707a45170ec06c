// The type of scenes for meshes: glTF files.
#pragma once

#include "app/scene/type/scene_type.h"

namespace stereonav {

const SceneType& meshType();

}  // namespace stereonav
