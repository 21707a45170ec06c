// The wall of a ready mask: a field whose isosurface follows the mask without its stairs.
#pragma once

#include "engine/base/progress.h"
#include "engine/volume/components.h"
#include "engine/volume/volume.h"

namespace stereonav {

// Numbers like Hounsfield units. Outside is 0, water, so that pages far from the lumen are never taken.
constexpr int kMaskInside = -1000, kMaskOutside = 0, kMaskWall = -500;

struct MaskSmoothing {
    // Of one round, in the smallest spacing; > 0. Normals of voxelised spheres of 12 and 25 voxels and of
    // planes rising 1:8 are off by 1.9, 1.4 and 4.5 degrees on average; with 1.2: 2.2, 1.9, 6.1;
    // with 2.2: 2.9, 1.4, 1.9, but 7.2 instead of 3.8 on a sphere of 5.
    double sigma = 1.5;
    int rounds = 1;      // >= 1
    double margin = 10;  // HU that voxel centres keep from kMaskWall, on their side of it; > 0
};

// Fills `field` (all 0, of the size of `inside`): below kMaskWall exactly in `inside`. Throws Cancelled.
void smoothMask(const VoxelRuns& inside, const MaskSmoothing& setting, GreyVolume& field, Progress& progress);

}  // namespace stereonav
