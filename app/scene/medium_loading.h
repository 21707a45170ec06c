// Media as the commands use them: built in, volumes and the colon under --medium, terrain as a height volume.
#pragma once

#include "app/scene/scene_loading.h"
#include "app/view/worker.h"

namespace stereonav {

// What the options name, as showsMedium() knows it. Throws Error, Cancelled.
LoadedScene loadMediumScene(const SceneOptions& options, SimdTarget simd, Progress& progress);

// What the viewer can do with a medium beyond flying through it. scene.medium is there and outlives `view`.
void addMedium(const LoadedScene& scene, ViewScene& view);

}  // namespace stereonav
