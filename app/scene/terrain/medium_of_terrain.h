// Terrain as a medium: its ground as a layer, in its own colours or under a transfer function.
#pragma once

#include "app/options/scene_options.h"
#include "app/scene/medium/shown_medium.h"
#include "engine/base/progress.h"
#include "engine/simd/simd_target.h"

namespace stereonav {

// Sets views, flight and medium of `scene`, which has not begun. Throws Error, Cancelled.
void makeFromTerrain(const SceneOptions& options, SimdTarget, Progress& progress, ShownMedium& scene);

}  // namespace stereonav
