// A terrain's bake that is stopped goes on where it was, to the same bytes.
#include "terrain/terrain_bake_part.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "engine/base/error.h"
#include "terrain/terrain_light.h"
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

    // Stopped once so much is done; the fraction of the first report that is not 0.
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

TEST_F(TerrainBakePart, DamagedIsMadeAnew) {
    for (const int place : {3, 20, 5000}) {
        bakeUntil(0.6);
        std::fstream file(part(), std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(place);
        file.put('\x55');
        file.close();
        expectSame(bake(true));
    }
    bakeUntil(0.6);
    fs::resize_file(part(), fs::file_size(part()) - 1);
    expectSame(bake(true));
}

}  // namespace
}  // namespace stereonav
