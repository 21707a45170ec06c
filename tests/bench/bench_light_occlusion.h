// What bench_occlusion and bench_light share: the volume of Ruiz et al.'s size, made of a real study where
// one is found (STEREONAV_TEST_DATA or ../shared/data) and of waves otherwise, and the marks measured on it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <glm/common.hpp>
#include <string>

#include "colon/study/study.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/light/occlusion/occlusion.h"

namespace stereonav::bench {

inline std::filesystem::path dataFolder() {
    const char* folder = std::getenv("STEREONAV_TEST_DATA");
    return folder ? folder : "../shared/data";
}

// Empty where the file is not there.
inline GreyVolume readGrey(const std::string& name) {
    const std::filesystem::path file = dataFolder() / name;
    if (!std::filesystem::exists(file)) return {};
    Progress progress;
    return readStudy(file, {}, progress).grey;
}

// Trilinear, from the first to the last voxel along each axis.
inline GreyVolume resampled(const GreyVolume& from, const glm::ivec3& size) {
    VolumeFrame frame = from.frame;
    const glm::dvec3 step = glm::dvec3(from.frame.size - 1) / glm::dvec3(glm::max(size - 1, 1));
    frame.size = size;
    frame.spacing *= step;
    GreyVolume to(frame);
    to.scale = from.scale;
    to.offset = from.offset;
    parallelFor(size.z, [&](int k) {
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                const glm::dvec3 at = glm::dvec3(i, j, k) * step;
                const glm::ivec3 cell =
                    glm::clamp(glm::ivec3(at), glm::ivec3(0), glm::max(from.frame.size - 2, 0));
                const glm::dvec3 p = at - glm::dvec3(cell);
                double sum = 0;
                for (int n = 0; n < 8; ++n) {
                    const glm::ivec3 o(n & 1, n >> 1 & 1, n >> 2);
                    const double weight =
                        (o.x ? p.x : 1 - p.x) * (o.y ? p.y : 1 - p.y) * (o.z ? p.z : 1 - p.z);
                    if (weight > 0) sum += weight * from.at(cell + o);
                }
                to.at(i, j, k) = static_cast<std::int16_t>(std::lround(sum));
            }
    });
    return to;
}

// The size of Ruiz et al.'s CT-body.
inline GreyVolume occlusionBody() {
    const glm::ivec3 size(256, 256, 415);
    const GreyVolume trunk = readGrey("ct/trunk_ct_3mm.nii.gz");
    if (!trunk.empty()) return resampled(trunk, size);
    GreyVolume waves(VolumeFrame{size, glm::dvec3(1e-3)});
    parallelFor(size.z, [&](int k) {
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                waves.at(i, j, k) = static_cast<std::int16_t>(std::lround(
                    1000 * (std::sin(0.1 * i) + std::sin(0.13 * j) + std::sin(0.07 * k + 0.1 * i))));
    });
    return waves;
}

// Least of some runs.
template <typename Body>
double leastTime_ms(int runs, const Body& body) {
    double least = 1e30;
    for (int n = 0; n < runs; ++n) {
        const Stopwatch watch;
        body();
        least = std::min(least, watch.elapsed_ms());
    }
    return least;
}

inline double opennessTime_ms(const GreyVolume& volume, OcclusionMethod method, int radius, int runs = 5) {
    Progress progress;
    return leastTime_ms(runs, [&] { estimateOpenness(volume, method, glm::ivec3(radius), progress); });
}

// "name value" lines: R1 at the radius that takes longest, and its time at radius 40 over that at radius 5;
// least of some rounds, the radii taken in turn so that what else the machine does meets all of them.
inline void printOcclusionMarks() {
    const GreyVolume body = occlusionBody();
    constexpr std::array kRadii{1, 5, 10, 40, 64};
    std::array<double, kRadii.size()> least{};
    least.fill(1e30);
    for (int round = 0; round < 7; ++round)
        for (std::size_t n = 0; n < kRadii.size(); ++n)
            least[n] =
                std::min(least[n], opennessTime_ms(body, OcclusionMethod::Reconstructed, kRadii[n], 1));
    std::printf("ao_r1_ms %.1f\nao_radius_ratio %.3f\n", *std::max_element(least.begin(), least.end()),
                least[3] / least[1]);
}

}  // namespace stereonav::bench
