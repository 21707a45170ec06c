// Facts of meshes: of a loaded one, for `info` and the report; of a file before it is loaded.
#pragma once

#include <string>

#include "engine/base/progress.h"
#include "engine/scene/facts.h"
#include "engine/scene/scene.h"

namespace stereonav {

Facts factsOfMesh(const Scene& scene);  // scene has to offer const MeshRenderer

// Reads the description of a glTF file alone. Throws Error, Cancelled.
Facts glanceAtMesh(const std::string& file, Progress& progress);

}  // namespace stereonav
