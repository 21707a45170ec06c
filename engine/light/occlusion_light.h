// Openness as ambient light (Ruiz et al. 2010, eq. 5: C = k O C_TF), in the shape that ray casters look baked
// light up in: what the look's colour is multiplied with.
#pragma once

#include "engine/light/occlusion.h"
#include "engine/volume/illumination_volume.h"

namespace stereonav {

// A flat wall has half of its box open (see occlusion.h); with this k it is fully lit.
constexpr float kFlatWallGain = 2.0f;

// Texels at the voxels of `volume`, holding min(k * O, 1) in all channels, weight 1: only those of the cells
// whose values meet [lowest, highest] (values, ends included), so that whatever surface is shown within that
// range finds all eight texels around it; bricks of texels without such a voxel take no memory. Nothing for
// volumes of less than 2 voxels along an axis. openness: of the same size, as estimateOpenness gives it;
// throws Error where it is not, or k is not a number above 0.
IlluminationVolume ambientLight(const GreyVolume& volume, const OpennessVolume& openness, double lowest,
                                double highest, float k = kFlatWallGain);

}  // namespace stereonav
