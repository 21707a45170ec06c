// The rough centreline of one piece of lumen: its two farthest ends, and the cheapest way between them
// where a step costs more the nearer it is to the wall. Refined afterwards by centreline_refine.
#pragma once

#include <functional>
#include <vector>

#include "colon/segmentation.h"
#include "engine/volume/distance_transform.h"

namespace stereonav {

// Voxels, each a neighbour of the one before it (engine/volume/voxel_path.h), one or more. The first is the
// end that is more likely the lower one (see lowerEndFirst). Throws Error when the piece has no voxel.
std::vector<glm::ivec3> roughCentreline(const LumenField& lumen, int segment, const DistanceVolume& distance,
                                        const std::function<void()>& poll);

// True if the way from a to b (world, metres) runs from the rectum upwards: a is lower, or, where their
// heights differ by less than a tenth of `height`, further back.
bool lowerEndFirst(const glm::dvec3& a, const glm::dvec3& b, double height);

}  // namespace stereonav
