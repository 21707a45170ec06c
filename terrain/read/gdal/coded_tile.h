// Map tiles whose colours are heights: which code they are written in, and the heights.
#pragma once

#include <gdal_priv.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stereonav {

// What the 24 bits of a pixel's red, green and blue mean, the highest first.
enum class TileCode {
    None,        // no heights
    Gsi,         // centimetres, negative ones by their complement; 2^23 is missing
    TerrainRgb,  // tenths of a metre over -10000 m; 0 is missing
    Terrarium    // 1/256 m over -32768 m
};

struct CodedTile {
    TileCode code = TileCode::None;
    std::string note;  // where two codes would do, which was taken and why; "" else
};

// Tells what code a tile has: it is square, of 256 or 512 pixels (of GSI 256), with three or four 8-bit
// bands, not JPEG. Heights are told from pictures by their carries: where the middle byte of heights changes
// the lowest one wraps, which no colours do. Codes are told apart by the heights that they would give, where
// the tile lies by its path, and how steep it would be.
CodedTile codedTileOf(GDALDataset& dataset, const std::filesystem::path& file);

// "Terrain-RGB elevation tile"
std::string nameOf(TileCode code);

// Metres, NaN where missing, in the file's order. code: not None.
std::vector<float> codedHeights(GDALDataset& dataset, TileCode code);

// A tile of the web map, by a path that ends in zoom/x/y.ext.
struct WebTile {
    int zoom = 0, x = 0, y = 0;
    double longitude() const;  // degrees, of its middle
    double latitude() const;
    // Returns the metres a pixel at the middle of a tile that is `pixels` wide.
    double spacing(int pixels) const;
};
std::optional<WebTile> webTileOf(const std::filesystem::path& file);

}  // namespace stereonav
