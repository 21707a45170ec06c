// Baked light as the kernels of ray casters and sweeps read it.
#pragma once

#include "engine/volume/volume.h"
#include "engine/volume/volume_kernel_types.h"
#include "engine/volume/volume_look.h"

namespace stereonav {

// look.light must outlive it. frame: the grid in whose voxels the kernels name places. Without light: texels
// null.
BakedData bakedDataOf(const BakedLook& look, const VolumeFrame& frame);

}  // namespace stereonav
