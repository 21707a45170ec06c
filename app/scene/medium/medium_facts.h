// Facts of media for `info` and the report.
#pragma once

#include "engine/scene/facts.h"
#include "engine/scene/scene.h"

namespace stereonav {

// Returns the facts of a scene that offers MediumScene. Makes a frame at the start pose, for the sweep's
// memory.
Facts factsOfMedium(const Scene& scene);

}  // namespace stereonav
