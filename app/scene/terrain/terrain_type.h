// The type of scenes for terrain: elevation models, scene files that name one, and the built-in terrain.
#pragma once

#include "app/scene/type/scene_type.h"

namespace stereonav {

const SceneType& terrainType();

}  // namespace stereonav
