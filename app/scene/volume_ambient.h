// Ambient light and opacity modulation of a volume by what surrounds each voxel (Ruiz et al. 2010), from
// options into its look.
#pragma once

#include <optional>
#include <string>

#include "app/options/occlusion_words.h"
#include "app/options/scene_options.h"
#include "colon/scene/colon_scene.h"
#include "engine/base/progress.h"
#include "engine/light/occlusion/occlusion_modulation.h"

namespace stereonav {

// Whether opacity is modulated.
bool modulates(const VolumeOptions& options);
// Metres that the modulation looks around: as given, or --ambient's, or ten voxels.
double modulationRadius(const VolumeOptions& options, const VolumeFrame& frame);

// Into the scene's look, and that is all that it changes. Opacity modulation looks at the look's transfer
// function. What the look has already is made again only where the options differ from `made`, those that it
// was made from; null: nothing is there. Throws Error, Cancelled.
void applyAmbient(const VolumeOptions& options, const VolumeOptions* made, ColonScene& scene,
                  Progress& progress);
// Gives the sigma, given or chosen; none: not modulated. sigma: that of what is there.
std::optional<double> applyModulation(const VolumeOptions& options, const VolumeOptions* made,
                                      const std::optional<double>& sigma, ColonScene& scene,
                                      Progress& progress);

}  // namespace stereonav
