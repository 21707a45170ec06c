// What is kept of ground, on disk or for the next question, is kept for one ground: an elevation model by its
// files, a generated terrain by seed and size, a part by its place.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "engine/base/file.h"
#include "terrain/ground/ground_rings.h"
#include "terrain/read/dem_rows.h"
#include "terrain/scene/fine_heights.h"
#include "terrain/scene/ground_recolor.h"
#include "terrain/scene/tiled_ground.h"
#include "tests/support/each_member.h"
#include "tests/support/test_grounds.h"
#include "tiled_case.h"

namespace stereonav::test {

template <>
struct Members<RingBox> {
    static constexpr std::array names{"level", "low", "size"};
};
template <>
struct Members<SunAngles> {
    static constexpr std::array names{"azimuth", "elevation"};
};

namespace {
namespace fs = std::filesystem;

constexpr int kWide = 37, kHigh = 29;

// Samples `base` + 0.25 for each column and 11 for each row.
RasterSpec keyedRaster(double base) {
    RasterSpec spec;
    spec.width = kWide, spec.height = kHigh;
    spec.value = [base](int c, int r, int) { return base + 0.25 * c + 11 * r; };
    return spec;
}

const fs::file_time_type kThen = fs::file_time_type() + std::chrono::hours(24 * 365 * 10);

fs::path writtenThen(const fs::path& file, const RasterSpec& spec) {
    writeRaster(file, spec);
    fs::last_write_time(file, kThen);
    return file;
}

std::uint64_t identityOf(const fs::path& file) {
    return DemRows(file).identity();
}

TEST(GroundKey, IsThePathTheSizeAndTheTimeOfEachFile) {
    const TempFolder folder;
    RasterSpec spec = keyedRaster(100);
    spec.placed = false;
    const fs::path file = writtenThen(folder / "a.tif", spec);
    std::map<std::uint64_t, std::string> known{{identityOf(file), "as it was"}};
    EXPECT_EQ(identityOf(file), known.begin()->first);
    const auto add = [&](const std::string& what, const fs::path& of) {
        const auto [other, fresh] = known.emplace(identityOf(of), what);
        EXPECT_TRUE(fresh) << what << " is taken for " << other->second;
    };
    fs::copy_file(file, folder / "b.tif");
    fs::last_write_time(folder / "b.tif", kThen);
    add("another path", folder / "b.tif");
    fs::last_write_time(file, kThen + std::chrono::milliseconds(20));
    add("another time", file);
    spec.options = {"COMPRESS=DEFLATE"};
    writtenThen(file, spec);
    ASSERT_NE(fs::file_size(file), fs::file_size(folder / "b.tif"));
    add("another size", file);
    // A world file beside it says where it lies.
    folder.text("a.tfw", "30\n0\n0\n-30\n500000\n5000000\n");
    fs::last_write_time(folder / "a.tfw", kThen);
    add("with a world file", file);
    folder.text("a.tfw", "60\n0\n0\n-60\n500000\n5000000\n");
    fs::last_write_time(folder / "a.tfw", kThen + std::chrono::seconds(1));
    add("with another world file", file);
}

TEST(GroundKey, OfAFolderHasEachOfItsFiles) {
    const TempFolder folder;
    fs::create_directories(folder / "tiles");
    RasterSpec spec = keyedRaster(100);
    writtenThen(folder / "tiles/a.tif", spec);
    spec.transform[0] += 30 * (kWide - 1);
    writtenThen(folder / "tiles/b.tif", spec);
    std::map<std::uint64_t, std::string> known{{identityOf(folder / "tiles"), "as it was"}};
    const auto add = [&](const std::string& what) {
        const auto [other, fresh] = known.emplace(identityOf(folder / "tiles"), what);
        EXPECT_TRUE(fresh) << what << " is taken for " << other->second;
    };
    for (const char* name : {"tiles/a.tif", "tiles/b.tif"}) {
        fs::last_write_time(folder / name, kThen + std::chrono::seconds(1));
        add(name);
    }
    spec.transform[0] += 30 * (kWide - 1);
    writtenThen(folder / "tiles/c.tif", spec);
    add("one more");
    fs::remove(folder / "tiles/b.tif");
    fs::remove(folder / "tiles/c.tif");
    add("one less");
}

// Tiles that were made of one elevation model are never shown for another one.
using TilesOfOneGround = TiledCase;

TEST_F(TilesOfOneGround, EveryElevationModelHasItsOwn) {
    struct Case {
        std::string name;
        double base, verticalScale;
        int seconds;  // after the first
    };
    fs::create_directories(mFolder / "other");
    for (const Case& c :
         {Case{"a.tif", 100, 1, 0}, Case{"a.tif", 300, 1, 1}, Case{"b.tif", 500, 1, 0},
          Case{"other/a.tif", 700, 1, 1}, Case{"b.tif", 500, 2, 0}, Case{"a.tif", 900, 1, 2}}) {
        SCOPED_TRACE(c.name);
        mFile.dem = writeRaster(mFolder / c.name, keyedRaster(c.base));
        fs::last_write_time(mFile.dem, kThen + std::chrono::seconds(c.seconds));
        mFile.verticalScale = c.verticalScale;
        mFile.tiles = GroundTiles::On;
        Progress quiet;
        std::vector<float> heights(std::size_t{kWide} * kHigh);
        readGroundInTiles(mFile, quiet).levels->read(0, {0, 0}, {kWide, kHigh}, heights.data());
        for (int j = 0; j < kHigh; ++j)
            for (int i = 0; i < kWide; ++i)
                ASSERT_EQ(heights[static_cast<std::size_t>(j) * kWide + i],
                          c.verticalScale * (c.base + 0.25 * i + 11 * (kHigh - 1 - j)))
                    << i << " " << j;
    }
}

bool sameTerrain(const BuiltInTerrain& a, const BuiltInTerrain& b) {
    bool same =
        a.heights == b.heights && a.color.width() == b.color.width() && a.color.height() == b.color.height();
    for (int y = 0; same && y < a.color.height(); ++y)
        same = std::equal(a.color.row(y), a.color.row(y) + a.color.width(), b.color.row(y));
    return same;
}

// A generated terrain's file is of its seed and size, also where it has another's name.
TEST_F(TilesOfOneGround, AGeneratedTerrainIsOfItsSeedAndSize) {
    Progress quiet;
    constexpr std::uint64_t kHighBit = 1ull << 40;
    for (int round = 0; round < 2; ++round)  // made, then read
        for (const std::uint64_t seed : {1ull, 2ull, 1ull | kHighBit})
            for (const int size : {17, 18})
                EXPECT_TRUE(
                    sameTerrain(builtInTerrain(seed, size, quiet), generateBuiltInTerrain(seed, size, quiet)))
                    << seed << " " << size;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(cacheFolder())) files.push_back(entry.path());
    ASSERT_EQ(files.size(), 6u);
    std::sort(files.begin(), files.end());
    const fs::path kept = mFolder / "kept";
    fs::rename(files[0], kept);
    for (std::size_t n = 1; n < files.size(); ++n) fs::rename(files[n], files[n - 1]);
    fs::rename(kept, files.back());
    for (const std::uint64_t seed : {1ull, 2ull, 1ull | kHighBit})
        for (const int size : {17, 18})
            EXPECT_TRUE(
                sameTerrain(builtInTerrain(seed, size, quiet), generateBuiltInTerrain(seed, size, quiet)))
                << seed << " " << size;
}

// In the cache lies the terrain under the usual sun alone.
TEST_F(TilesOfOneGround, AGeneratedTerrainIsUnderItsSun) {
    Progress quiet;
    const BuiltInOrigin origin{3, 33};
    const BuiltInTerrain usual = builtInUnder(origin, {}, false, quiet);
    EXPECT_TRUE(sameTerrain(usual, builtInTerrain(3, 33, quiet)));
    for (double TerrainLook::*angle : {&TerrainLook::sunAzimuth, &TerrainLook::sunElevation}) {
        TerrainLook look;
        look.*angle -= 0.5;
        const BuiltInTerrain other = builtInUnder(origin, look, false, quiet);
        EXPECT_FALSE(sameTerrain(other, usual));
        EXPECT_TRUE(sameTerrain(other, generateBuiltInTerrain(3, 33, quiet, look)));
    }
    const BuiltInTerrain unlit = builtInUnder(origin, {}, true, quiet);
    EXPECT_FALSE(sameTerrain(unlit, usual));
    EXPECT_TRUE(sameTerrain(unlit, generateBuiltInTerrain(3, 33, quiet, std::nullopt)));
}

// Parts that were asked for last are kept, by both numbers of their places.
TEST(GroundKey, PartsOfTheFinestHeightsAreOfTheirPlaces) {
    const Heightfield ground = makeGround("rough", 700, 600, 5);
    const FineHeights fine(std::make_shared<const GroundLevels>(ground));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> along(0, 699), up(0, 599);
    for (int n = 0; n < 400; ++n) {
        const glm::dvec2 world = ground.worldFromGrid({along(random), up(random)});
        // Worlds of parts and of the whole round alike but for a millionth of a sample.
        ASSERT_NEAR(fine.heightAt(world), ground.heightAt(world), 1e-3) << n;
    }
}

TEST(GroundKey, PlacesOfRingsAndSunsAreComparedInWhole) {
    expectEachMemberCompared(RingBox{2, {10, 20}, {300, 400}});
    expectEachMemberCompared(SunAngles{1, 0.5});
}

}  // namespace
}  // namespace stereonav::test
