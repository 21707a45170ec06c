// Makes a tile store from rows of heights, once through, whatever the ground's size: of each level a few
// hundred rows are in memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>

#include "engine/base/progress.h"

namespace stereonav {

// Rows of heights that tiles are made of.
struct TileSource {
    glm::ivec2 size{0};         // samples, each >= 2
    std::uint64_t content = 0;  // identifies the heights
    int rows = 1;               // best number to read at once, >= 1
    int firstRows = 0;          // best number to begin with; 0: `rows`
    // Writes rows first to first + count - 1, counted from the south: metres, NaN where missing.
    std::function<void(int first, int count, float* heights)> read;
};

// Returns the bytes of memory that making tiles takes. size: samples; rows: TileSource::rows.
double bytesOfMaking(const glm::ivec2& size, int rows);

// Makes the tiles of all levels in that file, which is made anew. Throws Error that names it where the disk
// is full or cannot be written; what source.read throws; Cancelled.
void makeTiles(const TileSource& source, const std::filesystem::path& file, Progress& progress);

}  // namespace stereonav
