// Light of a studio as the kernels of ray casters read it.
#pragma once

#include "engine/volume/volume_kernel_types.h"
#include "engine/volume/volume_look.h"

namespace stereonav {

// Returns the look's light as kernels read it: words null where it is not shown. look.studio.seen must
// outlive the result. frame: the grid in whose voxels the kernels name places.
StudioData studioDataOf(const VolumeLook& look, const VolumeFrame& frame);

}  // namespace stereonav
