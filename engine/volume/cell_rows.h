// Which cells of a row are in the region and hold surface. Shared among engine/volume/*.cpp only.
#pragma once

#include <cstdint>

#include "engine/volume/surface_cells.h"

namespace stereonav {

// Returns a grid with a voxel for each cell, at its middle.
VolumeFrame cellFrameOf(const VolumeFrame& voxels);

bool anySet(const std::uint8_t* row, int count);

// Writes 1 for the cells of row (j, k) with a corner inside the mask; returns false, and writes nothing,
// where there are none.
bool flagRegion(const MaskVolume& mask, int j, int k, int cells, std::uint8_t* region);

// Writes 1 for those of the region's cells that hold surface, 0 for all others.
void flagActive(const GreyVolume& volume, const SurfaceSetting& setting, int j, int k, int cells,
                const std::uint8_t* region, std::uint8_t* active);

}  // namespace stereonav
