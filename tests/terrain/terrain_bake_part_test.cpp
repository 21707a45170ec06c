// A terrain's bake that is stopped goes on where it was, to the same bytes.
#include "terrain/light/terrain_bake_part.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "engine/base/error.h"
#include "terrain/ground/ground_horizon.h"
#include "terrain/light/terrain_horizon.h"
#include "terrain/light/terrain_light.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

class TerrainBakePart : public testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "stereonav-part-XXXXXX").string();
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        mFolder = pattern;
        if (const char* before = std::getenv("XDG_CACHE_HOME")) mBefore = before;
        setenv("XDG_CACHE_HOME", mFolder.c_str(), 1);
        mSettings.rays = 16;
        mSettings.bounces = 2;
    }
    void TearDown() override {
        mBefore.empty() ? unsetenv("XDG_CACHE_HOME") : setenv("XDG_CACHE_HOME", mBefore.c_str(), 1);
        fs::remove_all(mFolder);
    }

    // Bakes, and stops once so much is done. Returns the fraction of the first report that is not 0.
    double bakeUntil(double end) const {
        double first = 0;
        Progress* itself = nullptr;
        Progress progress([&](double fraction, const std::string&) {
            if (first == 0) first = fraction;
            if (fraction >= end) itself->cancel();
        });
        itself = &progress;
        EXPECT_THROW(bakeTerrainLight(mGround, mSettings, progress, true), Cancelled);
        return first;
    }
    TerrainLight bake(bool keeps) const {
        Progress quiet;
        return bakeTerrainLight(mGround, mSettings, quiet, keeps);
    }
    void expectSame(const TerrainLight& light) const {
        const TerrainLight whole = bake(false);
        EXPECT_EQ(light.openness, whole.openness);
        EXPECT_EQ(light.horizon, whole.horizon);
        EXPECT_EQ(light.full, whole.full);
        EXPECT_EQ(light.bounced, whole.bounced);
    }
    fs::path part() const { return terrainBakePart(terrainLightKey(mGround, mSettings)); }

    const Heightfield mGround = test::makeGround("rough", 41, 65, 1);
    TerrainLightSettings mSettings;
    fs::path mFolder;
    std::string mBefore;
};

TEST_F(TerrainBakePart, GoesOnFromEveryPhase) {
    double before = 0;
    for (const double end : {0.2, 0.35, 0.6, 0.85, 0.95}) {
        SCOPED_TRACE(end);
        const double first = bakeUntil(end);
        EXPECT_GE(first, before) << "what was done was done again";
        before = end - 0.15;  // a band of rows
        EXPECT_TRUE(fs::exists(part()));
    }
    expectSame(bake(true));
    EXPECT_FALSE(fs::exists(part())) << "it is of no use any more";
}

TEST_F(TerrainBakePart, OfOpenness) {
    mSettings.kind = TerrainLightKind::Openness;
    bakeUntil(0.5);
    expectSame(bake(true));
}

TEST_F(TerrainBakePart, OfAnotherBakeIsLeftAlone) {
    bakeUntil(0.5);
    const fs::path other = part();
    mSettings.rays = 32;
    EXPECT_LT(bakeUntil(0.3), 0.2);
    EXPECT_TRUE(fs::exists(other));
}

// What comes before a damaged band counts, and nothing of it or behind it; each band in turn, first and last.
TEST_F(TerrainBakePart, DamagedIsMadeAnew) {
    for (const int place : {3, 20, 60, 5000, 60000}) {
        SCOPED_TRACE(place);
        bakeUntil(0.6);
        std::fstream file(part(), std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(place);
        file.put('\x55');
        file.close();
        expectSame(bake(true));
    }
    for (const double end : {0.3, 0.6, 0.85}) {
        bakeUntil(end);
        fs::resize_file(part(), fs::file_size(part()) - 1);
        expectSame(bake(true));
    }
}

std::vector<std::byte> filledBytes(std::size_t count, int value) {
    return std::vector<std::byte>(count, static_cast<std::byte>(value));
}

// Bands that are kept while the bake runs, as a kill or a power cut may leave them.
TEST_F(TerrainBakePart, BandsAreReadAsFarAsTheyAreWhole) {
    constexpr std::uint64_t kKey = 7;
    constexpr int kRows = 10, kPhases = 2;
    std::uint64_t end = 0, beforeLast = 0;
    for (const BakeBand& band : {BakeBand{0, 0, 4}, {0, 4, 6}, {1, 0, 3}}) {
        auto content = filledBytes(100, 10 * band.phase + band.first);
        beforeLast = end;
        end = keepBakeBand(kKey, end, band, {std::span(content)});
        ASSERT_EQ(end, fs::file_size(terrainBakePart(kKey)));
    }
    std::vector<std::byte> got;
    std::vector<int> firsts;
    const auto read = [&](std::uint64_t key, int rows, int phases) {
        firsts.clear();
        return readBakePart(key, rows, phases, [&](const BakeBand& band) -> BakeBlocks {
            firsts.push_back(10 * band.phase + band.first);
            got = filledBytes(100, 0x77);
            return {std::span(got)};
        });
    };
    BakeKept kept = read(kKey, kRows, kPhases);
    EXPECT_EQ(kept.reached.phase, 1);
    EXPECT_EQ(kept.reached.rows, 3);
    EXPECT_EQ(kept.bytes, end);
    EXPECT_EQ(firsts, (std::vector{0, 4, 10}));
    EXPECT_EQ(got, filledBytes(100, 10));
    EXPECT_EQ(read(kKey, kRows, 1).reached.rows, 10) << "a phase that this bake does not have";
    EXPECT_EQ(read(kKey, 11, kPhases).reached.rows, 10) << "a phase before its time";
    EXPECT_EQ(read(kKey + 1, kRows, kPhases).bytes, 0u);

    fs::resize_file(terrainBakePart(kKey), end - 1);
    kept = read(kKey, kRows, kPhases);
    EXPECT_EQ(kept.reached.phase, 0);
    EXPECT_EQ(kept.reached.rows, 10);
    EXPECT_EQ(kept.bytes, beforeLast);
    EXPECT_EQ(got, filledBytes(100, 0)) << "nothing of what is cut off stays";

    auto again = filledBytes(100, 10);
    EXPECT_EQ(keepBakeBand(kKey, kept.bytes, {1, 0, 3}, {std::span(again)}), end);
    EXPECT_EQ(read(kKey, kRows, kPhases).bytes, end);
    fs::remove(terrainBakePart(kKey));
    EXPECT_EQ(keepBakeBand(kKey, end, {1, 3, 3}, {std::span(again)}), 0u)
        << "the cache was emptied meanwhile";
    EXPECT_FALSE(fs::exists(terrainBakePart(kKey)));
}

// A row of a large ground takes longer than a stop may.
TEST_F(TerrainBakePart, ARowCanBeLeft) {
    const Heightfield ground = test::makeGround("rough", 200, 9, 1);
    const GroundHorizon horizons(ground);
    const LightGrid grid(ground, 1);
    std::vector<std::uint8_t> horizon(8u * 200, 200);
    int asked = 0;
    const auto wish = [&] {
        if (++asked == 3) throw Cancelled();
    };
    EXPECT_THROW(bakeHorizonRow(horizons, grid, 4, 8, horizon.data(), 200, wish), Cancelled);
    EXPECT_EQ(horizon[2 * 16], 200) << "looked at after the wish";
    EXPECT_NE(horizon[2 * 16 - 1], 200);
}

}  // namespace
}  // namespace stereonav
