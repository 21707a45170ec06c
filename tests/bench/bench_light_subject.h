// What the benchmarks of light measure: the engine of the paper's Table 1 under Grace Cathedral's probe, or,
// where the real data are absent, a made block with holes under a made probe, which is said.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "colon/study/study.h"
#include "engine/light/skies/light_setup.h"
#include "engine/volume/volume.h"

namespace stereonav::bench {

struct LightSubject {
    std::string name;
    GreyVolume volume;
    LightSetup setup;
};

inline std::filesystem::path testData() {
    const char* set = std::getenv("STEREONAV_TEST_DATA");
    if (set) return set;
    for (const char* place : {"../shared/data", "../../shared/data", "../../../../shared/data"})
        if (std::filesystem::exists(place)) return place;
    return {};
}

// The first voxel of the run of `extent` along an axis that holds most of what is bright.
inline int fullestRun(const GreyVolume& volume, int axis, int extent, int bright) {
    std::vector<std::size_t> counts(static_cast<std::size_t>(volume.frame.size[axis]), 0);
    for (int k = 0; k < volume.frame.size.z; ++k)
        for (int j = 0; j < volume.frame.size.y; ++j)
            for (int i = 0; i < volume.frame.size.x; ++i)
                counts[static_cast<std::size_t>(glm::ivec3(i, j, k)[axis])] += volume.at(i, j, k) >= bright;
    int best = 0;
    std::size_t most = 0;
    for (int first = 0; first + extent <= volume.frame.size[axis]; ++first) {
        std::size_t sum = 0;
        for (int n = 0; n < extent; ++n) sum += counts[static_cast<std::size_t>(first + n)];
        if (sum > most) most = sum, best = first;
    }
    return best;
}

inline GreyVolume cropped(const GreyVolume& volume, const glm::ivec3& first, const glm::ivec3& extent) {
    GreyVolume part(volume.frame.cropped(first, extent));
    for (int k = 0; k < extent.z; ++k)
        for (int j = 0; j < extent.y; ++j)
            for (int i = 0; i < extent.x; ++i) part.at(i, j, k) = volume.at(first + glm::ivec3(i, j, k));
    return part;
}

// The paper's 110x208x149 voxels: 110 of the slices, 208 and 149 within them, where most of the metal is.
inline GreyVolume engineVolume(const std::filesystem::path& file) {
    Progress progress;
    const Study study = readStudy(file, {}, progress);
    const glm::ivec3 extent(149, 208, 110);
    glm::ivec3 first;
    for (int axis = 0; axis < 3; ++axis) first[axis] = fullestRun(study.grey, axis, extent[axis], 60);
    return cropped(study.grey, first, extent);
}

inline GreyVolume madeVolume() {
    VolumeFrame frame;
    frame.size = {149, 208, 110};
    frame.spacing = glm::dvec3(1e-3);
    GreyVolume volume(frame);
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 3);
    for (int k = 0; k < 110; ++k)
        for (int j = 0; j < 208; ++j)
            for (int i = 0; i < 149; ++i) {
                const glm::dvec3 p(i - 74, j - 104, k - 55);
                const glm::dvec3 beyond = glm::abs(p) - glm::dvec3(60, 90, 42);
                double inside = -std::max({beyond.x, beyond.y, beyond.z});
                for (int hole = -1; hole <= 1; ++hole)
                    inside = std::min(inside, std::hypot(p.x, p.y - 55 * hole) - 20);
                const double value = 100 + 50 * std::clamp(inside, -2.0, 2.0);
                volume.at(i, j, k) =
                    static_cast<std::int16_t>(value < 20 ? 0 : std::clamp(value + noise(random), 0.0, 255.0));
            }
    return volume;
}

inline LightProbe madeProbe() {
    std::vector<glm::vec3> pixels(128 * 64, glm::vec3(0.4f, 0.5f, 0.7f));
    for (const int lamp : {700, 1320, 2044, 2900})
        pixels[static_cast<std::size_t>(lamp)] = glm::vec3(2000.0f);
    return LightProbe(128, 64, std::move(pixels), "made");
}

inline LightSubject lightSubject() {
    LightSubject subject;
    const std::filesystem::path data = testData();
    const auto engine = data / "ct" / "engine.nii.gz", probe = data / "probes" / "grace.hdr";
    const bool real = std::filesystem::exists(engine) && std::filesystem::exists(probe);
    subject.name = real ? "engine under Grace Cathedral" : "made block under a made probe";
    subject.volume = real ? engineVolume(engine) : madeVolume();
    subject.setup.probe = std::make_shared<LightProbe>(real ? readLightProbe(probe) : madeProbe());
    subject.setup.bounces = 2;
    return subject;
}

}  // namespace stereonav::bench
