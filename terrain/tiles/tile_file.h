// The file of a tile store: where its parts lie. All levels of a ground, cut into square tiles of heights.
//
// A head, then for each level its bounds (terrain/ground/level_step.h) and a check value for each tile, then
// for each level its tiles, row by row from the south-west one. Numbers are as this machine has them: the
// file is for the machine that made it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace stereonav {

constexpr int kTileSide = 256;  // samples along each side of a tile
constexpr std::uint64_t kTileBytes = sizeof(float) * kTileSide * kTileSide;

// The head of the file, as it lies there.
struct TileFileHead {
    std::array<char, 8> magic{'s', 'n', 't', 'i', 'l', 'e', 's', '1'};
    std::uint64_t content = 0;           // identifies the heights: TileStore's `content`
    std::int32_t width = 0, height = 0;  // samples of the finest level
    float low = 0, high = 0;             // metres, of the finest level
    std::int64_t missing = 0;            // samples of the finest level
    std::uint64_t indexCheck = 0;        // check value of bounds and check values
    std::uint64_t check = 0;             // check value of what is before
};

// Where the parts lie, which follows from the size alone: samples of the finest level.
class TileFilePlan {
public:
    struct Level {
        glm::ivec2 size{0}, blocks{0}, tiles{0};         // samples, blocks, tiles each way
        std::uint64_t bounds = 0, checks = 0, data = 0;  // bytes from the start of the file

        std::size_t blockCount() const { return static_cast<std::size_t>(blocks.x) * blocks.y; }
        std::size_t tileCount() const { return static_cast<std::size_t>(tiles.x) * tiles.y; }
    };

    explicit TileFilePlan(const glm::ivec2& size);

    const std::vector<Level>& levels() const { return mLevels; }
    std::uint64_t byteCount() const { return mBytes; }
    // Bytes from the start; bounds and check values lie from the head to here.
    std::uint64_t indexEnd() const { return mIndexEnd; }

private:
    std::vector<Level> mLevels;
    std::uint64_t mBytes = 0, mIndexEnd = 0;
};

// Returns the check value of what is before it in the head, or of some bytes: a hash.
std::uint64_t checkOf(const TileFileHead& head);
std::uint64_t checkOf(const void* data, std::size_t bytes);

}  // namespace stereonav
