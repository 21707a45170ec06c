// Small volumes and random numbers that the tests of volumes share.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "engine/image/packed_color.h"
#include "engine/volume/volume.h"

namespace stereonav::test {

// A frame that is turned, shifted and not isotropic.
inline VolumeFrame slantedFrame(const glm::ivec3& size,
                                const glm::dvec3& spacing = {0.8e-3, 0.7e-3, 1.1e-3}) {
    VolumeFrame frame;
    frame.size = size;
    frame.spacing = spacing;
    frame.origin = {0.3, -0.1, 0.05};
    frame.axes = glm::mat3_cast(glm::normalize(glm::dquat(0.9, 0.2, -0.3, 0.15)));
    return frame;
}

template <typename Function>  // std::int16_t-like value(voxel)
GreyVolume greyVolume(const VolumeFrame& frame, Function value) {
    GreyVolume volume(frame);
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i)
                volume.at(i, j, k) = static_cast<std::int16_t>(std::lround(value(glm::dvec3(i, j, k))));
    return volume;
}

class Random {
public:
    explicit Random(unsigned seed) : mEngine(seed) {}
    double between(double low, double high) {
        return low + (high - low) * (static_cast<double>(mEngine()) / 4294967296.0);
    }
    int below(int count) { return static_cast<int>(between(0, count)); }
    glm::dvec3 inBox(const glm::dvec3& low, const glm::dvec3& high) {
        const double x = between(low.x, high.x), y = between(low.y, high.y);
        return {x, y, between(low.z, high.z)};
    }
    glm::dvec3 direction() {
        for (;;) {
            const glm::dvec3 v = inBox(glm::dvec3(-1), glm::dvec3(1));
            const double length = glm::length(v);
            if (length > 0.1 && length < 1) return v / length;
        }
    }

private:
    std::mt19937 mEngine;
};

// The largest difference of packed channels, each 0..1023.
inline int channelDifference(PackedColor a, PackedColor b) {
    int worst = 0;
    for (const int shift : {0, 10, 20})
        worst = std::max(
            worst, std::abs(static_cast<int>(a >> shift & 1023u) - static_cast<int>(b >> shift & 1023u)));
    return worst;
}

}  // namespace stereonav::test
