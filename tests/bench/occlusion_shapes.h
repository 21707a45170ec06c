// Distributions of the same family of inputs that the estimates of openness do not use: what other shapes
// would gain. For bench_occlusion --errors alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "engine/volume/volume.h"
#include "tests/oracle/occlusion_formulas.h"

namespace stereonav::bench {

// Numbers of the voxels within a box's radius; share: of those that are not above the middle one.
struct BoxNumbers {
    double value = 0, minimum = 32767, maximum = -32768, mean = 0, variance = 0, share = 0;
};

inline BoxNumbers numbersOfBox(const GreyVolume& volume, const glm::ivec3& voxel, const glm::ivec3& radius) {
    const glm::ivec3 first = glm::max(voxel - radius, 0),
                     last = glm::min(voxel + radius, volume.frame.size - 1);
    BoxNumbers box;
    box.value = volume.at(voxel);
    double count = 0, squares = 0;
    for (int k = first.z; k <= last.z; ++k)
        for (int j = first.y; j <= last.y; ++j)
            for (int i = first.x; i <= last.x; ++i, ++count) {
                const double v = volume.at(i, j, k);
                box.minimum = std::min(box.minimum, v);
                box.maximum = std::max(box.maximum, v);
                box.mean += v;
                squares += v * v;  // whole numbers below 2^53
                box.share += v <= box.value;
            }
    box.mean /= count;
    box.share /= count;
    box.variance = std::max(squares / count - box.mean * box.mean, 0.0);
    return box;
}

// Share of a beta distribution below x in (0, 1), a, b > 0: the continued fraction of the incomplete beta
// function (Abramowitz and Stegun 26.5.8) by Lentz's method.
inline double betaBelow(double x, double a, double b) {
    if (x > (a + 1) / (a + b + 2)) return 1 - betaBelow(1 - x, b, a);
    const double front =
        std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
    const auto kept = [](double v) { return std::abs(v) < 1e-30 ? 1e-30 : v; };
    double c = 1, d = 1 / kept(1 - (a + b) * x / (a + 1)), fraction = d;
    for (int m = 1; m < 500; ++m) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        double change = 1;
        for (const double term : {even, odd}) {
            d = 1 / kept(1 + term * d);
            c = kept(1 + term / c);
            change = c * d;
            fraction *= change;
        }
        if (std::abs(change - 1) < 1e-10) break;
    }
    return front * fraction / a;
}

// The beta distribution with the box's ends, mean and variance.
inline double betaOpenness(const BoxNumbers& box) {
    const double range = box.maximum - box.minimum;
    if (!(range > 0)) return 0.5;
    const double x = (box.value - box.minimum) / range, m = (box.mean - box.minimum) / range;
    const double spread = box.variance / (range * range);
    if (x <= 0 || x >= 1 || !(spread > 0)) return x >= 1;
    const double both = std::max(m * (1 - m) / spread - 1, 1e-3);
    return betaBelow(x, m * both, (1 - m) * both);
}

// The Gaussian of the box's mean and variance, cut off at its ends.
inline double cutGaussianOpenness(const BoxNumbers& box) {
    const auto below = [&](double v) { return gaussianOpenness(v, box.mean, box.variance); };
    const double low = below(box.minimum), high = below(box.maximum);
    return high > low ? (below(box.value) - low) / (high - low) : 0.5;
}

// t^beta between ends that are no farther from the mean than some standard deviations: single voxels do not
// stretch them.
inline double drawnInOpenness(const BoxNumbers& box, double deviations) {
    const double reach = deviations * std::sqrt(box.variance);
    const double low = std::max(box.minimum, box.mean - reach),
                 high = std::min(box.maximum, box.mean + reach);
    return reconstructedOpenness(box.value, low, high, box.mean);
}

}  // namespace stereonav::bench
