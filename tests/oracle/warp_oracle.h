// The scalar inverse warp of one row: written for clearness, kept as the truth of the vector kernels,
// which give the same bits.
#pragma once

#include "engine/stereo/warp_row.h"

namespace stereonav {

// Warps one row; every pixel of it is written.
void resampleRowOracle(const ResampleRow& row);

}  // namespace stereonav
