#include "terrain/scene/tiled_ground.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "engine/base/cache.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/hash.h"
#include "engine/base/memory.h"
#include "terrain/read/dem_rows.h"
#include "terrain/read/height_limits.h"
#include "terrain/scene/fine_heights.h"
#include "terrain/scene/ground_color.h"
#include "terrain/scene/stand_in_ground.h"
#include "terrain/scene/terrain_scene.h"
#include "terrain/tiles/stored_levels.h"
#include "terrain/tiles/tile_maker.h"

namespace stereonav {
namespace {

constexpr const char* kMaking = "making tiles";

std::filesystem::path tilesPlace(std::uint64_t content) {
    return keptFile(fmt::format("ground_{:016x}.tiles", content));
}

void checkRoom(const std::filesystem::path& dem, const std::filesystem::path& place, const glm::ivec2& size) {
    const auto bytes = static_cast<double>(TileFilePlan(size).byteCount());
    std::filesystem::path folder = place.parent_path();
    std::error_code failed;
    while (!std::filesystem::exists(folder, failed) && folder.has_relative_path())
        folder = folder.parent_path();
    const std::filesystem::space_info room = std::filesystem::space(folder, failed);
    if (failed || bytes <= static_cast<double>(room.available)) return;
    throw Error(dem.string(), "tiles of the ground",
                fmt::format("need {} of disk, and {} are free in {}", memoryText(bytes),
                            memoryText(static_cast<double>(room.available)), place.parent_path().string()),
                "make room, or name another place for the cache with XDG_CACHE_HOME");
}

// Ground that its file holds in a few bytes, or not at all: said before it takes room, of a file that begins
// right.
void noteSize(const std::filesystem::path& dem, DemRows& rows, const std::filesystem::path& place,
              const glm::ivec2& size, Progress& progress) {
    constexpr double kWorthAWord = 16e6, kOften = 16;
    const auto bytes = static_cast<double>(TileFilePlan(size).byteCount());
    const double there = rows.bytesOfFiles();
    if (bytes <= kWorthAWord || bytes <= kOften * there) return;
    std::vector<float> first(static_cast<std::size_t>(rows.place().width));
    rows.read(0, 1, first.data());
    progress.note(fmt::format(
        "{}: holds {} x {} samples in {:.3g} MB, and takes {} of disk in {}, until stereonav cache removes "
        "it",
        dem.string(), size.x, size.y, there / 1e6, memoryText(bytes), place.parent_path().string()));
}

// Makes the store anew; reads twice where only all samples tell which of them are missing.
void makeStore(const std::filesystem::path& dem, DemRows& rows, const TileSource& source,
               const std::filesystem::path& place, Progress& progress) {
    checkRoom(dem, place, source.size);
    checkMemory(dem.string(), bytesOfMaking(source.size, source.rows) + rows.bytesOfBlock(),
                "give more memory");
    noteSize(dem, rows, place, source.size, progress);
    writeFileAtomically(
        place,
        [&](const std::filesystem::path& temporary) {
            constexpr double kOnce = 0.9;  // share of the progress: few are read again
            Progress first(progress, 0, kOnce), again(progress, kOnce, 1);
            makeTiles(source, temporary, first);
            if (rows.mustBeReadAgain()) makeTiles(source, temporary, again);
            rows.checkHeights(1);  // before it is kept: who opens it later reads no row
        },
        Over::Anything);
    makeRoom(place);
    noteSource(place, dem);
    progress.report(1, kMaking);
}

// The source of the tiles, and the place of their file.
struct StorePlan {
    TileSource source;
    std::filesystem::path place;
};

StorePlan storeOf(DemRows& rows) {
    TileSource source;
    const DemGrid& dem = rows.place();
    source.size = {dem.width, dem.height};
    source.content = Hash().add(static_cast<std::int64_t>(rows.identity())).value();
    source.rows = rows.runOfRows();
    source.firstRows = rows.firstRun();
    source.read = [&rows](int first, int count, float* heights) { rows.read(first, count, heights); };
    const std::filesystem::path place = tilesPlace(source.content);
    return {std::move(source), place};
}

// Returns null where there is none, or it is of no use.
std::shared_ptr<const TileStore> storeThere(const StorePlan& plan) {
    try {
        return std::make_shared<TileStore>(plan.place, plan.source.content);
    } catch (const Error&) {
        return nullptr;
    }
}

// Returns the store that is there, or makes it now.
std::shared_ptr<const TileStore> storeOrMade(const std::filesystem::path& dem, DemRows& rows,
                                             const StorePlan& plan, Progress& progress) {
    progress.report(0, kMaking);
    if (auto store = storeThere(plan)) {
        noteUse(plan.place);
        noteSource(plan.place, dem);
        progress.report(1, kMaking);
        return store;
    }
    makeStore(dem, rows, plan.source, plan.place, progress);
    return std::make_shared<TileStore>(plan.place, plan.source.content);
}

// Shows a stand-in until the tiles are there. Returns false where there is none. The store is made later by a
// reader of its own, on any thread.
bool standsIn(const SceneFile& file, const StorePlan& plan, const DemGrid& dem, TerrainScene& scene) {
    std::optional<Heightfield> ground = standInGround(file, dem);
    if (!ground) return false;
    scene.ground = std::move(*ground);
    const std::size_t samples = std::size_t(scene.ground.width()) * scene.ground.height();
    scene.report.openSamples = std::count_if(scene.ground.data(), scene.ground.data() + samples,
                                             [](float height) { return std::isnan(height); });
    scene.report.tiles = fmt::format("not there yet: {} x {} of {} x {} samples are shown",
                                     scene.ground.width(), scene.ground.height(), dem.width, dem.height);
    scene.standIn = {plan.place.string(), dem.spacing, [dem = file.dem](Progress& progress) {
                         DemRows rows(dem);
                         const StorePlan now = storeOf(rows);
                         storeOrMade(dem, rows, now, progress);
                     }};
    return true;
}

// Returns the level that is kept in memory. It takes a share of the free memory; the rest is for rings,
// pictures, and all else.
int levelInMemory(const GroundLevels& levels) {
    constexpr double kShare = 0.25, kHeightAndMaxima = 4 + 4 * 4.0 / 3;
    const double most = kShare * availableMemory();
    int level = levelWithin(levels, kMostCoarseSamples);
    const auto samples = [&] { return double(levels.size(level).x) * levels.size(level).y; };
    while (level + 1 < levels.count() && kHeightAndMaxima * samples() + bytesOfTint(samples()) > most)
        ++level;
    return level;
}

std::shared_ptr<const GroundLevels> levelsOf(const SceneFile& file, std::shared_ptr<const TileStore> store,
                                             const glm::dvec2& spacing) {
    checkScaledHeights(file.dem.string(), store->low(), store->high(), file.verticalScale);
    return std::make_shared<GroundLevels>(storedLevels(std::move(store), spacing, file.verticalScale));
}

// Returns whether the model has more samples than readDem() takes, whatever the memory.
bool isBeyondMemory(const DemGrid& dem) {
    return dem.width > kMostDemSide || dem.height > kMostDemSide ||
           1ll * dem.width * dem.height > kMostDemSamples;
}

}  // namespace

bool goesIntoTiles(const SceneFile& file, double (*bytesOfSamples)(double samples)) {
    if (file.tiles == GroundTiles::Off) return false;
    if (file.tiles == GroundTiles::On) return true;
    const DemRows rows(file.dem);
    const double samples = double(rows.place().width) * rows.place().height;
    return isBeyondMemory(rows.place()) || bytesOfSamples(samples) > availableMemory();
}

int levelWithin(const GroundLevels& levels, double mostSamples) {
    int level = 0;
    while (level + 1 < levels.count() && double(levels.size(level).x) * levels.size(level).y > mostSamples)
        ++level;
    return level;
}

GroundInTiles readGroundInTiles(const SceneFile& file, Progress& progress) {
    DemRows rows(file.dem);
    return {rows.place(),
            levelsOf(file, storeOrMade(file.dem, rows, storeOf(rows), progress), rows.place().spacing)};
}

DemGrid readTiledGround(const SceneFile& file, TerrainScene& scene, Progress& progress) {
    DemRows rows(file.dem);
    const StorePlan plan = storeOf(rows);
    DemGrid dem = rows.place();
    std::shared_ptr<const TileStore> store = storeThere(plan);
    const bool made = !store;
    progress.report(0, kMaking);
    if (made && file.standInSide > 0 && standsIn(file, plan, dem, scene)) {
        progress.report(1, kMaking);
        return dem;
    }
    if (made)
        store = storeOrMade(file.dem, rows, plan, progress);
    else
        noteUse(plan.place), noteSource(plan.place, file.dem);
    TiledGround tiled;
    tiled.levels = levelsOf(file, store, dem.spacing);
    tiled.level = levelInMemory(*tiled.levels);
    tiled.fine = std::make_shared<FineHeights>(tiled.levels);
    std::optional<Heightfield> ground =
        tiled.levels->part(tiled.level, glm::ivec2(0), tiled.levels->size(tiled.level));
    if (!ground)
        throw Error(file.dem.string(), "", "no cell with four known heights",
                    "check the file's nodata value");
    scene.ground = std::move(*ground);
    scene.report.openSamples = dem.sourceMissing = store->missing();
    scene.report.tiles =
        fmt::format("{} x {} samples in {} levels, {} on disk{}; in memory 1 of {} each way", dem.width,
                    dem.height, tiled.levels->count(), memoryText(static_cast<double>(store->byteCount())),
                    made ? ", made now" : "", 1 << tiled.level);
    scene.tiled = std::move(tiled);
    progress.report(1, kMaking);
    return dem;
}

}  // namespace stereonav
