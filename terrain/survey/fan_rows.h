// What the kernels of a viewshed read and write: a column of ground across the view, and the bins over it.
// Heights are metres over the eye, slopes metres a column, distances columns, tangents rows a column; rows
// count from the buffer's first. Buffers may be read kPadding values beyond their end.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/simd/kernel_sets.h"

namespace stereonav {

// Bins over a column: the row where the first bin's edge meets it, and from one edge to the next; tangents
// alike.
struct FanBins {
    static constexpr int kPadding = 16;

    int count = 0;
    float row = 0, rowStep = 0;           // rows
    float tangent = 0, tangentStep = 0;   // rows a column
    float fallAlong = 0, fallAcross = 0;  // curvature lowers slopes by along + across * tangent^2
    float slack = 0;                      // metres: more than rounding to floats makes of heights
};

// A column of ground, heights over the eye.
struct ReadRow {
    static constexpr int kTopRows = 16;

    const float* ground = nullptr;  // metres
    std::ptrdiff_t stride = 1;      // from a row to the next
    int count = 0;                  // rows
    // Heights to be fetched early: those so far on in memory, of each kTopRows-th row from `aheadRow`. 0:
    // none.
    int ahead = 0, aheadRow = 0;
    float eye = 0, eyeRest = 0;       // metres: the eye's height is the sum
    float* height = nullptr;          // out: over the eye
    float* tops = nullptr;            // out: the tallest of each kTopRows rows that is known
    float tallest = 0, steepest = 0;  // raised: size of what is known over the eye; from row to row
};

// A column that raises the lower bounds of bins: slopes that every ray in a bin has met.
struct LowRow {
    FanBins bins;                   // over the column; narrower than a row
    const float* height = nullptr;  // NaN: not known
    int rows = 0;                   // 2 or more
    float inverse = 0;              // 1 / distance
    float* low = nullptr;           // slopes; raised
    const float* tops = nullptr;    // ReadRow's
};

// Two columns next to each other that raise the upper bounds of bins over the ground between them.
struct HighRow {
    FanBins bins;                        // edges as `LowRow` has them, over the farther column
    float nearRow = 0, nearRowStep = 0;  // rows, over the nearer column, counted as in the farther one
    const float *near = nullptr, *far = nullptr, *nearTops = nullptr, *farTops = nullptr;  // heights; tops
    int farRows = 0;
    int shift = 0;                          // row k of the farther column is row k + shift of the nearer one
    int nearRows = 0, top = 0;              // top: the last row but one of the ground
    float x = 0;                            // distance of the nearer column
    float inverseNear = 0, inverseFar = 0;  // 1 / distance
    float* edge = nullptr;                  // scratch for one more than the bins
    float *block = nullptr, *high = nullptr;  // slopes; both raised
};

// Samples of a column that are told by the bounds of their bins.
struct SampleRow {
    const float* height = nullptr;  // from the row's first sample on; NaN: not known
    int count = 0;
    float inverse = 0;                   // 1 / distance
    float bin = 0, binStep = 0;          // place of the first sample among the bins, and from one to the next
    float tangent = 0, tangentStep = 0;  // rows a column: the first sample's, and from one to the next
    float fallAlong = 0, fallAcross = 0, slack = 0;  // FanBins has them
    float targetHeight = 0;                          // metres over each
    int bins = 0;
    const float *low = nullptr, *high = nullptr;  // slopes, by bin
    // Bits of samples, 16 in each: those that are not hidden for sure, and of them those above `high`.
    std::uint16_t *open = nullptr, *above = nullptr;
};

// A column that lines are walked over, and how its rows lie to those of the column before it.
struct WalkColumn {
    std::size_t offset = 0;  // place of its heights in WalkRows::heights
    int shift = 0;           // its row k is row k + shift of the column before it
    int top = 0;             // the last row but one of the ground
    float x = 0;             // distance, columns
    float row = 0;           // where the part's first tangent meets it
    float rowBefore = 0;     // where it meets the column before, in rows of this one
};

// Upper bounds of a few columns, and of these and all nearer ones, in the bins that there were.
struct WalkBlock {
    const float *own = nullptr, *before = nullptr;  // slopes, by bin
    int bins = 0;
};

// Samples of column `at` that lines are walked to: rows in its buffer.
struct WalkRows {
    const float* heights = nullptr;       // heights of all columns
    const WalkColumn* columns = nullptr;  // from -1 on, whose distance counts as 0

    int at = 0, first = 0;         // the first column that has bounds
    int lag = 0, blockLength = 0;  // columns
    // The last one is not whole yet.
    const WalkBlock* blocks = nullptr;
    int blockCount = 0;
    float inverse = 0, tangent = 0, width = 0;  // 1 / distance; the part's first tangent, 1 / its width
    float bulgeAlong = 0, bulgeAcross = 0;      // curvature: along + across * tangent^2, metres
    float targetHeight = 0, slack = 0;          // metres: over each sample; of rounding
    float beside = 0;                           // lines whose slope is no more may be hidden up to `first`
    bool holes = false;                         // some of the heights may not be known
    const int* rows = nullptr;                  // the samples
    const std::uint8_t* above = nullptr;        // 1: no bound reaches up to it
    int count = 0;
    std::uint8_t* told = nullptr;  // Told
};
enum Told : std::uint8_t { kToldClear, kToldHidden, kUntold };

STEREONAV_EACH_SET(void readHeights(ReadRow&); void raiseLow(const LowRow&); void raiseHigh(const HighRow&);
                   void tellSamples(const SampleRow&); void walkSamples(const WalkRows&);)

}  // namespace stereonav
