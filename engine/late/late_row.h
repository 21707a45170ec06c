// Types shared by the late warp's kernels and its other code. Few includes, since the kernels are compiled
// once for each instruction set.
#pragma once

#include <cstdint>

namespace stereonav {

// Pictures are divided into tiles; for each the range of its depths is known.
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

// The mapping from a pixel of the new picture, (x, y) continuous, to the picture that was cast. A point at
// inverse depth i in that picture is seen in it at u = a + i (shift.x - shift.z a), v = b + i (shift.y -
// shift.z b). (a, b) is the position of infinitely far points: a = row 0 / row 2, b = row 1 / row 2 of rows *
// (x, y, 1).
struct LateMove {
    float rows[3][3] = {};  // without unit
    float shift[3] = {};    // x and y: pixels times metres; z: metres
};

// How the pixels of a tile of the new picture are found.
struct LatePlan {
    float farthest = 0, nearest = 0;  // range of inverse depths that may be seen in the tile
    int steps = 0;                    // steps along the rays; 0: the surface is smooth; -1: it is also flat
};

// A row of tiles of the new picture.
struct LateBand {
    const LateSource* source = nullptr;
    const LateMove* move = nullptr;
    const LatePlan* plans = nullptr;   // one for each tile
    int width = 0, top = 0, rows = 0;  // pixels; the first row, and how many
    std::uint32_t* color = nullptr;    // row `top`
    int colorStride = 0;
    std::uint8_t* uncovered = nullptr;  // 255 where nothing was seen before, else 0; null: not asked for
    int uncoveredStride = 0;
};

// Rows of tiles of a picture that was cast.
struct LateDepths {
    const float* depth = nullptr;  // metres: infinite, or 0 and NaN where the depth is not known
    int depthStride = 0;
    float* inverse = nullptr;  // output
    int inverseStride = 0;
    int width = 0, height = 0;
    LateTile* tiles = nullptr;  // output, row by row
};

// The kernels of one instruction set.
struct LateKernels {
    void (*warp)(const LateBand& band);                 // writes the band's colours
    void (*invert)(const LateDepths& depths, int row);  // a row of pixels
    // Measures a row of tiles, once its rows of pixels and the one below are inverted.
    void (*measure)(const LateDepths& depths, int tileRow);
};

}  // namespace stereonav
