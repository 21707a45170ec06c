// Ambient light and opacity modulation of a volume by the neighbourhood of each voxel (Ruiz et al. 2010), set
// in its look from options.
#pragma once

#include <optional>
#include <string>

#include "app/options/occlusion_words.h"
#include "app/options/scene_options.h"
#include "colon/scene/colon_scene.h"
#include "engine/base/progress.h"
#include "engine/light/occlusion/occlusion_modulation.h"

namespace stereonav {

// Returns whether opacity is modulated.
bool modulates(const VolumeOptions& options);
// Returns the radius of the modulation in metres: as given, that of --ambient, or ten voxels.
double modulationRadius(const VolumeOptions& options, const VolumeFrame& frame);

// Sets ambient light in the scene's look and changes nothing else. Opacity modulation uses the look's
// transfer function. Parts of the look are computed again only where the options differ from `made`, those of
// the present look; null: the look has none. Throws Error, Cancelled.
void applyAmbient(const VolumeOptions& options, const VolumeOptions* made, ColonScene& scene,
                  Progress& progress);
// Sets the modulation and returns its sigma, given or chosen; empty: no modulation. sigma: that of the
// present look.
std::optional<double> applyModulation(const VolumeOptions& options, const VolumeOptions* made,
                                      const std::optional<double>& sigma, ColonScene& scene,
                                      Progress& progress);

}  // namespace stereonav
