// Light probes for tests: made ones of known content, and the real ones where there are any.
#pragma once

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "engine/light/skies/light_probe.h"

namespace stereonav::test {

// Centre of a pixel as a direction.
inline glm::dvec3 pixelDirection(double column, double row, int width, int height) {
    const double polar = std::numbers::pi * (row + 0.5) / height;
    const double azimuth = 2 * std::numbers::pi * ((column + 0.5) / width - 0.5);
    return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
}

inline LightProbe probeOf(int width, int height,
                          const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
    std::vector<glm::vec3> pixels;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i)
            pixels.push_back(glm::vec3(radiance(pixelDirection(i, j, width, height))));
    return LightProbe(width, height, std::move(pixels), "made");
}

// Every pixel something else, over four decades, a fifth of them black.
inline LightProbe randomProbe(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<glm::vec3> pixels;
    for (int n = 0; n < width * height; ++n) {
        const float level = unit(random) < 0.2f ? 0.0f : std::pow(10.0f, 4 * unit(random) - 2);
        const float red = unit(random), green = unit(random);
        pixels.push_back(level * glm::vec3(red, green, unit(random)));
    }
    return LightProbe(width, height, std::move(pixels), "random");
}

// Returns an empty path where there is no real data.
inline std::filesystem::path realProbe(const char* name) {
    const char* set = std::getenv("STEREONAV_TEST_DATA");
    const std::filesystem::path folder =
        set ? std::filesystem::path(set)
            : std::filesystem::path(STEREONAV_SOURCE_DIR) / ".." / "shared" / "data";
    const std::filesystem::path file = folder / "probes" / name;
    return std::filesystem::exists(file) ? file : std::filesystem::path();
}

}  // namespace stereonav::test
