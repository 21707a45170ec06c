// Light of a volume from options: baked light, or one of the models that it is compared with.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/options/scene_options.h"
#include "colon/scene/colon_scene.h"
#include "engine/base/progress.h"
#include "engine/light/transfer/turning_sky.h"

namespace stereonav {

// Sets --light, --sky, --turn, --exposure and --shading in the scene's look (--ambient and --modulate: see
// ambient.h). Returns the sky where it can turn and options.skyTurns is set; else null. Throws Error,
// Cancelled.
std::shared_ptr<TurningSky> applyVolumeLight(const SceneOptions& options, ColonScene& scene,
                                             Progress& progress);

// Returns the harmonics of --sky, or of an overcast sky, before they are turned. Throws Error.
std::vector<glm::vec3> skyHarmonics(const SceneOptions& options, int order);
// Returns the turn of the sky given by --turn.
SkyTurn skyTurnOf(const SceneOptions& options);

// Returns the factor on light of this mean over the known texels, on white: --exposure, or the one that shows
// the mean well; 1 where there is no light.
float exposureOf(const VolumeOptions& options, double meanLight);

}  // namespace stereonav
