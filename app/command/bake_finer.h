// Light of a terrain at finer samples than those in memory, in a file next to that of the coarser light
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

// Returns the number of levels by which --resolution is finer; 0: none. Throws Error where the ground has no
// such level.
int finerLevels(const BakeOptions& options, const TerrainScene& terrain);

// Throws Error where other files occupy the places next to that file.
void checkFinerPlace(const std::filesystem::path& light);
// Removes the finer light of another bake. To be called once the light with `key` is in its place.
void removeFinerOfOthers(const std::filesystem::path& light, std::uint64_t key);

// Bakes with all processes; the first one has the light in `file`. Returns false where it was stopped;
// finished parts are kept. Throws Error.
bool bakeFiner(const TerrainScene& terrain, std::optional<TerrainLight> light,
               const TerrainLightSettings& settings, int finer, const std::filesystem::path& file,
               ProgressBar& bar, CommandResult& result);

}  // namespace stereonav
