// A CT study as the commands use it: the way through a colon, or a surface seen from outside.
#pragma once

#include "app/scene/scene_loading.h"
#include "app/view/worker.h"
#include "colon/colon_scene.h"

namespace stereonav {

// Throws Error for what does not fit together.
ColonOptions colonOptionsOf(const SceneOptions& options);

// Reads or makes the study that the options name. Throws Error, Cancelled.
LoadedScene loadColonScene(const SceneOptions& options, SimdTarget simd, Progress& progress);

// The same study seen as the options say, whose isovalue, transfer function, opacity, ambient light and
// opacity modulation may differ from those that `now` was made with, `made`. Nothing is read again; what is
// large and still holds is shared, light that is worked out while one flies goes on. Throws Error, Cancelled.
LoadedScene changedColonScene(const LoadedScene& now, const SceneOptions& made, const SceneOptions& options,
                              Progress& progress);

// Throws Error naming `file` where a pose lies outside the lumen; any path goes around what is no colon.
void checkInLumen(const ColonScene& colon, const RecordedPath& path, const std::string& file);

// What the viewer can do with a volume beyond flying through it. scene.colon is there and outlives `view`.
void addVolume(const LoadedScene& scene, const SceneOptions& options, ViewScene& view);

}  // namespace stereonav
