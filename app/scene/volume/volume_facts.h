// Facts of volumes: of a loaded one, for `info` and the report; of a file before it is loaded.
#pragma once

#include <string>

#include "engine/base/progress.h"
#include "engine/scene/facts.h"
#include "engine/scene/scene.h"

namespace stereonav {

Facts factsOfVolume(const Scene& scene);  // scene has to offer const ColonScene

// Reads a bounded number of bytes of a study. Throws Error, Cancelled.
Facts glanceAtVolume(const std::string& file, Progress& progress);

}  // namespace stereonav
