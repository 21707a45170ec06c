// Small things to measure on where a whole scene would take minutes: made here, the same everywhere.
#pragma once

#include <vector>

#include "engine/metrics/spread.h"
#include "engine/volume/volume.h"

namespace stereonav {

// A block of 72x96x56 voxels of 1 mm with three holes through it, its surface at 100 of 0..200, with noise.
GreyVolume blockWithHoles();
constexpr double kBlockSurface = 100;

// Voxels that lookups at the surface ask for, spread evenly, `most` at most.
std::vector<glm::ivec3> surfaceVoxels(const GreyVolume& volume, double isovalue, std::size_t most);

// Root of the mean of squares of a - b, as a share of that of b; 0 where b is.
double relativeRms(const std::vector<double>& a, const std::vector<double>& b);
// The largest |a - b|, as a share of the root of the mean of squares of b.
double relativeWorst(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace stereonav
