// What the kernels of a viewshed read and write: a column of ground across the view, and the bins over it.
// Heights are metres over the eye, rows count from the buffer's first. Buffers may be read kPadding values
// beyond their end.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/simd/kernel_sets.h"

namespace stereonav {

// Bins over a column: the row where the first bin's edge meets it, and from one edge to the next; the
// tangents alike.
struct FanBins {
    static constexpr int kPadding = 16;

    int count = 0;
    float row = 0, rowStep = 0;
    float tangent = 0, tangentStep = 0;
    float fallAlong = 0, fallAcross = 0;  // what curvature takes from slopes: along + across * tangent^2
    float slack = 0;                      // metres: more than rounding to floats makes of heights
};

// A column of ground, heights over the eye.
struct ReadRow {
    static constexpr int kTopRows = 16;

    const float* ground = nullptr;
    std::ptrdiff_t stride = 1;  // from a row to the next
    int count = 0;              // rows
    // Heights that are asked for soon: so far on, of each kTopRows-th row from `aheadRow`. 0: none.
    int ahead = 0, aheadRow = 0;
    float eye = 0, eyeRest = 0;       // both together its height
    float* height = nullptr;          // over the eye
    float* tops = nullptr;            // the tallest of each kTopRows rows that is known
    float tallest = 0, steepest = 0;  // raised: of what is known, from the eye, and from row to row
};

struct LowRow {
    FanBins bins;                   // over the column; narrower than a row
    const float* height = nullptr;  // NaN: not known
    int rows = 0;                   // 2 or more
    float inverse = 0;              // one over the distance in columns
    float* low = nullptr;           // slopes a column; raised
    const float* tops = nullptr;    // of ReadRow
};

// Two columns next to each other, and the bins over the ground between them.
struct HighRow {
    FanBins bins;                        // edges as `LowRow` has them, over the farther column
    float nearRow = 0, nearRowStep = 0;  // over the nearer one, in rows of the farther one
    const float *near = nullptr, *far = nullptr, *nearTops = nullptr, *farTops = nullptr;
    int farRows = 0;
    int shift = 0;              // row k of the farther column is row k + shift of the nearer one
    int nearRows = 0, top = 0;  // top: the last row but one of the ground
    float x = 0;                // distance of the nearer column
    float inverseNear = 0, inverseFar = 0;
    float* edge = nullptr;                    // scratch for one more than the bins
    float *block = nullptr, *high = nullptr;  // both raised
};

struct SampleRow {
    const float* height = nullptr;  // from the row's first sample on; NaN: not known
    int count = 0;
    float inverse = 0;
    float bin = 0, binStep = 0;          // place of the first sample among the bins, and from one to the next
    float tangent = 0, tangentStep = 0;  // of the samples
    float fallAlong = 0, fallAcross = 0, slack = 0;
    float targetHeight = 0;  // metres over each
    int bins = 0;
    const float *low = nullptr, *high = nullptr;
    // Bits of samples, 16 in each: those that are not hidden for sure, and of them those above `high`.
    std::uint16_t *open = nullptr, *above = nullptr;
};

// A column that lines are walked over, and how its rows lie to those of the column before it.
struct WalkColumn {
    std::size_t offset = 0;  // of its heights
    int shift = 0;           // its row k is row k + shift of the column before it
    int top = 0;             // the last row but one of the ground
    float x = 0;             // distance
    float row = 0;           // where the part's first tangent meets it
    float rowBefore = 0;     // and meets the column before it, in rows of this one
};

// Upper bounds of a few columns, and of them and all nearer ones, in the bins that there were.
struct WalkBlock {
    const float *own = nullptr, *before = nullptr;
    int bins = 0;
};

// Samples of column `at`: rows in its buffer.
struct WalkRows {
    const float* heights = nullptr;
    const WalkColumn* columns = nullptr;  // from -1 on, which counts from where the eye is

    int at = 0, first = 0;         // the first column that has bounds
    int lag = 0, blockLength = 0;  // columns
    // The last one is not whole yet.
    const WalkBlock* blocks = nullptr;
    int blockCount = 0;
    float inverse = 0, tangent = 0, width = 0;  // of the part: its first tangent, one over its width
    float bulgeAlong = 0, bulgeAcross = 0;      // curvature: along + across * tangent^2, metres
    float targetHeight = 0, slack = 0;
    float beside = 0;    // slopes that are no more may be hidden up to `first`
    bool holes = false;  // some of the heights may not be known
    const int* rows = nullptr;
    const std::uint8_t* above = nullptr;  // 1: no bound reaches up to it
    int count = 0;
    std::uint8_t* told = nullptr;  // Told
};
enum Told : std::uint8_t { kToldClear, kToldHidden, kUntold };

STEREONAV_EACH_SET(void readHeights(ReadRow&); void raiseLow(const LowRow&); void raiseHigh(const HighRow&);
                   void tellSamples(const SampleRow&); void walkSamples(const WalkRows&);)

}  // namespace stereonav
