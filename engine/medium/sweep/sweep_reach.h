// Which of the light's texels some eye may still read: light that none will read stays where it is. Tiles of
// pixels are seen in the light's buffer, chunk of slabs by chunk, until no ray of theirs goes on.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/medium/sweep/sweep_geometry.h"
#include "engine/medium/sweep/sweep_space.h"

namespace stereonav {

class SweepReach {
public:
    // Begins with tiles `eyeSide` pixels wide, tiles of light `lightSide` texels wide, and chunks of `chunk`
    // slabs. space: null: nothing is left out. Where too much would have to be remembered all light counts as
    // read.
    void start(const SweepGeometry& geometry, const SweepSpace* space, int chunk, int eyeSide, int lightSide);
    bool known() const { return !mRects.empty(); }
    // Notes that a tile of an eye reads no more for itself. With two eyes the first may sample for the second
    // along the same row of tiles: there its tiles count until none of the second's reads on. Tiles are
    // numbered row by row.
    void drop(std::size_t eye, int tile);
    // Begins a chunk, before it is passed; chunks follow each other.
    void begin(int chunk);
    // Returns the last slab from that chunk on in which a tile of light may be read; below its first: none.
    int lastRead(int lightTile) const { return (mLast[lightTile] + 1) * mChunk - 1; }
    std::size_t heldBytes() const;

private:
    // Tiles of light, from the first to the last; first behind last: none.
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
    std::vector<std::uint8_t> mGone;    // eyes' tiles that read no more
    std::vector<std::uint32_t> mCount;  // by chunk and tile of light: how many tiles of eyes read it
    int mPaired = 0;                    // tiles in a row of both eyes; 0: not two alike
    std::vector<int> mEnd;              // by eyes' tile: the chunk behind the last one in which it reads
    std::vector<int> mLast;             // by tile of light: the last chunk in which it is read
};

}  // namespace stereonav
