// What the kernels of a viewshed read and write: a column of ground across the view, and the bins over it.
// Heights are metres over the eye, rows count from the buffer's first. Buffers may be read kPadding values
// beyond their end.
#pragma once

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

struct LowRow {
    FanBins bins;                   // over the column; narrower than a row
    const float* height = nullptr;  // NaN: not known
    int rows = 0;                   // 2 or more
    float inverse = 0;              // one over the distance in columns
    float* low = nullptr;           // slopes a column; raised
};

// Of two columns and three rows the tallest: rows are those that either column has, and the buffer `tallest`
// is two longer.
struct TallRow {
    const float *near = nullptr, *far = nullptr;  // no NaN
    int nearStart = 0, nearRows = 0, farStart = 0, farRows = 0, rows = 0;
    float* tallest = nullptr;
};

struct HighRow {
    FanBins bins;                        // edges as `LowRow` has them, over the farther of two columns
    float nearRow = 0, nearRowStep = 0;  // over the nearer one
    const float* tallest = nullptr;      // of both columns and three rows: this and the next two
    int rows = 0;                        // of `tallest`
    float inverseNear = 0, inverseFar = 0;
    float* high = nullptr;
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

STEREONAV_EACH_SET(void raiseLow(const LowRow&); void findTallest(const TallRow&);
                   void raiseHigh(const HighRow&); void tellSamples(const SampleRow&);)

}  // namespace stereonav
