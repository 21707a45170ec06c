// Bakes a terrain's light into a file: horizons and transfer, or openness only
// (terrain/light/terrain_light.h).
#include "app/command/bake_terrain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <utility>

#include "app/command/bake_finer.h"
#include "app/command/cache_command.h"
#include "app/options/output_place.h"
#include "app/output/command_result.h"
#include "app/output/progress_bar.h"
#include "app/scene/scene_loading.h"
#include "app/scene/terrain/terrain_loading.h"
#include "engine/base/error.h"
#include "engine/base/stopwatch.h"
#include "engine/peers/peers.h"
#include "engine/text/printed.h"
#include "terrain/ground/ground_rays.h"
#include "terrain/light/terrain_bake_part.h"
#include "terrain/light/terrain_light.h"

namespace stereonav {
namespace {

TerrainLightSettings settingsOf(const BakeOptions& options) {
    TerrainLightSettings settings;
    settings.kind =
        options.what == BakeKind::Openness ? TerrainLightKind::Openness : TerrainLightKind::Transfer;
    if (options.resolution)
        settings.stride = std::max(1, static_cast<int>(std::lround(1 / *options.resolution)));
    // The number of rays is a multiple of a packet's.
    constexpr int kPacket = RayPacket::kSize;
    if (options.samples) settings.rays = (*options.samples + kPacket - 1) / kPacket * kPacket;
    if (options.order) settings.order = *options.order;
    if (options.bounces) settings.bounces = *options.bounces;
    if (options.albedo) settings.albedo = options.albedo->x;
    return settings;
}

// Returns the light in the file, where it is that of the same bake.
std::optional<TerrainLight> lightBefore(const std::filesystem::path& file, const Heightfield& ground,
                                        const TerrainLightSettings& settings, bool quiet) {
    if (!std::filesystem::exists(file)) return std::nullopt;
    if (!isTerrainLight(file))
        throw Error(file.string(), "", "the file holds something other than a terrain's light",
                    "choose another with --out");
    try {
        TerrainLight light = loadTerrainLight(file, nullptr);
        if (light.key == terrainLightKey(ground, settings)) return light;
    } catch (const DiskError&) {
        throw;
    } catch (const Error& error) {
        if (!quiet) printNote(error.what() + std::string(": it is computed again"));
    }
    return std::nullopt;
}

// Returns the light; empty where the bake was stopped and its finished part is kept.
std::optional<TerrainLight> bakeOrKeep(const Heightfield& ground, const TerrainLightSettings& settings,
                                       ProgressBar& bar) {
    try {
        return bakeTerrainLight(ground, settings, bar.progress(), true, &peersOfThisRun());
    } catch (const Cancelled&) {
        if (!std::filesystem::exists(terrainBakePart(terrainLightKey(ground, settings)))) throw;
        bar.clear();
        printNote("stopped; what is done is kept, and the next run goes on from there");
        return std::nullopt;
    }
}

void tellBaked(const TerrainLight& light, const std::filesystem::path& file, double seconds,
               CommandResult& result) {
    const double samples = static_cast<double>(light.grid.count());
    const double bytes = static_cast<double>(light.byteCount()), rate = samples / std::max(seconds, 1e-9);
    result.say(fmt::format(
        "{}: {}x{} samples, {:.1f} MB ({:.0f} bytes a sample), {:.1f} s ({:.0f} samples a second)\n",
        file.string(), light.grid.width, light.grid.height, bytes / 1e6, bytes / samples, seconds, rate));
    result.addFile("light", file);
    result.add("baked_before", false);
    result.add("samples", FactIntegers{light.grid.width, light.grid.height});
    result.add("light_bytes", static_cast<std::int64_t>(light.byteCount()));
    result.add("time_s", seconds);
    result.add("samples_per_s", rate);
}

}  // namespace

int bakeTerrain(const BakeOptions& options) {
    TerrainLightSettings settings = settingsOf(options);
    Peers& peers = peersOfThisRun();
    if (peers.first() && !options.out.empty()) checkOutputToReadAgain("--out", options.out);
    CommandResult result("bake", options.telling, {});
    ProgressBar bar(peers.first() && !options.telling.quiet);
    SceneOptions unlit = options.scene;
    unlit.light = {};
    checkSceneOptions(unlit);
    const TerrainScene terrain = terrainOf(unlit, bar.progress());
    const Heightfield& ground = terrain.ground;
    const int finer = finerLevels(options, terrain);
    // The finer light is shown near the eye, so the light in memory may be as coarse as memory requires.
    if (finer > 0) settings.stride = asTheFirst(peers, strideWithinMemory(ground, settings).value_or(1));
    const std::filesystem::path file =
        options.out.empty() ? terrainLightCache(ground) : std::filesystem::path(options.out);
    result.addScene(options.scene.scene.empty() ? "terrain" : options.scene.scene);
    result.add("what", std::string(options.what == BakeKind::Openness ? "openness" : "transfer"));
    std::optional<TerrainLight> light;
    if (peers.first()) {
        if (finer > 0) checkFinerPlace(file);
        light = lightBefore(file, ground, settings, options.telling.quiet);
    }
    if (!asTheFirst<char>(peers, light.has_value())) {
        const Stopwatch watch;
        if (peers.first()) {
            light = bakeOrKeep(ground, settings, bar);
            if (!light) return 1;
            const double seconds = watch.elapsed_ms() / 1000;
            saveTerrainLight(file, *light);
            noteSceneAsSource(file, options.scene.scene);
            removeFinerOfOthers(file, light->key);
            bar.clear();
            tellBaked(*light, file, seconds, result);
        } else {
            bakeTerrainLight(ground, settings, bar.progress(), true, &peers);
        }
    } else if (peers.first()) {
        bar.clear();
        result.say(file.string() + ": baked before\n");
        result.addFile("light", file);
        result.add("baked_before", true);
    }
    if (finer > 0 && !bakeFiner(terrain, std::move(light), settings, finer, file, bar, result)) return 1;
    if (peers.first()) result.finish();
    return 0;
}

}  // namespace stereonav
