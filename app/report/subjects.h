// Small subjects to measure where a whole scene would take minutes: generated here, and equal everywhere.
#pragma once

#include <vector>

#include "engine/metrics/spread.h"
#include "engine/volume/volume.h"

namespace stereonav {

// Returns a block of 72x96x56 voxels of 1 mm with three holes through it, its surface at 100 of 0..200, with
// noise.
GreyVolume blockWithHoles();
constexpr double kBlockSurface = 100;

// Returns at most `most` voxels that lookups at the surface need, evenly spread.
std::vector<glm::ivec3> surfaceVoxels(const GreyVolume& volume, double isovalue, std::size_t most);

// Returns the root mean square of a - b as a share of that of b; 0 where b is 0.
double relativeRms(const std::vector<double>& a, const std::vector<double>& b);
// Returns the largest |a - b| as a share of the root mean square of b.
double relativeWorst(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace stereonav
