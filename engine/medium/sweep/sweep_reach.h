// Which texels of the light some eye may still read: light that no eye will read is not computed any more.
// Tiles of pixels are projected into the light's buffer, chunk of slabs by chunk, until none of their rays
// goes on.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/medium/sweep/sweep_geometry.h"
#include "engine/medium/sweep/sweep_space.h"

namespace stereonav {

class SweepReach {
public:
    // Begins with tiles `eyeSide` pixels wide, tiles of light `lightSide` texels wide, and chunks of `chunk`
    // slabs. space: null: nothing is left out. Where this would take too much memory, all light counts as
    // read.
    void start(const SweepGeometry& geometry, const SweepSpace* space, int chunk, int eyeSide, int lightSide);
    bool known() const { return !mRects.empty(); }
    // Notes that a tile of an eye needs no more light of its own. With two eyes, the first may take samples
    // for the second along the same row of tiles: there its tiles count until no tile of the second reads on.
    // Tiles are numbered row by row.
    void drop(std::size_t eye, int tile);
    // Begins a chunk, before the light passes it; called for each chunk in turn.
    void begin(int chunk);
    // Returns the last slab, in this chunk or later, in which a tile of light may be read; smaller than the
    // chunk's first slab: none.
    int lastRead(int lightTile) const { return (mLast[lightTile] + 1) * mChunk - 1; }
    std::size_t heldBytes() const;

private:
    // A rectangle of tiles of light, first to last; first behind last: empty.
    struct Rect {
        std::uint8_t x0 = 1, y0 = 1, x1 = 0, y1 = 0;
    };
    struct Looking;
    void findRects(const SweepGeometry& geometry, const SweepSpace* space, const RayFan& eye, int eyeSide,
                   int tile, Rect* rects) const;
    Rect rectOf(const Looking& looking, double near, double far) const;
    void release(std::size_t n);
    void releaseRows(int chunk);
    void count(int chunk, const Rect& rect, int by);

    int mChunk = 1, mChunks = 0, mSide = 1, mAcross = 0, mDown = 0;
    std::vector<int> mFirstTile;        // number of each eye's first tile among all
    std::vector<Rect> mRects;           // by eyes' tile and chunk
    std::vector<std::uint8_t> mGone;    // eyes' tiles that need no more light
    std::vector<std::uint32_t> mCount;  // by chunk and tile of light: number of eyes' tiles that read it
    int mPaired = 0;                    // tiles in a row of both eyes; 0: there are no two equal eyes
    std::vector<int> mEnd;              // by eyes' tile: one past the last chunk in which it reads light
    std::vector<int> mLast;             // by tile of light: the last chunk in which it is read
};

}  // namespace stereonav
