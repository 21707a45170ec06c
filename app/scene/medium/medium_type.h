// The type of scenes for media that are built in.
#pragma once

#include "app/scene/type/scene_type.h"

namespace stereonav {

const SceneType& builtInMediumType();

}  // namespace stereonav
