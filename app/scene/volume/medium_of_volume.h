// A study as a medium: a colon from inside, lit by a lamp at the head, or any other volume from outside.
#pragma once

#include "app/options/scene_options.h"
#include "app/scene/medium/shown_medium.h"
#include "engine/base/progress.h"
#include "engine/simd/simd_target.h"

namespace stereonav {

// Sets views, flight and medium of `scene`, which has not begun. Throws Error, Cancelled.
void makeFromVolume(const SceneOptions& options, SimdTarget simd, Progress& progress, ShownMedium& scene);

}  // namespace stereonav
