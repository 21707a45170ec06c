#include "terrain/tiles/tile_file.h"

#include <cstddef>

#include "engine/base/hash.h"
#include "terrain/ground/level_step.h"

namespace stereonav {

TileFilePlan::TileFilePlan(const glm::ivec2& size) {
    for (glm::ivec2 of = size;; of = coarserSize(of)) {
        mLevels.push_back({of, levelBlocks(of), (of + kTileSide - 1) / kTileSide});
        if (!hasCoarser(of)) break;
    }
    std::uint64_t at = sizeof(TileFileHead);
    for (Level& level : mLevels) {
        level.checks = at;  // checks come first, so that both parts begin at a multiple of their size
        at += sizeof(std::uint64_t) * level.tileCount();
    }
    for (Level& level : mLevels) {
        level.bounds = at;
        at += sizeof(float) * level.blockCount();
    }
    mIndexEnd = at;
    constexpr std::uint64_t kPage = 4096;
    at = (at + kPage - 1) / kPage * kPage;
    for (Level& level : mLevels) {
        level.data = at;
        at += kTileBytes * level.tileCount();
    }
    mBytes = at;
}

std::uint64_t checkOf(const TileFileHead& head) {
    return checkOf(&head, offsetof(TileFileHead, check));
}

std::uint64_t checkOf(const void* data, std::size_t bytes) {
    return Hash().add(data, bytes).value();
}

}  // namespace stereonav
