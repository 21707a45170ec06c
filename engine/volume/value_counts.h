// How often each value occurs in a volume, and that as bars to draw.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/progress.h"
#include "engine/volume/volume.h"

namespace stereonav {

// A histogram over stored numbers.
struct ValueCounts {
    std::vector<std::uint64_t> counts;  // by stored number + 32768; empty: nothing was counted
    double scale = 1, offset = 0;       // value = stored * scale + offset

    bool empty() const { return counts.empty(); }
    // The smallest and the largest value that occur; 0 without any.
    double lowest() const;
    double highest() const;
};

// Counts values. border: voxels at each face that are left out. near: of the same frame, only what lies
// within some voxels of what is inside it counts; null: all. Any thread; throws Cancelled.
ValueCounts countValues(const GreyVolume& grey, int border, const MaskVolume* near, Progress& progress);

// Returns bars over equal parts of low..high: the logarithm of how many voxels have a value there, as a share
// of the highest bar's. All 0 where low < high is false.
std::vector<float> barsOf(const ValueCounts& counts, double low, double high, int bars);

}  // namespace stereonav
