// Map tiles whose colours encode heights: detection of the code, and the heights.
#pragma once

#include <gdal_priv.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stereonav {

// Meaning of the 24 bits of a pixel's red, green and blue, the highest first.
enum class TileCode {
    None,        // no heights
    Gsi,         // centimetres, negative ones in two's complement; 2^23 is missing
    TerrainRgb,  // tenths of a metre over -10000 m; 0 is missing
    Terrarium    // 1/256 m over -32768 m
};

struct CodedTile {
    TileCode code = TileCode::None;
    std::string note;  // where two codes are possible: the one that was taken, and why; else ""
};

// Detects the code of a tile: it is square, of 256 or 512 pixels (GSI: 256), with three or four 8-bit bands,
// and not JPEG. Heights differ from pictures by their carries: where the middle byte of a height changes, the
// lowest one wraps, which colours do not do. Codes are told apart by the range and slope of the heights that
// they would give, and by the tile's place according to its path.
CodedTile codedTileOf(GDALDataset& dataset, const std::filesystem::path& file);

// Returns a name for messages, such as "Terrain-RGB elevation tile".
std::string nameOf(TileCode code);

// Returns metres, NaN where missing, in the file's order. code: not None.
std::vector<float> codedHeights(GDALDataset& dataset, TileCode code);

// A tile of the web map, by a path that ends in zoom/x/y.ext.
struct WebTile {
    int zoom = 0, x = 0, y = 0;
    double longitude() const;  // degrees, of its middle
    double latitude() const;
    // Returns the metres per pixel at the middle of a tile that is `pixels` wide.
    double spacing(int pixels) const;
};
std::optional<WebTile> webTileOf(const std::filesystem::path& file);

}  // namespace stereonav
