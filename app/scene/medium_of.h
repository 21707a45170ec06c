// Media made from options: one function for each kind of source.
#pragma once

#include <memory>

#include "app/options/scene_options.h"
#include "app/scene/shown_medium.h"
#include "engine/base/progress.h"
#include "engine/math/constants.h"
#include "engine/simd/simd_target.h"
#include "engine/volume/volume.h"

namespace stereonav {

// Default direction of light for a viewer who looks north: from the left, behind and above.
constexpr double kLightAzimuth = 235 * kRadians, kLightElevation = 40 * kRadians;

// Sets the field under the transfer function that `shown` names, and its surface.
void putField(std::shared_ptr<const GreyVolume> field, Perturbation noise, MediumScene& shown);

// Set views, flight and medium of `scene`, which has not begun. Throw Error, Cancelled.
void makeFromTerrain(const SceneOptions& options, SimdTarget, Progress& progress, ShownMedium& scene);
void makeFromVolume(const SceneOptions& options, SimdTarget simd, Progress& progress, ShownMedium& scene);

}  // namespace stereonav
