// Arguments of the distance transform's kernels: plain numbers only, since they are compiled for several
// instruction sets.
#pragma once

#include <cstddef>
#include <cstdint>

namespace stereonav {

// A plane of squared distances, `lines` rows of `columns` numbers; rows are combined with their neighbours
// above and below.
struct DistancePlane {
    // Squared lengths: columns a line, gap-free, columns a multiple of kDistanceChunk.
    const float* from = nullptr;
    int lines = 0;
    int begin = 0, end = 0;  // the lines that are wanted
    int columns = 0;
    float weight = 1;                           // squared distance of neighbouring lines
    bool seedsBelow = true, seedsAbove = true;  // whether line -1, and line `lines`, is all seeds
};

// Columns in a chunk: the most lanes that a kernel has.
constexpr int kDistanceChunk = 16;

// Squared distances to units: the largest q with q * q * squaredUnit <= squared * keep.
struct DistanceUnits {
    float perLength = 1;     // units a length
    double squaredUnit = 1;  // squared length of a unit
    double keep = 1;         // share, near 1: what rounding may have added is taken away
};

struct DistanceKernels {
    // Writes squared distances to to + (line - begin) * stride. Where a chunk holds no more than 0, nothing
    // is written.
    void (*combine)(const DistancePlane& plane, float* to, std::ptrdiff_t stride);
    // Writes units to to + (line - begin) * stride; of the columns `width` are written, and nothing where all
    // are 0.
    void (*finish)(const DistancePlane& plane, const DistanceUnits& units, std::uint16_t* to,
                   std::ptrdiff_t stride, int width);
};

}  // namespace stereonav
