#include "app/scene/terrain/finer_sky.h"

#include <fmt/format.h>

#include <filesystem>
#include <iterator>

#include "engine/base/cache.h"
#include "engine/base/error.h"
#include "terrain/light/quick_light.h"

namespace stereonav {
namespace {

// Named by the ground and the settings of the last step.
std::filesystem::path skyCache(const Heightfield& ground) {
    constexpr double kFinest = FinerSky::kMostSamples[std::size(FinerSky::kMostSamples) - 1];
    return keptFile(
        fmt::format("terrain-sky-{:016x}.bin", terrainLightKey(ground, sparseSettings(ground, kFinest))));
}

std::optional<TerrainLight> keptSky(const Heightfield& ground) {
    try {
        const std::filesystem::path file = skyCache(ground);
        std::error_code code;
        if (!std::filesystem::exists(file, code)) return std::nullopt;
        std::optional<TerrainLight> light = loadTerrainLight(file, &ground);
        noteUse(file);
        return light;
    } catch (const Error&) {
        return std::nullopt;  // it is made anew
    }
}

void keepSky(const Heightfield& ground, const TerrainLight& light) {
    try {
        keep(skyCache(ground), [&](const std::filesystem::path& file) { saveTerrainLight(file, light); });
    } catch (const Error&) {
        // There is no folder for it: it is done without.
    }
}

}  // namespace

void FinerSky::work() {
    const auto show = [this](const TerrainLight& sparse) {
        mWork.give(Openness{spreadOpenness(mGround, sparse).openness, sparse.grid.width, sparse.grid.height});
    };
    if (const std::optional<TerrainLight> kept = keptSky(mGround)) return show(*kept);
    int before = 0;
    for (const double most : kMostSamples) {
        const TerrainLight sparse = sparseOpenness(mGround, most, mWork.progress());
        if (sparse.settings.stride == before) break;
        before = sparse.settings.stride;
        show(sparse);
        if (most == kMostSamples[std::size(kMostSamples) - 1] || before == 1) {
            keepSky(mGround, sparse);
            break;
        }
    }
}

}  // namespace stereonav
