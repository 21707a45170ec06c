// What a file or a folder is before it is loaded, by its headers alone: kind, size, unit, spacing, values.
#pragma once

#include <string>

#include "engine/base/progress.h"
#include "engine/scene/facts.h"

namespace stereonav {

// A bounded read. scene: as sceneTypeNamed() takes it. Throws Error, one line, where it is none or is damaged
// so that its header says so; Cancelled.
Facts glanceAt(const std::string& scene, Progress& progress);

// Of single types.
Facts glanceAtMesh(const std::string& file, Progress& progress);
Facts glanceAtTerrain(const std::string& file, Progress& progress);
Facts glanceAtVolume(const std::string& file, Progress& progress);

}  // namespace stereonav
