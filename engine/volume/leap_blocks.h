// Leap codes of large volumes in little memory. Distances up to kExactReach of the smallest spacing are
// measured cell by cell in one block after the other; beyond that they are those between groups of 4^3 cells,
// which are less by up to two diagonals of a group. Shared among engine/volume/*.cpp only.
#pragma once

#include "engine/base/progress.h"
#include "engine/volume/surface_cells.h"

namespace stereonav {

constexpr int kLargestCode = 255;
constexpr double kExactReach = 16;  // multiples of the smallest spacing

// Returns how many units of distance make one of leaps, so that the largest distance has a code.
inline int leapDivisor(int largest) {
    const int most = kLargestCode - 1;
    return largest > most ? (largest + most - 1) / most : 1;
}

constexpr std::size_t kCellsOfBrick = 4096;

// Fills codes, farCodes and leapUnit of cells that have frame and layout. Bricks beyond the exact reach of
// any surface get codes of their groups alone, a 64th of the memory. With a region, leaps end at its border,
// and what is not in it is not written. Besides the codes it takes an eighth of a byte a cell, and 11 bytes
// for each cell of a block of 288^3. What is active is marked for isMarkedActive() until settleCodes().
void codeLeapsByBlocks(const GreyVolume& volume, const SurfaceSetting& setting, Progress& progress,
                       SurfaceCells& cells);

// Returns whether a code stands for an active cell, until settleCodes().
bool isMarkedActive(std::uint8_t code);

// Gives active cells kCellActive, and the memory of codes back that far bricks took.
void settleCodes(const SurfaceSetting& setting, SurfaceCells& cells);

}  // namespace stereonav
