#include "terrain/ground/level_step.h"

#include <algorithm>
#include <cmath>

namespace stereonav {
namespace {

// Weighted mean of the known samples around (i, j) of the finer level; NaN where that one is missing.
float meanAround(const LevelRows& finer, int i, int j) {
    if (!std::isfinite(finer.at(i, j))) return finer.at(i, j);
    double sum = 0, weights = 0;
    for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) {
            const int x = i + di, y = j + dj;
            if (x < 0 || y < 0 || x >= finer.size.x || y >= finer.size.y) continue;
            const float height = finer.at(x, y);
            if (!std::isfinite(height)) continue;
            const double weight = (di == 0 ? 2 : 1) * (dj == 0 ? 2 : 1);
            sum += weight * height;
            weights += weight;
        }
    return static_cast<float>(sum / weights);
}

constexpr float kRoundedUp = 1 + 0x1p-20f;

}  // namespace

void coarserRow(const LevelRows& finer, int j, float* row) {
    const int width = coarserSize(finer.size).x;
    for (int i = 0; i < width; ++i) row[i] = meanAround(finer, 2 * i, 2 * j);
}

// Both surfaces are bilinear within each cell of the finer level, and so is their difference, which is
// largest at a corner.
float blockDifference(const LevelRows& finer, const LevelRows& coarser, const glm::ivec2& block) {
    const glm::ivec2 first = 2 * kLevelBlock * block;
    const int lastI = std::min(first.x + 2 * kLevelBlock, 2 * (coarser.size.x - 1)),
              lastJ = std::min(first.y + 2 * kLevelBlock, 2 * (coarser.size.y - 1));
    double most = 0;
    for (int j = first.y; j <= lastJ; ++j) {
        const float *below = coarser.row(j / 2), *above = coarser.row(j / 2 + (j & 1)), *fine = finer.row(j);
        for (int i = first.x; i <= lastI; ++i) {
            const int x = i / 2, x1 = x + (i & 1);
            const double height = 0.25 * ((double(below[x]) + below[x1]) + (double(above[x]) + above[x1]));
            const double off = std::abs(height - fine[i]);
            if (off > most) most = off;  // not where one is missing
        }
    }
    return static_cast<float>(most) * kRoundedUp;
}

float boundOfBlock(float difference, const float* finerBounds, const glm::ivec2& blocks,
                   const glm::ivec2& block) {
    float before = 0;
    for (int j = 2 * block.y; j <= std::min(2 * block.y + 1, blocks.y - 1); ++j)
        for (int i = 2 * block.x; i <= std::min(2 * block.x + 1, blocks.x - 1); ++i)
            before = std::max(before, finerBounds[static_cast<std::size_t>(j) * blocks.x + i]);
    return (difference + before) * kRoundedUp;
}

}  // namespace stereonav
