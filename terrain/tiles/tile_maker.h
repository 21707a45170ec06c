// Makes a tile store from rows of heights, once through, whatever the ground's size: of each level a few
// hundred rows are in memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>

#include "engine/base/progress.h"

namespace stereonav {

struct TileSource {
    glm::ivec2 size{0};         // samples, each >= 2
    std::uint64_t content = 0;  // names the heights
    int rows = 1;               // that are read best at once, >= 1
    int firstRows = 0;          // so many before; 0: none
    // Rows first to first + count - 1, counted from the south: metres, NaN where missing.
    std::function<void(int first, int count, float* heights)> read;
};

// Bytes of memory that it takes.
double bytesOfMaking(const glm::ivec2& size, int rows);

// Writes into that file, which is made anew. Throws Error named by it where the disk is full or cannot be
// written; what read throws; Cancelled.
void makeTiles(const TileSource& source, const std::filesystem::path& file, Progress& progress);

}  // namespace stereonav
