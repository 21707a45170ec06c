#include "app/command/bake_finer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/stopwatch.h"
#include "engine/peers/peers.h"
#include "engine/text/printed.h"
#include "terrain/light/fine_bake.h"
#include "terrain/light/light_tiles.h"

namespace stereonav {
namespace {

// Returns the light from which all processes bake finer: that of the first one, without the parts for
// pictures.
TerrainLight lightToGoOnFrom(std::optional<TerrainLight> light, const TerrainLightSettings& settings,
                             const Heightfield& ground, Peers& peers) {
    TerrainLight kept;
    kept.settings = settings;
    kept.grid = LightGrid(ground, settings.stride);
    kept.key = terrainLightKey(ground, settings);
    if (light) kept.full = std::move(light->full);
    if (peers.alone() || settings.kind == TerrainLightKind::Openness) return kept;
    kept.full.resize(kept.grid.count() * lightHarmonics(settings.order));
    constexpr std::size_t kAtOnce = 32 << 20;
    for (std::size_t from = 0; from < kept.full.size(); from += kAtOnce) {
        const std::span<std::int16_t> part =
            std::span(kept.full).subspan(from, std::min(kAtOnce, kept.full.size() - from));
        if (peers.first())
            peers.tellAll(ByteWriter().putAll(std::span<const std::int16_t>(part)).take());
        else
            ByteReader(peers.hear()).getAll(part);
    }
    return kept;
}

std::filesystem::path partOf(std::filesystem::path place) {
    return place += ".part";
}

// Returns whether the same bake, or a finer one, is there already. One with damaged tiles is renamed, so that
// the bake goes on from it.
bool isThere(const std::filesystem::path& place, const FineLightShape& shape) {
    if (!isFineLight(place)) return false;
    try {
        const LightTiles tiles(place, shape);
        if (tiles.shape().finest > shape.finest) return false;
        if (tiles.isWhole()) return true;
    } catch (const DiskError&) {
        throw;
    } catch (const Error&) {
        return false;  // light of another bake, or cut off: it is baked anew
    }
    std::filesystem::rename(place, partOf(place));
    return false;
}

}  // namespace

int finerLevels(const BakeOptions& options, const TerrainScene& terrain) {
    const double resolution = options.resolution.value_or(1);
    if (resolution <= 1) return 0;
    const int finer = static_cast<int>(std::lround(std::log2(resolution)));
    const int there = terrain.tiled ? terrain.tiled->level : 0;
    if (finer <= there) return finer;
    throw Error(
        "--resolution", "",
        there == 0
            ? fmt::format("expected at most 1, got {}: all samples of this ground are in memory", resolution)
            : fmt::format("expected at most {}, got {}: there are no finer samples in tiles", 1 << there,
                          resolution),
        there == 0 ? "leave it out" : "give a smaller one");
}

void checkFinerPlace(const std::filesystem::path& light) {
    const std::filesystem::path place = fineLightPlace(light);
    if (std::filesystem::exists(place) && !isFineLight(place))
        throw Error(place.string(), "", "the file holds something other than light at finer samples",
                    "choose another with --out");
}

void removeFinerOfOthers(const std::filesystem::path& light, std::uint64_t key) {
    std::error_code code;
    const std::filesystem::path place = fineLightPlace(light);
    if (isFineLight(place) && !isFineLightOf(place, key)) std::filesystem::remove(place, code);
}

bool bakeFiner(const TerrainScene& terrain, std::optional<TerrainLight> light,
               const TerrainLightSettings& settings, int finer, const std::filesystem::path& file,
               ProgressBar& bar, CommandResult& result) {
    Peers& peers = peersOfThisRun();
    const std::filesystem::path place = fineLightPlace(file);
    const GroundLevels& levels = *terrain.tiled->levels;
    const TerrainLight from = lightToGoOnFrom(std::move(light), settings, terrain.ground, peers);
    const FineLightShape shape = fineLightShape(levels, terrain.tiled->level, from, finer);
    const Stopwatch watch;
    const bool before = asTheFirst<char>(peers, peers.first() && isThere(place, shape));
    if (!before) {
        try {
            bakeFineLight(FineBake(levels, terrain.ground, from), place, partOf(place), shape, bar.progress(),
                          peers);
        } catch (const Cancelled&) {
            if (!peers.first() || !std::filesystem::exists(partOf(place))) throw;
            bar.clear();
            printNote("stopped; what is done is kept, and the next run goes on from there");
            return false;
        }
    }
    if (!peers.first()) return true;
    bar.clear();
    const double seconds = watch.elapsed_ms() / 1000;
    const LightTiles tiles(place, shape);
    const glm::ivec2 size = tiles.size(tiles.shape().finest);
    const std::string what = fmt::format("{} tiles of up to {}x{} samples, {}", tiles.count(), size.x, size.y,
                                         memoryText(static_cast<double>(tiles.byteCount())));
    result.say(before ? fmt::format("{}: baked before, {}\n", place.string(), what)
                      : fmt::format("{}: {}, {:.1f} s\n", place.string(), what, seconds));
    result.addFile("finer_light", place);
    result.add("finer_baked_before", before);
    result.add("finer_samples", FactIntegers{size.x, size.y});
    result.add("finer_tiles", static_cast<std::int64_t>(tiles.count()));
    result.add("finer_bytes", static_cast<std::int64_t>(tiles.byteCount()));
    if (!before) result.add("finer_time_s", seconds);
    return true;
}

}  // namespace stereonav
