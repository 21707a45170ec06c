#include "terrain/ground/ground_levels.h"

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

int blocksOf(int samples) {
    return (samples - 1 + GroundLevels::kBlock - 1) / GroundLevels::kBlock;
}

// Weighted mean of the known samples around (i, j) of the finer level; NaN where that one is missing.
float meanAround(const float* heights, const glm::ivec2& size, int i, int j) {
    const auto at = [&](int x, int y) { return heights[static_cast<std::size_t>(y) * size.x + x]; };
    if (!std::isfinite(at(i, j))) return at(i, j);
    double sum = 0, weights = 0;
    for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) {
            const int x = i + di, y = j + dj;
            if (x < 0 || y < 0 || x >= size.x || y >= size.y || !std::isfinite(at(x, y))) continue;
            const double weight = (di == 0 ? 2 : 1) * (dj == 0 ? 2 : 1);
            sum += weight * at(x, y);
            weights += weight;
        }
    return static_cast<float>(sum / weights);
}

}  // namespace

GroundLevels::GroundLevels(const Heightfield& ground) : mGround(ground) {
    Level first;
    first.size = {ground.width(), ground.height()};
    first.blocks = {blocksOf(ground.width()), blocksOf(ground.height())};
    first.bounds.assign(static_cast<std::size_t>(first.blocks.x) * first.blocks.y, 0.0f);
    mLevels.push_back(std::move(first));
    while (std::min(mLevels.back().size.x, mLevels.back().size.y) - 1 >= 2 * kBlock) addLevel();
}

const float* GroundLevels::heights(int level) const {
    return level == 0 ? mGround.data() : mLevels[level].heights.data();
}

void GroundLevels::addLevel() {
    const int level = count() - 1;
    const glm::ivec2 from = mLevels.back().size;
    Level made;
    made.size = (from - 1) / 2 + 1;
    made.blocks = {blocksOf(made.size.x), blocksOf(made.size.y)};
    made.heights.resize(static_cast<std::size_t>(made.size.x) * made.size.y);
    const float* const finer = heights(level);
    parallelFor(made.size.y, [&](int j) {
        for (int i = 0; i < made.size.x; ++i)
            made.heights[static_cast<std::size_t>(j) * made.size.x + i] =
                meanAround(finer, from, 2 * i, 2 * j);
    });
    made.bounds.resize(static_cast<std::size_t>(made.blocks.x) * made.blocks.y);
    parallelFor(made.blocks.y, [&](int j) {
        for (int i = 0; i < made.blocks.x; ++i)
            made.bounds[static_cast<std::size_t>(j) * made.blocks.x + i] = boundOf(made, i, j);
    });
    mLevels.push_back(std::move(made));
}

// Both surfaces are bilinear within each cell of the finer level, and so is their difference, which is
// largest at a corner. That level's own bound is added.
float GroundLevels::boundOf(const Level& made, int blockI, int blockJ) const {
    const Level& finer = mLevels.back();
    const float* const below = heights(count() - 1);
    const glm::ivec2 first = 2 * kBlock * glm::ivec2(blockI, blockJ);
    const int lastI = std::min(first.x + 2 * kBlock, 2 * (made.size.x - 1)),
              lastJ = std::min(first.y + 2 * kBlock, 2 * (made.size.y - 1));
    const auto at = [&](int i, int j) { return made.heights[static_cast<std::size_t>(j) * made.size.x + i]; };
    double most = 0;
    for (int j = first.y; j <= lastJ; ++j)
        for (int i = first.x; i <= lastI; ++i) {
            const int x = i / 2, y = j / 2, x1 = x + (i & 1), y1 = y + (j & 1);
            const double height = 0.25 * ((double(at(x, y)) + at(x1, y)) + (double(at(x, y1)) + at(x1, y1)));
            const double off = std::abs(height - below[static_cast<std::size_t>(j) * finer.size.x + i]);
            if (off > most) most = off;  // not where one is missing
        }
    float before = 0;
    for (int j = 2 * blockJ; j <= std::min(2 * blockJ + 1, finer.blocks.y - 1); ++j)
        for (int i = 2 * blockI; i <= std::min(2 * blockI + 1, finer.blocks.x - 1); ++i)
            before = std::max(before, finer.bounds[static_cast<std::size_t>(j) * finer.blocks.x + i]);
    constexpr float kRoundedUp = 1 + 0x1p-20f;
    return (static_cast<float>(most) + before) * kRoundedUp;
}

float GroundLevels::errorBound(int level) const {
    return *std::max_element(mLevels[level].bounds.begin(), mLevels[level].bounds.end());
}

Heightfield GroundLevels::part(int level, const glm::ivec2& low, const glm::ivec2& size) const {
    std::vector<float> samples(static_cast<std::size_t>(size.x) * size.y);
    const float* const from = heights(level);
    const int across = mLevels[level].size.x;
    for (int j = 0; j < size.y; ++j)
        std::copy_n(from + static_cast<std::size_t>(low.y + j) * across + low.x, size.x,
                    samples.begin() + static_cast<std::ptrdiff_t>(j) * size.x);
    return Heightfield(size.x, size.y, spacing(level), std::move(samples), "a level of the ground",
                       mGround.originWorld() + glm::dvec2(low) * spacing(level));
}

std::size_t GroundLevels::byteCount() const {
    std::size_t bytes = 0;
    for (const Level& level : mLevels) bytes += (level.heights.size() + level.bounds.size()) * sizeof(float);
    return bytes;
}

}  // namespace stereonav
