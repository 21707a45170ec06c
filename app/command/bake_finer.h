// Light of a terrain at finer samples than those in memory, into a file beside the light of these
// (terrain/light/fine_bake.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "app/options/bake_options.h"
#include "app/output/command_result.h"
#include "app/output/progress_bar.h"
#include "terrain/light/terrain_light.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

// How many levels finer --resolution asks for; 0: none. Throws Error where the ground has none.
int finerLevels(const BakeOptions& options, const TerrainScene& terrain);

// Throws Error where something else is in the way of what would lie beside that file.
void checkFinerPlace(const std::filesystem::path& light);
// Once the light with that key lies there: what goes on from another.
void removeFinerOfOthers(const std::filesystem::path& light, std::uint64_t key);

// By all processes, of which the first has the light that lies in `file`. False where it was stopped; what is
// done is kept. Throws Error.
bool bakeFiner(const TerrainScene& terrain, std::optional<TerrainLight> light,
               const TerrainLightSettings& settings, int finer, const std::filesystem::path& file,
               ProgressBar& bar, CommandResult& result);

}  // namespace stereonav
