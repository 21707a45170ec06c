// Baked light as the kernels of ray casters and sweeps read it.
#pragma once

#include "engine/volume/volume.h"
#include "engine/volume/volume_kernel_types.h"
#include "engine/volume/volume_look.h"

namespace stereonav {

// Returns the look's light as kernels read it. look.light must outlive the result. frame: the grid in whose
// voxels the kernels name places. Without light: texels null.
BakedData bakedDataOf(const BakedLook& look, const VolumeFrame& frame);

// Returns the look's exposure as it is shown: 0 for what is no number or negative, at most kMostExposure.
float shownExposure(const BakedLook& look);

// Returns light at a point of the world by the look's own lookup, before the exposure: what kernels and
// shaders must agree with. Where texels are not known, light of look.beyond as far as they are not. field and
// isovalue (in stored numbers): for NearestIsovalue. Weight 0: nothing is known.
IlluminationVolume::Light bakedLightAt(const BakedLook& look, const glm::dvec3& world,
                                       const GreyVolume* field = nullptr, float isovalue = 0);

}  // namespace stereonav
