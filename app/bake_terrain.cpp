// Bakes a terrain's light into a file: horizons and transfer, or openness alone (terrain/terrain_light.h).
#include "app/bake_terrain.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "app/output_place.h"
#include "app/progress_bar.h"
#include "app/scene_loading.h"
#include "engine/base/error.h"
#include "engine/base/stopwatch.h"
#include "terrain/ground_rays.h"
#include "terrain/terrain_light.h"

namespace stereonav {
namespace {

TerrainLightKind kindFromText(const std::string& what) {
    if (what.empty() || what == "transfer") return TerrainLightKind::Transfer;
    if (what == "openness") return TerrainLightKind::Openness;
    throw Error("--what", "", "expected transfer or openness for a terrain, got \"" + what + "\"",
                "transfer has shadows and bounced light, openness the sky's light alone");
}

int strideFromResolution(double resolution) {
    if (resolution == 0) return 1;
    const double stride = 1 / resolution;
    if (!(resolution > 0) || !(stride >= 1 - 1e-9) || !(stride <= 1000))
        throw Error("--resolution", "", fmt::format("expected 0.001 to 1, got {:g}", resolution),
                    "1 bakes every height sample, 0.5 every second one each way");
    return static_cast<int>(std::lround(stride));
}

TerrainLightSettings settingsOf(const TerrainBakeOptions& options) {
    TerrainLightSettings settings;
    settings.kind = kindFromText(options.what);
    settings.stride = strideFromResolution(options.resolution);
    if (options.samples < 0 || options.samples > 65536)
        throw Error("--samples", "", fmt::format("expected 16 to 65536, got {}", options.samples),
                    "64 is the default for terrain");
    // Rays go in packets.
    if (options.samples > 0)
        settings.rays = (options.samples + RayPacket::kSize - 1) / RayPacket::kSize * RayPacket::kSize;
    if (options.order > 0) settings.order = options.order;
    if (options.bounces >= 0) settings.bounces = options.bounces;
    if (options.albedo >= 0) settings.albedo = options.albedo;
    return settings;
}

// Whether the file holds the same bake already.
bool holds(const std::filesystem::path& file, const Heightfield& ground,
           const TerrainLightSettings& settings) {
    if (!std::filesystem::exists(file)) return false;
    try {
        return loadTerrainLight(file, &ground).key == terrainLightKey(ground, settings);
    } catch (const Error& error) {
        std::fprintf(stderr, "stereonav: %s\n", error.what());
        return false;  // baked anew
    }
}

}  // namespace

int bakeTerrain(const TerrainBakeOptions& options) {
    const TerrainLightSettings settings = settingsOf(options);
    if (!options.out.empty()) checkOutputFile("--out", options.out);
    ProgressBar bar;
    SceneOptions unlit = options.scene;
    unlit.light.clear();
    const LoadedScene scene = loadScene(unlit, SizeOption{}, bar.progress());
    const Heightfield& ground = scene.terrain->ground;
    const std::filesystem::path file =
        options.out.empty() ? terrainLightCache(ground) : std::filesystem::path(options.out);
    if (holds(file, ground, settings)) {
        bar.clear();
        std::printf("%s: baked before\n", file.string().c_str());
        return 0;
    }
    const Stopwatch watch;
    const TerrainLight light = bakeTerrainLight(ground, settings, bar.progress());
    const double seconds = watch.elapsed_ms() / 1000;
    saveTerrainLight(file, light);
    bar.clear();
    std::printf("%s: %dx%d samples, %.1f MB (%.0f bytes a sample), %.1f s (%.0f samples a second)\n",
                file.string().c_str(), light.grid.width, light.grid.height,
                static_cast<double>(light.byteCount()) / 1e6,
                static_cast<double>(light.byteCount()) / static_cast<double>(light.grid.count()), seconds,
                static_cast<double>(light.grid.count()) / std::max(seconds, 1e-9));
    return 0;
}

}  // namespace stereonav
