// The rough centreline of one piece of lumen: its two farthest ends, and the cheapest way between them
// where a step costs more the nearer it is to the wall. Refined afterwards by centreline_refine.
#pragma once

#include <functional>
#include <vector>

#include "colon/segmentation/segmentation.h"
#include "engine/volume/distance_transform.h"

namespace stereonav {

// Returns a path of one or more voxels, each a neighbour of the one before it (engine/volume/voxel_path.h);
// it may begin at either end. mostUneven: CentrelineSetting::mostUneven. poll: called now and then; may
// throw. Throws Error when the piece has no voxel.
std::vector<glm::ivec3> roughCentreline(const LumenField& lumen, int segment, const DistanceVolume& distance,
                                        std::size_t mostUneven, const std::function<void()>& poll);

}  // namespace stereonav
