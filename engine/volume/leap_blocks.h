// Leap codes of large volumes in little memory. Distances up to kExactReach of the smallest spacing are
// measured cell by cell in one block after the other; beyond that they are those between groups of 4^3 cells,
// which are less by up to two diagonals of a group. Shared among engine/volume/*.cpp only.
#pragma once

#include "engine/base/progress.h"
#include "engine/volume/surface_cells.h"

namespace stereonav {

constexpr int kLargestCode = 255;
constexpr double kExactReach = 16;  // smallest spacings

// How many units of distance make one of leaps, so that the largest distance has a code.
inline int leapDivisor(int largest) {
    const int most = kLargestCode - 1;
    return largest > most ? (largest + most - 1) / most : 1;
}

// Fills codes, farCodes and leapUnit of cells that have frame and layout: 0 for the cells that hold surface.
// Bricks beyond the exact reach of any surface get codes of their groups alone, a 64th of the memory. Besides
// the codes it takes an eighth of a byte a cell, and 11 bytes for each cell of a block of 288^3.
void codeLeapsByBlocks(const GreyVolume& volume, const SurfaceSetting& setting, Progress& progress,
                       SurfaceCells& cells);

}  // namespace stereonav
