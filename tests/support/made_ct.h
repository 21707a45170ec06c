// A CT made from materials: scanner blur and noise over a volume of HU. What is inside is known.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/volume/gaussian.h"
#include "engine/volume/volume.h"

namespace stereonav::test {

// About normal, mean 0, deviation 1, from a voxel's number: the sum of four even numbers.
inline double noiseAt(std::uint64_t n) {
    n = (n + 1) * 0x9E3779B97F4A7C15ull;
    n = (n ^ (n >> 30)) * 0xBF58476D1CE4E5B9ull;
    n = (n ^ (n >> 27)) * 0x94D049BB133111EBull;
    n ^= n >> 31;
    const double sum = static_cast<double>((n & 65535) + (n >> 16 & 65535) + (n >> 32 & 65535) + (n >> 48));
    return (sum / 65535 - 2) * std::sqrt(3.0);
}

// Blurs by a Gaussian of sigma metres and adds noise (HU), slab by slab.
inline GreyVolume scanned(const GreyVolume& truth, double sigma, double noise) {
    const glm::ivec3 size = truth.frame.size;
    GreyVolume ct(truth.frame);
    constexpr int kSlab = 16;
    parallelFor((size.z + kSlab - 1) / kSlab, [&](int slab) {
        BoxSmoother smoother(sigma / truth.frame.spacing);
        const int reach = smoother.reach().z, first = slab * kSlab - reach;
        const std::size_t slice = static_cast<std::size_t>(size.x) * size.y;
        std::vector<float> box(slice * (kSlab + 2 * reach));
        for (int k = 0; k < kSlab + 2 * reach; ++k) {
            const std::int16_t* from = truth.values.data() + std::clamp(first + k, 0, size.z - 1) * slice;
            std::copy_n(from, slice, box.data() + k * slice);
        }
        smoother.smooth(box, {size.x, size.y, kSlab + 2 * reach});
        for (int k = slab * kSlab; k < std::min(size.z, (slab + 1) * kSlab); ++k)
            for (std::size_t n = 0; n < slice; ++n) {
                const double value = box[(k - first) * slice + n] + noise * noiseAt(k * slice + n);
                ct.values[k * slice + n] = static_cast<std::int16_t>(std::lround(value));
            }
    });
    return ct;
}

}  // namespace stereonav::test
