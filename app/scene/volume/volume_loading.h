// CT studies for the commands: the way through a colon, or a surface seen from outside.
#pragma once

#include "app/scene/volume/shown_volume.h"
#include "colon/scene/colon_scene.h"

namespace stereonav {

// Returns how the colon is read. Throws Error for options that contradict each other.
ColonOptions colonOptionsOf(const SceneOptions& options);

// Reads or makes the study that the options name, with its light. keepsStudy: see ColonOptions. Throws Error,
// Cancelled.
LitVolume litVolumeOf(const SceneOptions& options, Progress& progress, bool keepsStudy = false);
// Loads the same study as a scene whose rays are cast.
std::unique_ptr<Scene> loadColonScene(const SceneOptions& options, SimdTarget simd, Progress& progress);

}  // namespace stereonav
