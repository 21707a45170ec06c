// Heights of a ground of any size, on disk, at all levels. What lies near an eye is read from here into
// memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <vector>

#include "engine/base/placed_file.h"
#include "terrain/tiles/tile_file.h"

namespace stereonav {

// Levels, blocks and their bounds are those of GroundLevels. Bounds are kept in memory: 4 bytes for 4,096
// samples. Any number of threads may read.
class TileStore {
public:
    // Opens a store. content: identifies the heights that it must have. Throws Error that names the file
    // where it holds other heights, is cut off, or has a damaged index.
    TileStore(const std::filesystem::path& file, std::uint64_t content);

    int levels() const { return static_cast<int>(mPlan.levels().size()); }
    glm::ivec2 size(int level) const { return mPlan.levels()[level].size; }  // samples
    float low() const { return mHead.low; }                  // metres: the lowest sample of the finest level
    float high() const { return mHead.high; }                // metres: the highest sample
    long long missing() const { return mHead.missing; }      // number of missing samples of the finest level
    std::uint64_t hash() const { return mHead.indexCheck; }  // hash that identifies the heights of all levels
    // Returns the error bound of each block of a level, row by row; metres.
    const std::vector<float>& bounds(int level) const { return mBounds[level]; }

    // Reads samples low to low + size - 1 of a level into `heights`; all of them must be inside the level.
    // Rows of size.x, the southernmost first; metres, NaN where missing. Throws Error that names the file
    // where a tile can not be read or is damaged.
    void read(int level, const glm::ivec2& low, const glm::ivec2& size, float* heights) const;

    const std::filesystem::path& file() const { return mFile; }
    std::uint64_t byteCount() const { return mPlan.byteCount(); }  // on disk

private:
    void readTile(int level, const glm::ivec2& tile, float* heights) const;

    std::filesystem::path mFile;
    PlacedFile mIn;
    TileFileHead mHead;
    TileFilePlan mPlan{glm::ivec2(2)};
    std::vector<std::vector<float>> mBounds;  // by level and block, metres
    std::vector<std::vector<std::uint64_t>> mChecks;
};

}  // namespace stereonav
