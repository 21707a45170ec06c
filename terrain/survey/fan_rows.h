// Data that the kernels of a viewshed read and write: a column of ground across the view, and the bins over
// it. Heights are metres above the eye, slopes metres per column, distances columns, tangents rows per
// column; rows count from the buffer's first. Buffers may be read kPadding values beyond their end.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/simd/kernel_sets.h"

namespace stereonav {

// Bins over a column: the row of the first bin's edge, and the step from one edge to the next; the same as
// tangents.
struct FanBins {
    static constexpr int kPadding = 16;

    int count = 0;
    float row = 0, rowStep = 0;           // rows
    float tangent = 0, tangentStep = 0;   // rows a column
    float fallAlong = 0, fallAcross = 0;  // curvature lowers slopes by along + across * tangent^2
    float slack = 0;                      // metres: bound of rounding errors of heights in floats
};

// A column of ground, heights over the eye.
struct ReadRow {
    static constexpr int kTopRows = 16;

    const float* ground = nullptr;  // metres
    std::ptrdiff_t stride = 1;      // step from a row to the next
    int count = 0;                  // rows
    // Heights to prefetch: `ahead` values farther in memory, for each kTopRows-th row from `aheadRow`. 0:
    // none.
    int ahead = 0, aheadRow = 0;
    float eye = 0, eyeRest = 0;  // metres: the eye's height is the sum
    float* height = nullptr;     // output: above the eye
    float* tops = nullptr;       // output: the largest known height of each kTopRows rows
    // Running maxima: size of heights above the eye; difference from row to row.
    float tallest = 0, steepest = 0;
};

// A column that raises the lower bounds of bins: slopes that the ground reaches on every ray in a bin.
struct LowRow {
    FanBins bins;                   // over the column; narrower than a row
    const float* height = nullptr;  // NaN: unknown
    int rows = 0;                   // 2 or more
    float inverse = 0;              // 1 / distance
    float* low = nullptr;           // slopes; raised here
    const float* tops = nullptr;    // ReadRow::tops
};

// Two neighbouring columns that raise the upper bounds of bins over the ground between them.
struct HighRow {
    FanBins bins;                        // edges as in LowRow, over the farther column
    float nearRow = 0, nearRowStep = 0;  // rows, over the nearer column, counted as in the farther one
    const float *near = nullptr, *far = nullptr, *nearTops = nullptr, *farTops = nullptr;  // heights; tops
    int farRows = 0;
    int shift = 0;                          // row k of the farther column is row k + shift of the nearer one
    int nearRows = 0, top = 0;              // top: index of the ground's last row but one
    float x = 0;                            // distance of the nearer column
    float inverseNear = 0, inverseFar = 0;  // 1 / distance
    float* edge = nullptr;                  // scratch memory for one value more than the bins
    float *block = nullptr, *high = nullptr;  // slopes; both raised here
};

// Samples of a column whose visibility follows from the bounds of their bins.
struct SampleRow {
    const float* height = nullptr;  // from the row's first sample on; NaN: unknown
    int count = 0;
    float inverse = 0;                   // 1 / distance
    float bin = 0, binStep = 0;          // position of the first sample among the bins; step to the next
    float tangent = 0, tangentStep = 0;  // rows per column: of the first sample; step to the next
    float fallAlong = 0, fallAcross = 0, slack = 0;  // those of FanBins
    float targetHeight = 0;                          // metres above each sample
    int bins = 0;
    const float *low = nullptr, *high = nullptr;  // slopes, by bin
    // Bits of samples, 16 in each: those that are not certainly hidden; of these, those above `high`.
    std::uint16_t *open = nullptr, *above = nullptr;
};

// A column that lines of sight pass, and the shift of its rows against those of the column before it.
struct WalkColumn {
    std::size_t offset = 0;  // place of its heights in WalkRows::heights
    int shift = 0;           // its row k is row k + shift of the column before it
    int top = 0;             // index of the ground's last row but one
    float x = 0;             // distance, columns
    float row = 0;           // row where the part's first tangent meets the column
    float rowBefore = 0;     // the same for the column before, in rows of this one
};

// Upper bounds of a few columns, and of these together with all nearer ones, by the bins of that time.
struct WalkBlock {
    const float *own = nullptr, *before = nullptr;  // slopes, by bin
    int bins = 0;
};

// Samples of column `at` whose lines of sight are walked: rows in its buffer.
struct WalkRows {
    const float* heights = nullptr;       // heights of all columns
    const WalkColumn* columns = nullptr;  // from column -1 on, whose distance counts as 0

    int at = 0, first = 0;         // the first column that has bounds
    int lag = 0, blockLength = 0;  // columns
    // The last block may be incomplete.
    const WalkBlock* blocks = nullptr;
    int blockCount = 0;
    float inverse = 0, tangent = 0, width = 0;  // 1 / distance; the part's first tangent, 1 / its width
    float bulgeAlong = 0, bulgeAcross = 0;      // curvature: along + across * tangent^2, metres
    float targetHeight = 0, slack = 0;          // metres: above each sample; bound of rounding errors
    // Lines with at most this slope may be hidden before column `first`.
    float beside = 0;
    bool holes = false;                   // some of the heights may be unknown
    const int* rows = nullptr;            // the samples
    const std::uint8_t* above = nullptr;  // 1: above all upper bounds
    int count = 0;
    std::uint8_t* told = nullptr;  // output: Told
};
enum Told : std::uint8_t { kToldClear, kToldHidden, kUntold };

STEREONAV_EACH_SET(void readHeights(ReadRow&); void raiseLow(const LowRow&); void raiseHigh(const HighRow&);
                   void tellSamples(const SampleRow&); void walkSamples(const WalkRows&);)

}  // namespace stereonav
