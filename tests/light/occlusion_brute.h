// What the filters of occlusion must find, voxel by voxel over whole boxes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <glm/common.hpp>

#include "engine/light/occlusion/occlusion.h"
#include "tests/oracle/occlusion_formulas.h"

namespace stereonav::test {

inline constexpr std::array kOcclusionMethods{OcclusionMethod::Reconstructed, OcclusionMethod::DrawnIn,
                                              OcclusionMethod::Gaussian, OcclusionMethod::Chebyshev};

__extension__ typedef __int128 Wide;

struct Box {
    std::int64_t count = 0, sum = 0, squares = 0, notAbove = 0;
    int low = 32767, high = -32768;
    double mean() const { return static_cast<double>(sum) / static_cast<double>(count); }
    // count * squares - sum^2 in whole numbers of 128 bits
    double variance() const {
        const auto n = static_cast<Wide>(count);
        const Wide exact = n * squares - static_cast<Wide>(sum) * sum;
        return static_cast<double>(exact) / static_cast<double>(n * n);
    }
};

inline Box boxAt(const GreyVolume& volume, const glm::ivec3& voxel, const glm::ivec3& radius) {
    Box box;
    const glm::ivec3 first = glm::max(voxel - radius, 0),
                     last = glm::min(voxel + radius, volume.frame.size - 1);
    const int own = volume.at(voxel);
    for (int k = first.z; k <= last.z; ++k)
        for (int j = first.y; j <= last.y; ++j)
            for (int i = first.x; i <= last.x; ++i) {
                const int v = volume.at(i, j, k);
                ++box.count;
                box.sum += v;
                box.squares += static_cast<std::int64_t>(v) * v;
                box.notAbove += v <= own;
                box.low = std::min(box.low, v);
                box.high = std::max(box.high, v);
            }
    return box;
}

inline double opennessOf(const Box& box, double value, const OcclusionEstimate& estimate) {
    switch (estimate.method) {
        case OcclusionMethod::Gaussian:
            return gaussianOpenness(value, box.mean(), box.variance());
        case OcclusionMethod::Chebyshev:
            return chebyshevOpenness(value, box.mean(), box.variance());
        case OcclusionMethod::DrawnIn:
            return drawnInOpenness(value, box.low, box.high, box.mean(), box.variance(), estimate.deviations);
        default:
            return reconstructedOpenness(value, box.low, box.high, box.mean(), estimate.beta);
    }
}

// How far a byte is from a share of 0..1, in units of the byte; 0.5 is rounding alone.
inline double bytesAway(std::uint8_t byte, double share) {
    return std::abs(byte - 255 * share);
}

}  // namespace stereonav::test
