// Exact Euclidean distance from every voxel to the nearest seed voxel, centre to centre, on grids of any
// spacing. Separable: runs along i, then least squared distances over lines along j and k (Felzenszwalb and
// Huttenlocher 2012; Meijster et al. 2000), columns side by side in vectors and on all threads; lines are
// tried outwards while they can help, so narrow masks cost little and the time grows with the distances.
#pragma once

#include <cstdint>
#include <limits>

#include "engine/simd/simd_target.h"
#include "engine/volume/volume.h"

namespace stereonav {

// Distances in units of `unit` metres, rounded down (never above the true distance), at most 65534;
// kNoSeed where the volume has no seed at all.
struct DistanceVolume : Volume<std::uint16_t> {
    static constexpr std::uint16_t kNoSeed = 65535;
    double unit = 0;  // metres
};

// Returns the distance to the nearest voxel with mask 0, for every voxel with mask not 0; 0 elsewhere. Voxels
// beyond the volume's faces count as 0 too when outsideIsSeed. unit: metres, > 0; 0: a 64th of the smallest
// spacing. Where spacings differ, a distance within one part in 4 million of a whole number may come out one
// unit less. The work is done inside the bounding box of the mask. Memory: 2 bytes a voxel for the result, 4
// for each square of a block of lines (2^24 of them, or 64 lines where that is more), taken only where rows
// of the box hold mask (in pages of 2 MB), besides two planes a thread and 8 bytes a row. The same on any
// number of threads and for every target. What is further than atMost metres is given as that: then no line
// further away is looked at, and all voxels count as near a seed. Throws Error when the unit, atMost or a
// spacing is not positive or this processor does not have the target.
DistanceVolume distanceToOutside(const MaskVolume& mask, bool outsideIsSeed = true, double unit = 0,
                                 SimdTarget target = SimdTarget::Auto,
                                 double atMost = std::numeric_limits<double>::infinity());

}  // namespace stereonav
