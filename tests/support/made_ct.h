// A CT made from materials: scanner blur and noise over a volume of HU. Its content is known.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/volume/gaussian.h"
#include "engine/volume/volume.h"

namespace stereonav::test {

// hu: function of metres from the first voxel; voxels are cubic.
inline GreyVolume filled(const glm::ivec3& size, double spacing, const std::function<int(glm::dvec3)>& hu) {
    VolumeFrame frame;
    frame.size = size;
    frame.spacing = glm::dvec3(spacing);
    GreyVolume study(frame);
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                study.at(i, j, k) = static_cast<std::int16_t>(hu(glm::dvec3(i, j, k) * spacing));
    return study;
}

// Returns noise, about normal, with mean 0 and deviation 1, from a voxel's number: the sum of four uniform
// numbers.
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

// A body with a straight tube of radius 12 mm up the z axis, fluid behind y = 0.058, a bone beside it, lungs
// on top.
struct TubeBody {
    static constexpr double kSpacing = 0.001;
    static double tube(glm::dvec3 p) {
        const double ends = std::max(0.02 - p.z, p.z - 0.09);
        return std::max(glm::length(glm::dvec2(p.x - 0.06, p.y - 0.055)) - 0.012, ends);
    }
    static bool bone(glm::dvec3 p) {
        return glm::length(glm::dvec2(p.x - 0.06, p.y - 0.080)) < 0.010 && p.z > 0.005 && p.z < 0.11;
    }
    static int hu(glm::dvec3 p) {
        const glm::dvec2 d((p.x - 0.06) / 0.055, (p.y - 0.055) / 0.05);
        if (glm::dot(d, d) > 1) return -1000;
        if (tube(p) < 0) return p.y > 0.058 ? 400 : -1000;
        return bone(p) ? 700 : 40;
    }
};

}  // namespace stereonav::test
