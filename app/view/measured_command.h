// The measured line in the form that the commands `measure` and `profile` take.
#pragma once

#include <string>

#include "app/view/measured_line.h"
#include "engine/scene/scene.h"

namespace stereonav {

// Returns "--line=x,y,..." in the reference system of the scene's file; "" where the scene has no such
// commands, or a place has no coordinates.
std::string measuredWords(const Scene& scene, const MeasuredLine& line);

}  // namespace stereonav
