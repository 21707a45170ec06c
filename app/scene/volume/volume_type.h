// The type of scenes for volumes: CT studies, and the built-in colon.
#pragma once

#include "app/scene/type/scene_type.h"

namespace stereonav {

const SceneType& volumeType();

}  // namespace stereonav
