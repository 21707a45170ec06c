// Light baked at finer samples than those in memory: each tile as a bake of all finest samples, the file, and
// who makes it.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "engine/base/error.h"
#include "raster_files.h"
#include "terrain/light/fine_bake.h"
#include "terrain/light/terrain_horizon.h"
#include "terrain/light/terrain_light.h"
#include "tests/support/failing_reads.h"
#include "tests/support/file_bytes.h"
#include "tests/support/test_grounds.h"
#include "tests/support/thread_peers.h"

namespace stereonav::test {
namespace {

namespace fs = std::filesystem;

TerrainLightSettings quick(int bounces) {
    TerrainLightSettings settings;
    settings.order = 2;
    settings.azimuths = 8;
    settings.rays = 16;
    settings.bounces = bounces;
    return settings;
}

TerrainLight bakeOf(const Heightfield& ground, const TerrainLightSettings& settings) {
    Progress quiet;
    return bakeTerrainLight(ground, settings, quiet);
}

// A ground, and the level above it, that stands for what is in memory.
struct TwoLevels {
    explicit TwoLevels(Heightfield ground)
        : fine(std::move(ground)), levels(fine), coarse(*levels.part(1, glm::ivec2(0), levels.size(1))) {}

    Heightfield fine;
    GroundLevels levels;
    Heightfield coarse;
};

std::optional<TerrainLight> tileOf(const TwoLevels& ground, const TerrainLight& light, const glm::ivec2& low,
                                   const glm::ivec2& size) {
    return FineBake(ground.levels, ground.coarse, light).tile(0, low, size, [] {});
}

// All samples that a tile's rays meet are the tile's own here.
void expectAsInTheWhole(const std::string& kind, int bounces) {
    SCOPED_TRACE(kind);
    const TwoLevels ground(makeGround(kind, 151, 131, 3));
    const TerrainLightSettings settings = quick(bounces);
    const TerrainLight truth = bakeOf(ground.fine, settings);
    const glm::ivec2 low(20, 15), size(60, 50);
    const auto tile = tileOf(ground, bakeOf(ground.coarse, settings), low, size);
    ASSERT_TRUE(tile);
    double off = 0, sent = 0;
    int others = 0;
    const std::size_t count = tile->grid.count(), whole = truth.grid.count();
    for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; ++i) {
            const std::size_t at = static_cast<std::size_t>(j) * size.x + i,
                              all = static_cast<std::size_t>(low.y + j) * 151 + low.x + i;
            bool same = tile->openness[at] == truth.openness[all];
            for (int a = 0; a < settings.azimuths; ++a)
                same = same && tile->horizon[a * count + at] == truth.horizon[a * whole + all];
            for (int k = 0; k < lightHarmonics(settings.order); ++k) {
                const int bounced = tile->bounced[k * count + at], expected = truth.bounced[k * whole + all];
                same = same && tile->full[k * count + at] - bounced == truth.full[k * whole + all] - expected;
                off += std::pow(bounced - expected, 2);
                sent += std::pow(expected, 2);
            }
            others += !same;
        }
    // A ray along the edge of a hole passes or does not.
    EXPECT_LE(others, kind == "holed" ? 6 : 0);
    // Other rays, a bounce more, and what is met sends the light of coarser samples.
    EXPECT_LE(std::sqrt(off), 0.25 * std::sqrt(sent));
}

TEST(FineLight, ATileIsAsInABakeOfAllFinestSamples) {
    expectAsInTheWhole("smooth", 1);
    expectAsInTheWhole("holed", 0);
}

// A wall of 4 km stands 900 samples of 30 m east of the tile, which looks over its own samples for 256.
TEST(FineLight, AHorizonBeyondTheTilesSamplesIsThatOfTheGroundInMemory) {
    constexpr int kAcross = 1101, kUp = 131, kWall = 900;
    std::vector<float> heights(static_cast<std::size_t>(kAcross) * kUp, 100.0f);
    for (int j = 0; j < kUp; ++j)
        std::fill_n(heights.data() + static_cast<std::ptrdiff_t>(j) * kAcross + kWall, kAcross - kWall,
                    4100.0f);
    const TwoLevels ground(Heightfield(kAcross, kUp, {30, 30}, std::move(heights), "wall"));
    TerrainLight light;
    light.settings = quick(0);
    light.grid = LightGrid(ground.coarse, 1);
    const glm::ivec2 low(0, 60), size(8, 4);
    const auto tile = tileOf(ground, light, low, size);
    ASSERT_TRUE(tile);
    for (int i = 0; i < size.x; ++i) {
        const double run = 30.0 * (kWall - i), sine = 4000 / std::hypot(run, 4000.0);
        EXPECT_NEAR(tile->horizon[i], 255 * sine, 1.5) << "east of " << i;
        EXPECT_EQ(tile->horizon[4 * tile->grid.count() + i], 0) << "west of " << i;
    }
}

TEST(FineLight, NoTileWhereNothingIsKnown) {
    const TwoLevels ground(makeGround("holed", 300, 300, 1));
    TerrainLight light;
    light.settings = quick(0);
    light.grid = LightGrid(ground.coarse, 1);
    EXPECT_FALSE(tileOf(ground, light, {110, 110}, {20, 20}));
    EXPECT_TRUE(tileOf(ground, light, {90, 110}, {20, 20}));
}

class FineLightFile : public testing::Test {
protected:
    // Tiles of 256 and 45 samples: of a ground of 301 x 131, and its next level, of 151 x 66.
    FineLightFile() {
        mShape.settings = quick(0);
        mShape.key = 42;
        mShape.size = {301, 131};
        mShape.coarsest = 1;
    }
    TerrainLight lightOf(const LightTiles& tiles, std::size_t n) const {
        TerrainLight light;
        light.settings = mShape.settings;
        light.grid = LightGrid(glm::ivec2(0), tiles.sizeOf(tiles.tile(n)));
        for (std::size_t s = 0; s < light.grid.count(); ++s)
            light.openness.push_back(static_cast<std::uint8_t>(s * 7 + n));
        light.horizon.assign(light.grid.count() * 8, static_cast<std::uint8_t>(n));
        light.full.assign(light.grid.count() * 3, static_cast<std::int16_t>(n - 5));
        light.bounced.assign(light.grid.count() * 3, static_cast<std::int16_t>(300 * n));
        return light;
    }
    void writeAll() const {
        LightTiles tiles = LightTiles::begin(part(), mShape);
        for (std::size_t n = 0; n < tiles.count(); ++n) tiles.write(n, bytesOf(lightOf(tiles, n)));
        tiles.finish(place());
    }
    fs::path place() const { return mFolder / "a.light.fine"; }
    fs::path part() const { return mFolder / "a.light.fine.part"; }
    std::string problem(const FineLightShape& shape) const {
        return errorOf([&] { LightTiles(place(), shape); });
    }

    TempFolder mFolder;
    FineLightShape mShape;
};

TEST_F(FineLightFile, HasWhatWasWritten) {
    writeAll();
    EXPECT_FALSE(fs::exists(part()));
    EXPECT_TRUE(isFineLight(place()));
    EXPECT_TRUE(isFineLightOf(place(), mShape.key));
    EXPECT_FALSE(isFineLightOf(place(), mShape.key + 1));
    FineLightShape any = mShape;
    any.finest = 1;
    const LightTiles tiles(place(), any);
    EXPECT_EQ(tiles.shape().finest, 0) << "as far as the file goes";
    ASSERT_EQ(tiles.count(), 3u);
    EXPECT_EQ(tiles.size(1), glm::ivec2(151, 66));
    EXPECT_TRUE(tiles.isWhole());
    for (std::size_t n = 0; n < tiles.count(); ++n) {
        const LightTiles::Tile tile = tiles.tile(n);
        EXPECT_EQ(tiles.numberOf(tile), n);
        const TerrainLight expected = lightOf(tiles, n), light = tiles.read(tile).value();
        EXPECT_EQ(light.grid.width, expected.grid.width);
        EXPECT_EQ(light.openness, expected.openness);
        EXPECT_EQ(light.horizon, expected.horizon);
        EXPECT_EQ(light.full, expected.full);
        EXPECT_EQ(light.bounced, expected.bounced);
    }
    EXPECT_EQ(tiles.sizeOf(tiles.tile(2)), glm::ivec2(45, 131));
}

TEST_F(FineLightFile, GoesOnWhereItWasLeft) {
    {
        LightTiles tiles = LightTiles::begin(part(), mShape);
        tiles.write(1, bytesOf(lightOf(tiles, 1)));
    }
    {
        LightTiles tiles = LightTiles::begin(part(), mShape);
        EXPECT_FALSE(tiles.has(0));
        EXPECT_TRUE(tiles.has(1));
        tiles.write(0, {});
        tiles.write(2, bytesOf(lightOf(tiles, 2)));
        tiles.finish(place());
    }
    const LightTiles tiles(place(), mShape);
    EXPECT_FALSE(tiles.read(tiles.tile(0))) << "nothing is known there";
    EXPECT_EQ(tiles.read(tiles.tile(1))->openness, lightOf(tiles, 1).openness);
    FineLightShape other = mShape;
    other.key = 43;
    EXPECT_FALSE(LightTiles::begin(part(), other).has(1));
}

TEST_F(FineLightFile, WhatDoesNotFitIsOneLine) {
    EXPECT_THAT(problem(mShape), AllOf(HasSubstr("a.light.fine"), HasSubstr("cannot be opened")));
    std::ofstream(place()) << "something";
    EXPECT_THAT(problem(mShape), HasSubstr("something else"));
    writeAll();
    FineLightShape other = mShape;
    other.key = 43;
    EXPECT_THAT(problem(other), HasSubstr("another bake"));
    const auto size = fs::file_size(place());
    {
        std::fstream file(place(), std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(static_cast<std::streamoff>(size) - 100);
        file << "x";
    }
    const LightTiles tiles(place(), mShape);
    EXPECT_THAT(errorOf([&] { tiles.read(tiles.tile(2)); }),
                AllOf(HasSubstr("tile 1, 0"), HasSubstr("damaged")));
    EXPECT_TRUE(tiles.read(tiles.tile(1)));
    EXPECT_FALSE(tiles.isWhole());
    fs::copy_file(place(), part());
    {
        const LightTiles again = LightTiles::begin(part(), mShape);
        EXPECT_TRUE(again.has(1));
        EXPECT_FALSE(again.has(2)) << "it is baked again, and no other";
    }
    fs::resize_file(place(), size - 1);
    EXPECT_THAT(problem(mShape), HasSubstr("cut off"));
    EXPECT_THAT(errorOf([&] { LightTiles::begin(mFolder / "none" / "a", mShape); }),
                HasSubstr("cannot be written"));
}

// Finer light is looked for by its name beside the other: what lies there may be anything.
TEST_F(FineLightFile, APipeInItsPlaceIsNotWaitedFor) {
    ASSERT_EQ(mkfifo(place().c_str(), 0600), 0);
    EXPECT_FALSE(isFineLight(place()));
    EXPECT_FALSE(isTerrainLight(place()));
    EXPECT_THAT(errorOf([&] { loadTerrainLight(place(), nullptr); }), HasSubstr("found a pipe"));
    EXPECT_THAT(errorOf([&] { LightTiles(place(), mShape); }), HasSubstr("found a pipe"));
}

// Light that can not be read now may be whole: it is neither taken for damaged nor for another file. The
// memory of this process stands for it: it opens, and its start can not be read (EIO).
TEST_F(FineLightFile, ADiskThatFailsIsNoDamage) {
    fs::create_symlink("/proc/self/mem", place());
    EXPECT_THROW(isFineLight(place()), DiskError);
    EXPECT_THROW(LightTiles(place(), mShape), DiskError);
    EXPECT_THROW(loadTerrainLight(place(), nullptr), DiskError);
}

// Where the disk fails in the head, in the index (of each tile's check value) or in a tile, that is told, and
// neither damage nor a reason to make anything anew. Other tiles can be read.
TEST_F(FineLightFile, ADiskThatFailsInTheIndexOrATileIsNoDamage) {
    writeAll();
    const std::string whole = fileBytes(place());
    constexpr std::uint64_t kHead = 48, kCheck = sizeof(std::uint64_t);
    for (const std::uint64_t byte : {std::uint64_t{3}, kHead, kHead + kCheck, kHead + 3 * kCheck - 1}) {
        SCOPED_TRACE(byte);
        const FailingReads fails(place(), byte);
        EXPECT_THROW(LightTiles(place(), mShape), DiskError);
        EXPECT_THAT(problem(mShape), AllOf(HasSubstr("a.light.fine"), HasSubstr("disk reports an error")));
    }
    const LightTiles tiles(place(), mShape);
    std::uint64_t at = kHead + tiles.count() * kCheck;
    for (std::size_t n = 0; n < tiles.count(); ++n) {
        const LightTiles::Tile bad = tiles.tile(n);
        const std::uint64_t bytes = bytesOf(lightOf(tiles, n)).size();
        for (const std::uint64_t byte : {at, at + bytes / 2, at + bytes - 1}) {
            SCOPED_TRACE(byte);
            const FailingReads fails(place(), byte);
            EXPECT_THROW(tiles.read(bad), DiskError);
            EXPECT_THROW(tiles.isWhole(), DiskError);
            for (std::size_t other = 0; other < tiles.count(); ++other) {
                if (other != n) {
                    EXPECT_TRUE(tiles.read(tiles.tile(other)));
                }
            }
        }
        at += bytes;
    }
    ASSERT_EQ(at, whole.size()) << "all of the file was tried";
    EXPECT_TRUE(tiles.isWhole());
    EXPECT_EQ(fileBytes(place()), whole);
}

// The same of one that is gone on from: what an earlier run has baked is not baked again, nor lost.
TEST_F(FineLightFile, ADiskThatFailsUnderWhatWasBegunKeepsIt) {
    {
        LightTiles tiles = LightTiles::begin(part(), mShape);
        tiles.write(1, bytesOf(lightOf(tiles, 1)));
    }
    const std::string begun = fileBytes(part());
    constexpr std::uint64_t kHead = 48, kIndex = 3 * sizeof(std::uint64_t);
    const std::uint64_t first = bytesOf(lightOf(LightTiles::begin(part(), mShape), 0)).size();
    for (const std::uint64_t byte : {std::uint64_t{0}, kHead, kHead + kIndex - 1, kHead + kIndex + first,
                                     kHead + kIndex + first + 1000}) {
        SCOPED_TRACE(byte);
        {
            const FailingReads fails(part(), byte);
            EXPECT_THROW(LightTiles::begin(part(), mShape), DiskError);
        }
        EXPECT_EQ(fileBytes(part()), begun);
    }
    EXPECT_TRUE(LightTiles::begin(part(), mShape).has(1));
}

// Threads that stand for processes; and one that is stopped after its first tile.
TEST_F(FineLightFile, AnyNumberOfProcessesMakesTheSameBytes) {
    const TwoLevels ground(makeGround("smooth", 300, 140, 1));
    const TerrainLight light = bakeOf(ground.coarse, quick(1));
    const FineBake bake(ground.levels, ground.coarse, light);
    const FineLightShape shape = fineLightShape(ground.levels, 1, light, 3);
    EXPECT_EQ(shape.finest, 0);
    EXPECT_EQ(shape.coarsest, 0);
    runAsPeers(3, [&](Peers& peers) {
        Progress quiet;
        bakeFineLight(bake, place(), part(), shape, quiet, peers);
    });
    const std::string three = fileBytes(place());
    fs::remove(place());
    Peers alone;
    Progress* itself = nullptr;
    Progress stopping([&](double done, const std::string&) {
        if (done > 0) itself->cancel();
    });
    itself = &stopping;
    EXPECT_THROW(bakeFineLight(bake, place(), part(), shape, stopping, alone), Cancelled);
    EXPECT_FALSE(fs::exists(place()));
    EXPECT_TRUE(LightTiles::begin(part(), shape).has(0));
    double first = -1;
    Progress going([&](double done, const std::string&) {
        if (first < 0 && done > 0) first = done;
    });
    bakeFineLight(bake, place(), part(), shape, going, alone);
    EXPECT_EQ(first, 0.5);
    EXPECT_EQ(fileBytes(place()), three);
}

}  // namespace
}  // namespace stereonav::test
