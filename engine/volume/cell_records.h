// Stored data of active cells, brick by brick: records, or a dense brick's normals. Shared among
// engine/volume/*.cpp only.
#pragma once

#include <functional>

#include "engine/volume/surface_cells.h"

namespace stereonav {

// Writes 1 for each active one of `count` cells from `first` on along i, 0 for the others. Called from many
// threads.
using ActiveRow = std::function<void(const glm::ivec3& first, int count, std::uint8_t* active)>;

// Fills all of the cells but their codes. Throws Error where they are more than kernels can count, or than
// memory holds.
void writeRecords(const GreyVolume& volume, const SurfaceSetting& setting, const ActiveRow& activeRow,
                  SurfaceCells& cells);

}  // namespace stereonav
