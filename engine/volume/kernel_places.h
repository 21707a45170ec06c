// Looks up the stored data of active cells (surface_cells.h): where it lies, and the values at a cell's
// corners. Included by kernels only.
#pragma once

#include "engine/volume/kernel_rays.h"

namespace stereonav::STEREONAV_ISA {

// Where what is kept of active cells lies: the word of its record, or in a dense brick, with kDense set, that
// of its first corner's normal.
struct Places {
    I word;
    M known;  // there is something
};
constexpr int kDense = static_cast<int>(0x80000000u), kNotDense = 0x7FFFFFFF;
constexpr int kSide = 17;  // corners along each side of a dense brick

STEREONAV_INLINE M isDense(I word) {
    return word < I(0);
}

// Returns where what is kept of active cells with these indices lies.
STEREONAV_INLINE Places placesOf(const CellData& cells, I index, M m) {
    const I brick = gather(cells.bricks, shiftRight<12>(index), m);
    const I place = gatherHalves(cells.places, index, m) & I(0xFFFF);
    const I word = shiftLeft<4>(brick + place - I(1));
    const M known = m & (I(0) < place);
    if (!cells.normals) return {word, known};
    const M dense = m & isDense(brick);
    if (!any(dense)) return {word, known};
    const I low(15);
    const I corner = (shiftRight<8>(index) & low) * I(kSide * kSide) +
                     (shiftRight<4>(index) & low) * I(kSide) + (index & low);
    const I first = (brick & I(kNotDense)) * I(kSide * kSide * kSide) + corner;
    return {select(dense, first | I(kDense), word), known | dense};
}

// Values at a cell's corners less the isovalue: corner x + 2 y + 4 z.
struct Corners {
    F v[8];
};

// Takes values of a pair of corners out of the halves of a word.
STEREONAV_INLINE void setPair(Corners& corners, int pair, I both, F isovalue) {
    corners.v[2 * pair] = toFloat(shiftRight<16>(shiftLeft<16>(both))) - isovalue;
    corners.v[2 * pair + 1] = toFloat(shiftRight<16>(both)) - isovalue;
}

// Reads the corners of the cells `at`.
STEREONAV_INLINE Corners cornersOf(const Grid& grid, I word, const Cells& at, M m) {
    const CellData& cells = grid.data;
    const M dense = cells.normals ? m & isDense(word) : maskFromBits(0);
    const M sparse = andNot(m, dense);
    Corners corners;
    const IPair low = gatherPair(cells.records, word, sparse),
                high = gatherPair(cells.records + 2, word, sparse);
    I pairs[4] = {low.first, low.second, high.first, high.second};
    if (any(dense)) {
        const I voxel = (at.z + grid.baseZ) * I(cells.slice) + (at.y + grid.baseY) * I(cells.row) + at.x +
                        grid.baseX - I(cells.firstVoxel);
        for (int n = 0; n < 4; ++n) {
            const I away((n & 1 ? cells.row : 0) + (n & 2 ? cells.slice : 0));
            pairs[n] = select(dense, gatherHalves(cells.values, voxel + away, dense), pairs[n]);
        }
    }
    for (int n = 0; n < 4; ++n) setPair(corners, n, pairs[n], F(cells.isovalue));
    return corners;
}

}  // namespace stereonav::STEREONAV_ISA
