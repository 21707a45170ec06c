// `bake` at finer samples where such light lies there already: what is whole is left, what is damaged is made
// anew, and what can not be read now is neither.
#include "app/command/bake_finer.h"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/output/progress_bar.h"
#include "engine/base/error.h"
#include "terrain/light/fine_bake.h"
#include "terrain/light/light_tiles.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/failing_reads.h"
#include "tests/support/file_bytes.h"
#include "tests/support/test_grounds.h"

namespace stereonav::test {
namespace {

namespace fs = std::filesystem;

class BakeFiner : public testing::Test {
protected:
    BakeFiner() {
        mSettings.kind = TerrainLightKind::Openness;
        mSettings.azimuths = 8;
        mSettings.rays = 16;
        mSettings.bounces = 0;
        mTerrain.tiled.emplace();
        mTerrain.tiled->levels = mLevels;
        mTerrain.tiled->level = 1;
        mTerrain.ground = *mLevels->part(1, glm::ivec2(0), mLevels->size(1));
    }
    // Returns whether the light was baked before.
    bool bake() {
        ProgressBar bar(false);
        Telling quiet;
        quiet.quiet = true;
        CommandResult result("bake", quiet, {});
        EXPECT_TRUE(bakeFiner(mTerrain, std::nullopt, mSettings, 1, mLight, bar, result));
        result.writeTo(mFolder / "told.json");
        return nlohmann::json::parse(fileBytes(mFolder / "told.json")).at("finer_baked_before").get<bool>();
    }
    // A whole file of that light, with other bytes in its tiles than a bake makes.
    void putOthersBytes() {
        TerrainLight light;
        light.settings = mSettings;
        light.key = terrainLightKey(mTerrain.ground, mSettings);
        const FineLightShape shape = fineLightShape(*mLevels, 1, light, 1);
        LightTiles tiles = LightTiles::begin(part(), shape);
        for (std::size_t n = 0; n < tiles.count(); ++n) {
            const glm::ivec2 size = tiles.sizeOf(tiles.tile(n));
            tiles.write(n, std::vector<std::byte>(static_cast<std::size_t>(size.x) * size.y, std::byte{99}));
        }
        tiles.finish(place());
    }
    fs::path place() const { return fineLightPlace(mLight); }
    fs::path part() const { return place().string() + ".part"; }

    TemporaryFolder mFolder;
    fs::path mLight = mFolder / "a.light";
    Heightfield mFine = makeGround("smooth", 300, 140, 1);
    std::shared_ptr<const GroundLevels> mLevels = std::make_shared<GroundLevels>(mFine);
    TerrainScene mTerrain;
    TerrainLightSettings mSettings;
};

TEST_F(BakeFiner, IsMadeOnceAndAnewWhereItIsDamaged) {
    EXPECT_FALSE(bake());
    const std::string made = fileBytes(place());
    EXPECT_TRUE(bake());
    EXPECT_EQ(fileBytes(place()), made);
    {
        std::fstream file(place(), std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(static_cast<std::streamoff>(made.size()) - 100);
        file << "damage";
    }
    EXPECT_FALSE(bake());
    EXPECT_EQ(fileBytes(place()), made);
    fs::resize_file(place(), made.size() / 2);
    EXPECT_FALSE(bake());
    EXPECT_EQ(fileBytes(place()), made);
}

TEST_F(BakeFiner, WhatCanNotBeReadNowIsNotMadeAnew) {
    putOthersBytes();
    const std::string there = fileBytes(place());
    EXPECT_TRUE(bake()) << "it is whole";
    for (const std::uint64_t byte : {std::uint64_t{0}, std::uint64_t{48}, std::uint64_t{64},
                                     std::uint64_t{there.size() / 2}, std::uint64_t{there.size() - 1}}) {
        SCOPED_TRACE(byte);
        {
            const FailingReads fails(place(), byte);
            EXPECT_THROW(bake(), DiskError);
        }
        ASSERT_TRUE(fs::exists(place()));
        EXPECT_EQ(fileBytes(place()), there);
        EXPECT_FALSE(fs::exists(part()));
    }
    // The unfinished file of an earlier run is left unchanged, too, where reading it fails.
    fs::rename(place(), part());
    for (const std::uint64_t byte : {std::uint64_t{48}, std::uint64_t{there.size() - 1}}) {
        SCOPED_TRACE(byte);
        {
            const FailingReads fails(part(), byte);
            EXPECT_THROW(bake(), DiskError);
        }
        EXPECT_EQ(fileBytes(part()), there);
        EXPECT_FALSE(fs::exists(place()));
    }
    EXPECT_FALSE(bake());
    EXPECT_EQ(fileBytes(place()), there) << "all of its tiles were there";
}

}  // namespace
}  // namespace stereonav::test
