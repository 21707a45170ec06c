// Facts of a file or folder from its headers alone, before it is loaded: kind, size, unit, spacing, values.
#pragma once

#include <string>

#include "engine/base/progress.h"
#include "engine/scene/facts.h"

namespace stereonav {

// Reads a bounded number of bytes. scene: see sceneTypeNamed(). Throws Error, one line, where the file is of
// no known type or its header is damaged; Cancelled.
Facts glanceAt(const std::string& scene, Progress& progress);

}  // namespace stereonav
