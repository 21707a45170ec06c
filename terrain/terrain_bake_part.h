// What a terrain's bake has done when it is stopped: kept in the cache, so that the next run goes on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace stereonav {

// Phase 0: horizons and direct transfer; then one a bounce. Rows of it that are done, from the first on.
struct BakeReached {
    std::int32_t phase = 0, rows = 0;
};

using BakeBlocks = std::vector<std::span<std::byte>>;

// Where the part of the bake with this key lies (terrainLightKey()).
std::filesystem::path terrainBakePart(std::uint64_t key);

// False where it can not be written; bounded with what else is kept (engine/base/cache.h).
bool keepBakePart(std::uint64_t key, const BakeReached& reached, const BakeBlocks& blocks);

// How far the kept part of this bake is; {0, 0} where there is none.
BakeReached keptBakePart(std::uint64_t key);

// Fills the blocks, which are those of what was reached. False where it is damaged or of another size; the
// blocks then hold anything.
bool readBakePart(std::uint64_t key, const BakeBlocks& blocks);

}  // namespace stereonav
