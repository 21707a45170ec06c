// The smallest and the largest value of a volume.
#pragma once

#include <cstddef>
#include <limits>

#include "engine/volume/volume.h"

namespace stereonav {

struct ValueSpan {
    double lowest = 0, highest = 0;  // values, as GreyVolume has them: stored * scale + offset
};

// Returns the least and the largest value of every voxel, or of some spread evenly where there are more than
// `mostSamples`; 0 to 0 without voxels.
ValueSpan rangeOf(const GreyVolume& grey, std::size_t mostSamples = 4'000'000);

// Returns the least and the largest value of the whole grid.
inline ValueSpan wholeRangeOf(const GreyVolume& grey) {
    return rangeOf(grey, std::numeric_limits<std::size_t>::max());
}

}  // namespace stereonav
