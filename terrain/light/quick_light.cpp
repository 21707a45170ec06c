#include "terrain/light/quick_light.h"

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.h"
#include "terrain/light/terrain_horizon.h"

namespace stereonav {
namespace {

int strideFor(const Heightfield& ground, double most) {
    const double samples = double(ground.width()) * ground.height();
    return std::max(1, static_cast<int>(std::ceil(std::sqrt(samples / most))));
}

// The share of an open sky's light that a slope takes.
double shareOfSlope(const glm::dvec3& normal) {
    return 0.5 * (1 + normal.z);
}

}  // namespace

TerrainLightSettings sparseSettings(const Heightfield& ground, double most) {
    TerrainLightSettings settings;
    settings.kind = TerrainLightKind::Openness;
    settings.azimuths = 16;
    settings.stride = strideFor(ground, most);
    return settings;
}

TerrainLight sparseOpenness(const Heightfield& ground, double most, Progress& progress) {
    return bakeTerrainLight(ground, sparseSettings(ground, most), progress);
}

TerrainLight spreadOpenness(const Heightfield& ground, const TerrainLight& sparse) {
    TerrainLight light;
    light.settings = sparse.settings;
    light.settings.stride = strideFor(ground, kMostLitSamples);
    light.grid = LightGrid(ground, light.settings.stride);
    light.openness.resize(light.grid.count());
    // What hides the sky from a sparse sample beyond its own slope.
    const LightGrid& from = sparse.grid;
    std::vector<float> hides(from.count());
    parallelFor(from.height, [&](int j) {
        for (int i = 0; i < from.width; ++i) {
            const std::size_t k = static_cast<std::size_t>(j) * from.width + i;
            const double slope = shareOfSlope(sampleNormal(ground, from.column(i), from.row(j)));
            const bool known = std::isfinite(ground.sample(from.column(i), from.row(j)));
            hides[k] = known ? static_cast<float>(std::min(1.0, sparse.openness[k] / (255 * slope))) : 1.0f;
        }
    });
    parallelFor(light.grid.height, [&](int j) {
        const int row = light.grid.row(j);
        const LightGrid::Place y = from.placeY(row);
        for (int i = 0; i < light.grid.width; ++i) {
            const int column = light.grid.column(i);
            const LightGrid::Place x = from.placeX(column);
            const float* south = hides.data() + static_cast<std::size_t>(y.index) * from.width + x.index;
            const float* north = south + from.width;
            const float a = south[0] + x.next * (south[1] - south[0]),
                        b = north[0] + x.next * (north[1] - north[0]), mixed = a + y.next * (b - a);
            light.openness[static_cast<std::size_t>(j) * light.grid.width + i] = static_cast<std::uint8_t>(
                255 * mixed * shareOfSlope(sampleNormal(ground, column, row)) + 0.5);
        }
    });
    return light;
}

double bytesOfQuickLight(double samples) {
    // Maxima of heights while horizons are looked for; brightness, normals, what parts of tiled ground take,
    // heights, openness and shadow.
    constexpr double kMaxima = 4 * 4.0 / 3, kLit = 12 + 12 + 12 + 4 + 1 + 1;
    return kMaxima * samples + kLit * std::min(samples, 1.5 * kMostLitSamples) + 8e6;
}

}  // namespace stereonav
