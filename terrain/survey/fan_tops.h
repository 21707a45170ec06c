// Finds bins that a column can not raise, from the largest heights of groups of its rows; for kernels.
#pragma once

#include <limits>

#include "engine/simd/simd.h"
#include "terrain/survey/fan_rows.h"

namespace stereonav::STEREONAV_ISA {

// Returns a height in metres above the eye that is at least that of the surface between two rows, and a row
// beside them. tops: ReadRow::tops.
STEREONAV_INLINE float tallestBetween(const float* tops, int rows, float from, float to) {
    const auto group = [&](float row) {
        const int whole = static_cast<int>(row);
        return (whole < 0 ? 0 : whole > rows - 1 ? rows - 1 : whole) / ReadRow::kTopRows;
    };
    float most = std::numeric_limits<float>::lowest();
    for (int k = group(from - 1.0f); k <= group(to + 2.0f); ++k) most = tops[k] > most ? tops[k] : most;
    return most;
}

}  // namespace stereonav::STEREONAV_ISA
