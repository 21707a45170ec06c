#include "terrain/ground/ground_levels.h"

#include <algorithm>
#include <utility>

#include "engine/base/hash.h"
#include "engine/base/parallel.h"

namespace stereonav {

GroundLevels::GroundLevels(const Heightfield& ground)
    : mGround(&ground),
      mSpacing(ground.spacing()),
      mOrigin(ground.originWorld()),
      mLow(ground.minHeight()),
      mHigh(ground.maxHeight()) {
    Level first;
    first.size = {ground.width(), ground.height()};
    first.blocks = levelBlocks(first.size);
    first.bounds.assign(static_cast<std::size_t>(first.blocks.x) * first.blocks.y, 0.0f);
    mLevels.push_back(std::move(first));
    while (hasCoarser(mLevels.back().size)) addLevel();
}

GroundLevels::GroundLevels(StoredLevels stored)
    : mSpacing(stored.spacing),
      mOrigin(-0.5 * glm::dvec2(stored.size - 1) * stored.spacing),
      mLow(stored.low),
      mHigh(stored.high),
      mContent(stored.content),
      mRead(std::move(stored.read)) {
    for (glm::ivec2 size = stored.size; mLevels.size() < stored.bounds.size(); size = coarserSize(size)) {
        std::vector<float>& bounds = stored.bounds[mLevels.size()];
        const float most = *std::max_element(bounds.begin(), bounds.end());
        mLevels.push_back({size, levelBlocks(size), {}, std::move(bounds), most});
    }
}

std::uint64_t GroundLevels::content() const {
    if (stored()) return mContent;
    const glm::ivec2 size = this->size(0);
    return Hash().add(mGround->data(), sizeof(float) * static_cast<std::size_t>(size.x) * size.y).value();
}

LevelRows GroundLevels::rowsOf(int level) const {
    return {level == 0 ? mGround->data() : mLevels[level].heights.data(), mLevels[level].size, 0};
}

void GroundLevels::addLevel() {
    const int level = count() - 1;
    const Level& finer = mLevels.back();
    Level made;
    made.size = coarserSize(finer.size);
    made.blocks = levelBlocks(made.size);
    made.heights.resize(static_cast<std::size_t>(made.size.x) * made.size.y);
    const LevelRows from = rowsOf(level), to{made.heights.data(), made.size, 0};
    parallelFor(made.size.y, [&](int j) {
        coarserRow(from, j, made.heights.data() + static_cast<std::ptrdiff_t>(j) * made.size.x);
    });
    made.bounds.resize(static_cast<std::size_t>(made.blocks.x) * made.blocks.y);
    parallelFor(made.blocks.y, [&](int j) {
        for (int i = 0; i < made.blocks.x; ++i)
            made.bounds[static_cast<std::size_t>(j) * made.blocks.x + i] =
                boundOfBlock(blockDifference(from, to, {i, j}), finer.bounds.data(), finer.blocks, {i, j});
    });
    made.most = *std::max_element(made.bounds.begin(), made.bounds.end());
    mLevels.push_back(std::move(made));
}

bool GroundLevels::contains(const glm::dvec2& world) const {
    const glm::dvec2 grid = gridFromWorld(world);
    const glm::ivec2 last = mLevels.front().size - 1;
    return grid.x >= 0 && grid.y >= 0 && grid.x <= last.x && grid.y <= last.y;
}

float GroundLevels::errorBoundAt(int level, const glm::dvec2& world) const {
    const glm::dvec2 block = gridFromWorld(world) / double(kBlock << level);
    const glm::ivec2 last = blocks(level) - 1;
    return errorBound(level, std::clamp(static_cast<int>(block.x), 0, last.x),
                      std::clamp(static_cast<int>(block.y), 0, last.y));
}

void GroundLevels::read(int level, const glm::ivec2& low, const glm::ivec2& size, float* heights) const {
    if (stored()) return mRead(level, low, size, heights);
    const LevelRows rows = rowsOf(level);
    for (int j = 0; j < size.y; ++j)
        std::copy_n(rows.row(low.y + j) + low.x, size.x, heights + static_cast<std::ptrdiff_t>(j) * size.x);
}

std::optional<Heightfield> GroundLevels::part(int level, const glm::ivec2& low,
                                              const glm::ivec2& size) const {
    std::vector<float> samples(static_cast<std::size_t>(size.x) * size.y);
    read(level, low, size, samples.data());
    if (!Heightfield::anyCell(size.x, size.y, samples.data())) return std::nullopt;
    return Heightfield(size.x, size.y, spacing(level), std::move(samples), "a level of the ground",
                       mOrigin + glm::dvec2(low) * spacing(level));
}

std::size_t GroundLevels::byteCount() const {
    std::size_t bytes = 0;
    for (const Level& level : mLevels) bytes += (level.heights.size() + level.bounds.size()) * sizeof(float);
    return bytes;
}

}  // namespace stereonav
