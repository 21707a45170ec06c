// The field of a wall whose crossings are known: distances to it, near it.
#pragma once

#include "colon/segmentation/wall_crossings.h"
#include "engine/base/progress.h"
#include "engine/volume/volume.h"

namespace stereonav {

// Fills `field` (all 0, of the size of `inside`) with numbers as smoothMask does: below kMaskWall exactly in
// `inside`, and kMaskWall at the crossings, within what one number for each voxel can say. normals: of the
// crossings (wallNormals). On all threads. Throws Cancelled.
void fillWallField(const VoxelRuns& inside, const WallCrossings& wall, const std::vector<glm::vec3>& normals,
                   GreyVolume& field, Progress& progress);

}  // namespace stereonav
