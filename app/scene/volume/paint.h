// Paint on a colon's wall as the options ask for it.
#pragma once

#include <memory>
#include <vector>

#include "app/options/scene_options.h"
#include "app/scene/volume/world.h"
#include "engine/base/progress.h"
#include "engine/render/eye_painter.h"

namespace stereonav {

// Returns whether the paint needs the study's own values (ColonScene::study).
bool paintNeedsStudy(const SceneOptions& options);

// Returns the painters in their order; none where nothing is asked for. verticalFov: of the pictures,
// radians. Adds to the colon's notes how much is painted. Throws Error (no colon; no study), Cancelled.
std::vector<std::shared_ptr<const EyePainter>> wallPainters(VolumeWorld& world, const SceneOptions& options,
                                                            double verticalFov, Progress& progress);

}  // namespace stereonav
