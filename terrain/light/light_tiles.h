// The file of light that was baked at finer samples than those of a ground in memory: square tiles of each
// level of the ground between. It lies beside the file of the light that it goes on from (LIGHT.fine), which
// it can not do without.
//
// A head, a check value for each tile, then the tiles: of each level from the coarsest, row by row from the
// south-west one; in a tile openness, horizon, full and bounced as in TerrainLight. Numbers are as this
// machine has them. While it is made it is LIGHT.fine.part, and may lack tiles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/placed_file.h"
#include "terrain/light/terrain_light.h"

namespace stereonav {

constexpr int kLightTileSide = 256;  // samples along each side of a tile

// The content of a file of fine light.
struct FineLightShape {
    TerrainLightSettings settings;  // those of the light that it goes on from, as the key is
    std::uint64_t key = 0;
    glm::ivec2 size{0};            // samples of the ground's finest level, which is level 0
    int coarsest = 0, finest = 0;  // levels that have tiles
    std::uint64_t content = 0;     // names their heights: GroundLevels::content()
};

// Returns the place of the file beside that light.
std::filesystem::path fineLightPlace(const std::filesystem::path& light);
bool isFineLight(const std::filesystem::path& file);  // whether it begins as such a file does
// Returns whether the file continues the light with that key.
bool isFineLightOf(const std::filesystem::path& file, std::uint64_t key);

class LightTiles {
public:
    // Opens a whole file, as far as it goes: shape.finest is not looked at. Throws Error that names the file
    // where it is not whole, or its light or ground is another one.
    LightTiles(const std::filesystem::path& file, const FineLightShape& shape);
    // Begins a file, or goes on with the undamaged tiles that an earlier run left of it. Throws Error where
    // it can not be written.
    static LightTiles begin(const std::filesystem::path& file, const FineLightShape& shape);

    const FineLightShape& shape() const { return mShape; }
    glm::ivec2 size(int level) const { return mLevels[mShape.coarsest - level].size; }  // samples

    struct Tile {
        int level = 0;
        glm::ivec2 number{0};                                       // column and row of tiles
        glm::ivec2 low() const { return number * kLightTileSide; }  // first sample
    };
    std::size_t count() const { return mAt.size() - 1; }
    Tile tile(std::size_t n) const;
    std::size_t numberOf(const Tile& tile) const;
    glm::ivec2 sizeOf(const Tile& tile) const;  // samples

    // Returns the tile's light at each of its samples, in a grid of its own; nothing where no sample is
    // known. From any thread. Throws Error that names the file where it is not there or is damaged.
    std::optional<TerrainLight> read(const Tile& tile) const;

    bool isWhole() const;  // reads all tiles: whether they are undamaged

    // Returns whether a file that is being made has tile n.
    bool has(std::size_t n) const { return mChecks[n] != kNotThere; }
    // Writes bytesOf() a tile's light; no bytes for a tile without a known sample. Throws Error.
    void write(std::size_t n, std::span<const std::byte> bytes);
    // Puts the file, once it has all tiles, into its place. Throws Error.
    void finish(const std::filesystem::path& place);

    std::uint64_t byteCount() const { return mAt.back(); }  // on disk

private:
    static constexpr std::uint64_t kNotThere = 0, kNothing = 1;  // check values; others are of bytes
    struct Level {
        glm::ivec2 size{0}, tiles{0};
        std::size_t first = 0;  // number of its first tile
    };
    LightTiles(const std::filesystem::path& file, const FineLightShape& shape, PlacedFile::For what);
    bool isRead(int error) const;  // error: PlacedFile::read()'s. False at the file's end. Throws DiskError
    bool readIndex();              // whether it is of this shape
    // The bytes of a tile that is there; none where they can not be read, or are damaged.
    std::vector<std::byte> bytesAt(std::size_t n) const;
    [[noreturn]] void refuse(const std::string& place, const std::string& problem) const;
    void checkWritten(int error) const;

    std::filesystem::path mFile;
    FineLightShape mShape;
    std::vector<Level> mLevels;      // the coarsest first
    std::vector<std::uint64_t> mAt;  // bytes from the start of the file to each tile, and to its end
    std::vector<std::uint64_t> mChecks;
    PlacedFile mPlaced;
};

// Returns a tile's light as it lies in the file.
std::vector<std::byte> bytesOf(const TerrainLight& tile);

}  // namespace stereonav
