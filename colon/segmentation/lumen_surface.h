// The wall of a ready mask as --look plain shows it: a wide kernel, while every voxel centre keeps its side.
// Walls of high curvature move inwards by up to half a voxel, and septa thinner than three voxels become
// ragged (mask_smoothing.h does better).
#pragma once

#include "engine/base/progress.h"
#include "engine/volume/components.h"
#include "engine/volume/volume.h"

namespace stereonav {

// Numbers like Hounsfield units. Outside is 0, water, so that pages far from the lumen are never taken.
constexpr int kMaskInside = -1000, kMaskOutside = 0, kMaskWall = -500;

struct WideSmoothing {
    // Standard deviation of the Gaussian that a round is made of, smallest spacings; > 0. Normals of
    // voxelised spheres of 5, 12 and 25 voxels, of tubes of 8 and 20 and of planes rising 1:8 are off by 5.8,
    // 1.8, 1.2, 2.1, 1.5 and 2.9 degrees on average; with 1.5: 2.9, 2.2, 2.1, 3.2, 3.0, 6.5; with 3: 15, 3.6,
    // 1.5, 3.3, 1.4, 0.9. A plain Gaussian of 1.5: 6.3, 2.3, 1.8, 2.9, 2.4, 4.9.
    double sigma = 2.2;
    int rounds = 1;      // >= 1
    double margin = 10;  // HU that voxel centres keep from kMaskWall, on their side of it; > 0
};

// Fills `field` (all 0, of the size of `inside`): below kMaskWall exactly in `inside`. Throws Cancelled.
void smoothMask(const VoxelRuns& inside, const WideSmoothing& setting, GreyVolume& field, Progress& progress);

}  // namespace stereonav
