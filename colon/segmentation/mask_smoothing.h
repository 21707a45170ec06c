// A ready mask's wall without stairs: the field of the wall that lies half way between voxel centres, made to
// bend evenly. Figures of tests/colon/mask_smoothing_test.cpp hold for it: no voxel changes its side, the
// wall moves by less than half a voxel along each axis, and what it encloses keeps its volume.
#pragma once

#include <optional>

#include "engine/base/progress.h"
#include "engine/volume/components.h"
#include "engine/volume/volume.h"

namespace stereonav {

// Metres along the wall over which bends are averaged; 0: the mask is not smoothed; nothing: two voxels.
using MaskSmoothing = std::optional<double>;

// The most that is averaged over, in voxels of the coarsest spacing: more counts as this.
constexpr double kMostSmoothed = 4;

// Returns the metres that are smoothed over in a mask of this frame; 0: nothing is.
double smoothedLength(const MaskSmoothing& smoothing, const VolumeFrame& frame);

// Fills `field` (all 0, of the size of `inside`): below kMaskWall exactly in `inside`. length: as
// smoothedLength() has it, > 0. Beyond the grid is nothing: where `inside` reaches its faces the wall is
// open. On all threads, whose number changes nothing. Throws Error where memory is short, Cancelled.
void smoothWall(const VoxelRuns& inside, double length, GreyVolume& field, Progress& progress);

}  // namespace stereonav
