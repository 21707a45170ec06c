// Heightfields for tests: flat, tilted, smooth, rough, spiked, cliffed, with a hole; and real ones where the
// real data are available.
#pragma once

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "terrain/ground/heightfield.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav::test {

inline Heightfield makeGround(const std::string& kind, int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<float> h(static_cast<std::size_t>(width) * height);
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
            const float x = static_cast<float>(i), y = static_cast<float>(j);
            float z = 0;
            if (kind == "tilted") z = 3.0f * x - 2.0f * y;
            if (kind == "smooth")
                z = 60.0f * std::sin(x * 0.21f) * std::cos(y * 0.17f) + 90.0f * std::sin(x * 0.05f);
            if (kind == "rough") z = 40.0f * unit(random);
            if (kind == "spiked") z = unit(random) < 0.01f ? 1000.0f : 2.0f * unit(random);
            if (kind == "cliffed") z = (i / 9 + j / 7) % 2 == 0 ? 300.0f : 0.0f;
            if (kind == "holed") z = 20.0f * std::sin(x * 0.3f) + 20.0f * std::cos(y * 0.2f);
            h[static_cast<std::size_t>(j) * width + i] = z;
        }
    if (kind == "holed")
        for (int j = height / 3; j < height / 2; ++j)
            for (int i = width / 3; i < width / 2; ++i)
                h[static_cast<std::size_t>(j) * width + i] = std::numeric_limits<float>::quiet_NaN();
    return Heightfield(width, height, {30.0, 25.0}, std::move(h), kind);
}

inline std::vector<std::string> groundKinds() {
    return {"flat", "tilted", "smooth", "rough", "spiked", "cliffed", "holed"};
}

// Returns a scene around a ground: checkered colour with detail, the built-in sky, nothing else.
inline TerrainScene makeScene(Heightfield ground) {
    TerrainScene scene;
    const int width = 2 * ground.width(), height = 2 * ground.height();
    Plane<PackedColor> color(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float tile = (x / 8 + y / 8) % 2 == 0 ? 0.6f : 0.2f;
            color.at(x, y) = packColor({tile, 0.4f + 0.2f * std::sin(0.3f * static_cast<float>(x)),
                                        0.3f + 0.2f * std::cos(0.4f * static_cast<float>(y))});
        }
    const glm::dvec2 perTexel =
        glm::dvec2(ground.width() - 1, ground.height() - 1) / glm::dvec2(width, height);
    scene.color = ColorTexture(color, {0.0, 0.0}, perTexel);
    scene.sky = SkyMap(64, gradientSky);
    scene.ground = std::move(ground);
    return scene;
}

// Returns the folder of the real test data, empty where there is none.
inline std::filesystem::path realData() {
    if (const char* set = std::getenv("STEREONAV_TEST_DATA")) return set;
    const std::filesystem::path beside =
        std::filesystem::path(STEREONAV_SOURCE_DIR) / ".." / "shared" / "data";
    return std::filesystem::exists(beside) ? beside : std::filesystem::path();
}

}  // namespace stereonav::test
