// The step from one level of a ground to the next coarser one: its heights, and their error. GroundLevels
// does it in memory, a tile store (terrain/tiles) from disk, row by row.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>

namespace stereonav {

constexpr int kLevelBlock = 64;  // cells of a level along each side of a block that has a bound of its own

// Return the number of samples of the next coarser level, and the number of blocks of a level.
inline glm::ivec2 coarserSize(const glm::ivec2& size) {
    return (size - 1) / 2 + 1;
}
inline glm::ivec2 levelBlocks(const glm::ivec2& size) {
    return (size - 1 + kLevelBlock - 1) / kLevelBlock;
}
// Returns whether there is a coarser level, which has at least one block in each direction.
inline bool hasCoarser(const glm::ivec2& size) {
    return (size.x < size.y ? size.x : size.y) - 1 >= 2 * kLevelBlock;
}

// Rows of a level from `first` on, or all of them; row 0 is the southernmost.
struct LevelRows {
    const float* heights = nullptr;  // heights from row `first` on, size.x a row; metres
    glm::ivec2 size{0};              // size of the whole level
    int first = 0;

    const float* row(int j) const { return heights + static_cast<std::ptrdiff_t>(j - first) * size.x; }
    float at(int i, int j) const { return row(j)[i]; }
};

// Makes row j of the coarser level: means of the known samples with the weights 1 2 1 in both directions;
// missing where the middle one is. Reads rows 2j - 1 to 2j + 1.
void coarserRow(const LevelRows& finer, int j, float* row);

// Returns the largest difference in metres, rounded up, between the surfaces of two neighbouring levels over
// a block of the coarser one, where both are known. Reads the block's rows of both.
float blockDifference(const LevelRows& finer, const LevelRows& coarser, const glm::ivec2& block);

// Returns the bound of a block against the ground itself, in metres: the difference to the finer level plus
// the largest bound of the finer level's blocks within it. blocks: number of blocks of the finer level.
float boundOfBlock(float difference, const float* finerBounds, const glm::ivec2& blocks,
                   const glm::ivec2& block);

}  // namespace stereonav
