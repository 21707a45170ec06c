// What the late warp's kernels and the rest of it share. Light on purpose: the kernels are compiled once for
// each instruction set.
#pragma once

#include <cstdint>

namespace stereonav {

// Pictures are cut into tiles; of each is known what depths lie in it.
constexpr int kLateTileWidth = 16, kLateTileHeight = 8;  // pixels
constexpr int kMostLateSteps = 32;                       // steps of a search along a ray

// Inverse depths of a tile, 1 / metres: 0 is infinitely far.
struct LateTile {
    float farthest = 0, nearest = 0;
    float jump = 0;  // the largest difference of neighbours, also across the tile's right and lower border
};

// A picture that was cast. Behind each row lies room for a vector (Plane).
struct LateSource {
    int width = 0, height = 0;             // pixels
    const float* inverse = nullptr;        // inverse depths
    int inverseStride = 0;                 // from row to row, pixels; so are all strides below
    const std::uint32_t* color = nullptr;  // PackedColor
    int colorStride = 0;
};

// The way from a pixel of the new picture, (x, y) continuous, to the one that was cast: a point that is seen
// there at an inverse depth i is seen at u = a + i (shift.x - shift.z a), v = b + i (shift.y - shift.z b),
// where (a, b) is the place of what is infinitely far: a = row 0 / row 2, b = row 1 / row 2 of rows * (x, y,
// 1).
struct LateMove {
    float rows[3][3] = {};  // without unit
    float shift[3] = {};    // x and y: pixels times metres; z: metres
};

// How a tile of the new picture is looked up.
struct LatePlan {
    float farthest = 0, nearest = 0;  // inverse depths that may be seen there
    int steps = 0;                    // steps along the rays; 0: the surface is smooth; -1: and flat
};

// A row of tiles of the new picture.
struct LateBand {
    const LateSource* source = nullptr;
    const LateMove* move = nullptr;
    const LatePlan* plans = nullptr;   // one a tile
    int width = 0, top = 0, rows = 0;  // pixels; the first row, and how many
    std::uint32_t* color = nullptr;    // row `top`
    int colorStride = 0;
    std::uint8_t* uncovered = nullptr;  // 255 where nothing was seen before, else 0; null: not asked for
    int uncoveredStride = 0;
};

// Rows of tiles of a picture that was cast.
struct LateDepths {
    const float* depth = nullptr;  // metres: infinite, or 0 and NaN where nothing is known
    int depthStride = 0;
    float* inverse = nullptr;  // written
    int inverseStride = 0;
    int width = 0, height = 0;
    LateTile* tiles = nullptr;  // row by row
};

// The kernels of one instruction set.
struct LateKernels {
    void (*warp)(const LateBand& band);                      // writes the band's colours
    void (*invert)(const LateDepths& depths, int row);       // a row of pixels
    void (*measure)(const LateDepths& depths, int tileRow);  // once its rows and the one below are inverted
};

}  // namespace stereonav
