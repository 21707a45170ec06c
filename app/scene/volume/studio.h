// Light of a volume seen from outside where nothing else is said: a sky, a key light beside the viewer's
// first place, and the lamp.
#pragma once

#include "app/options/scene_options.h"
#include "colon/scene/colon_scene.h"
#include "engine/base/progress.h"

namespace stereonav {

// Sets the light in the scene's look, or none where options say what lights it, for a colon, and where memory
// is short (with a note). before: the scene of the same study that this one is derived from, whose light is
// kept where it shows the same; null: none. Throws Cancelled.
void applyStudio(const SceneOptions& options, const ColonScene* before, ColonScene& scene,
                 Progress& progress);

}  // namespace stereonav
