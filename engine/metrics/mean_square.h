// Squared differences summed up over pixels, row by row, so that sums do not depend on threads.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "engine/metrics/image_difference.h"

namespace stereonav {

// A sum of squared differences.
struct MeanSquare {
    double sum = 0;  // squared sRGB levels (0 to 255) over the three channels
    long long pixels = 0;

    // levels: the difference of two pixels, -255 to 255 in each channel.
    void add(const glm::vec3& levels) {
        sum += glm::dot(levels, levels);
        ++pixels;
    }
    void add(const MeanSquare& other) {
        sum += other.sum;
        pixels += other.pixels;
    }
    // Returns the PSNR, at most kIdenticalPsnr_db; NaN without pixels.
    double psnr_db() const {
        if (pixels == 0) return std::numeric_limits<double>::quiet_NaN();
        const double mean = sum / (3.0 * static_cast<double>(pixels));
        return mean > 0 ? std::min(kIdenticalPsnr_db, 10 * std::log10(255.0 * 255.0 / mean))
                        : kIdenticalPsnr_db;
    }
};

// Adds up all rows.
inline MeanSquare sumOf(const std::vector<MeanSquare>& rows) {
    MeanSquare all;
    for (const MeanSquare& row : rows) all.add(row);
    return all;
}

}  // namespace stereonav
