// Facts of terrains: of a loaded one, for `info` and the report; of a file before it is loaded.
#pragma once

#include <optional>
#include <string>

#include "engine/base/progress.h"
#include "engine/scene/facts.h"
#include "engine/scene/scene.h"

namespace stereonav {

Facts factsOfTerrain(const Scene& scene);  // scene has to offer const TerrainScene

// Returns "curvature" for ground over a round Earth: its drop, the Earth's radius and the refraction. Returns
// nothing for other scenes.
std::optional<Fact> factOfCurvature(const Scene& scene);

// Reads a bounded number of bytes of an elevation model, or of the one that a scene file names. Throws Error,
// Cancelled.
Facts glanceAtTerrain(const std::string& file, Progress& progress);

}  // namespace stereonav
