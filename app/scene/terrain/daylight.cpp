#include "app/scene/terrain/daylight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/parallel.h"
#include "terrain/light/terrain_light.h"
#include "terrain/scene/ground_color.h"

namespace stereonav {
namespace {

// Returns coarser settings than those of a bake into a file: half the directions for shadows and sky, one
// bounce with half the rays.
TerrainLightSettings settingsFor(const Heightfield& ground, double mostSamples) {
    TerrainLightSettings settings;
    settings.order = 3;
    settings.bounces = 1;
    settings.rays = 16;
    const double samples = double(ground.width()) * ground.height();
    settings.stride = std::max(1, static_cast<int>(std::ceil(std::sqrt(samples / mostSamples))));
    return settings;
}

// Returns the light that `bake` made for this ground: it is better than any computed here.
std::optional<TerrainLight> keptLight(const Heightfield& ground) {
    const std::filesystem::path file = terrainLightCache(ground);
    std::error_code code;
    if (!std::filesystem::exists(file, code)) return std::nullopt;
    try {
        return loadTerrainLight(file, &ground);
    } catch (const Error&) {
        return std::nullopt;  // --light auto reports the error
    }
}

// Returns the light of the plain sun, without cast shadows, for each baked sample: the mean over the ground
// samples that are nearest to it.
std::vector<float> plainLight(const Heightfield& ground, const LightGrid& grid, const GroundLight& light) {
    std::vector<float> mean(grid.count(), 1.0f);
    const int half = grid.stride / 2;
    parallelFor(grid.height, [&](int row) {
        const int south = std::max(0, grid.row(row) - half),
                  north = std::min(ground.height() - 1, grid.row(row) + half);
        for (int column = 0; column < grid.width; ++column) {
            const int west = std::max(0, grid.column(column) - half),
                      east = std::min(ground.width() - 1, grid.column(column) + half);
            double sum = 0;
            for (int j = south; j <= north; ++j)
                for (int i = west; i <= east; ++i)
                    sum += light.at(glm::normalize(glm::dvec3(-ground.gradientAtSample(i, j), 1.0)));
            mean[static_cast<std::size_t>(row) * grid.width + column] =
                static_cast<float>(sum / ((north - south + 1) * (east - west + 1)));
        }
    });
    return mean;
}

}  // namespace

void LitGround::lightAgain(const TerrainLook& look) {
    const LightGrid& grid = light->light().grid;
    if (grid.stride == 1) {
        light->apply(look, color);
    } else {
        const std::vector<float> around = plainLight(terrain->ground, grid, GroundLight(look));
        if (look.sunAzimuth == sunOfColor.azimuth && look.sunElevation == sunOfColor.elevation) {
            light->applyOver(look, *plain, around, color);
        } else {
            Progress quiet;
            const GroundColor now = tintedGround(terrain->ground, look, *terrain->tint, quiet);
            light->applyOver(look, now.texture, around, color);
        }
    }
    sunAzimuth = look.sunAzimuth;
    sunElevation = look.sunElevation;
}

std::string LitGround::source() const {
    const LightGrid& grid = light->light().grid;
    return fmt::format("computed while the window is open, {}x{}", grid.width, grid.height);
}

TerrainDaylight::TerrainDaylight(const TerrainScene& terrain, SimdTarget target)
    : mTerrain(terrain), mLook(terrain.look), mTarget(target) {}

void TerrainDaylight::begin(std::shared_ptr<const ColorTexture> plain) {
    mWork.begin([this, plain = std::move(plain)] { work(plain); });
}

void TerrainDaylight::work(const std::shared_ptr<const ColorTexture>& plain) {
    const Heightfield& ground = mTerrain.ground;
    const double samples = double(ground.width()) * ground.height();
    // Three textures exist at once while new light replaces old.
    checkMemory("light of the ground", 3 * bytesOfTint(samples), "");
    TerrainLook unlit = mLook;
    unlit.ambient = 1;
    const GroundColor albedo = tintedGround(ground, unlit, *mTerrain.tint, mWork.progress());
    const auto show = [&](TerrainLight light) {
        auto lit = std::make_unique<LitGround>();
        lit->light = std::make_unique<TerrainIllumination>(ground, albedo.texture, mTerrain.sky,
                                                           std::move(light), 1.0f, mTarget);
        lit->terrain = &mTerrain;
        lit->plain = plain;
        lit->sunOfColor = {mLook.sunAzimuth, mLook.sunElevation};
        lit->color = albedo.texture;
        lit->lightAgain(mLook);
        mWork.give(std::move(lit));
    };
    if (std::optional<TerrainLight> kept = keptLight(ground)) return show(std::move(*kept));
    int before = 0;
    for (const double most : kMostSamples) {
        const TerrainLightSettings settings = settingsFor(ground, most);
        if (settings.stride == before) break;
        before = settings.stride;
        show(bakeTerrainLight(ground, settings, mWork.progress()));
    }
}

}  // namespace stereonav
