// How a volume is lit, from options: baked light, or one of the models it is compared with.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/options/scene_options.h"
#include "colon/scene/colon_scene.h"
#include "engine/base/progress.h"
#include "engine/light/transfer/turning_sky.h"

namespace stereonav {

// --light, --sky, --turn, --exposure and --shading into the scene's look (--ambient and --modulate: see
// volume_ambient.h). Gives the sky, where it is one that turns and options.skyTurns; else null. Throws Error,
// Cancelled.
std::shared_ptr<TurningSky> applyVolumeLight(const SceneOptions& options, ColonScene& scene,
                                             Progress& progress);

// The harmonics of --sky, or of an overcast one, before they are turned. Throws Error.
std::vector<glm::vec3> skyHarmonics(const SceneOptions& options, int order);
// --turn.
SkyTurn skyTurnOf(const SceneOptions& options);

// Factor on light whose mean over what is known (of white) is this: --exposure, else such that the mean is
// shown well; 1 where there is no light.
float exposureOf(const VolumeOptions& options, double meanLight);

}  // namespace stereonav
