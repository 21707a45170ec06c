// Exact Euclidean distance from every voxel to the nearest seed voxel, centre to centre, on grids of any
// spacing. Separable: runs along i, lower envelopes of parabolas along j and k (Felzenszwalb and
// Huttenlocher 2012; Meijster et al. 2000), columns side by side in vectors and on all threads.
#pragma once

#include <cstdint>

#include "engine/volume/volume.h"

namespace stereonav {

// Distances in units of `unit` metres, rounded down (never above the true distance), at most 65534;
// kNoSeed where the volume has no seed at all.
struct DistanceVolume : Volume<std::uint16_t> {
    static constexpr std::uint16_t kNoSeed = 65535;
    double unit = 0;  // metres
    double metresAt(const glm::ivec3& v) const { return at(v) * unit; }
};

// Distance to the nearest voxel with mask 0, for every voxel with mask not 0; 0 elsewhere. Voxels beyond
// the volume's faces count as 0 too when outsideIsSeed. unit: metres, > 0; 0: a 64th of the smallest spacing.
// The work is done inside the bounding box of the mask.
DistanceVolume distanceToOutside(const MaskVolume& mask, bool outsideIsSeed = true, double unit = 0);

}  // namespace stereonav
