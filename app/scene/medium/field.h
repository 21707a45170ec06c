// A field of values as a medium, and the light that it has by default.
#pragma once

#include <memory>

#include "engine/math/constants.h"
#include "engine/medium/sweep/medium_scene.h"
#include "engine/volume/volume.h"

namespace stereonav {

// Default direction of light for a viewer who looks north: from the left, behind and above.
constexpr double kLightAzimuth = 235 * kRadians, kLightElevation = 40 * kRadians;

// Sets the field under the transfer function that `shown` names, and its surface.
void putField(std::shared_ptr<const GreyVolume> field, Perturbation noise, MediumScene& shown);

}  // namespace stereonav
