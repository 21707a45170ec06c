// Baked light in files: back as it was, and one clear line for what is no light, or not this ground's.
#include <gtest/gtest.h>

#include <fstream>

#include "engine/base/parallel.h"
#include "raster_files.h"
#include "terrain/light/terrain_light.h"
#include "tests/support/own_cache.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

using test::errorOf;
using test::TempFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TerrainLight bake(const Heightfield& ground, const TerrainLightSettings& settings = {}) {
    Progress quiet;
    return bakeTerrainLight(ground, settings, quiet);
}

std::string bytesOf(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

TEST(TerrainLightFile, ComesBackAsItWas) {
    const TempFolder folder;
    const Heightfield ground = test::makeGround("smooth", 23, 19, 1);
    for (const TerrainLightKind kind : {TerrainLightKind::Transfer, TerrainLightKind::Openness}) {
        TerrainLightSettings settings;
        settings.kind = kind;
        settings.stride = 2;
        const TerrainLight light = bake(ground, settings);
        saveTerrainLight(folder / "a.light", light);
        EXPECT_TRUE(isTerrainLight(folder / "a.light"));
        const TerrainLight back = loadTerrainLight(folder / "a.light", &ground);
        EXPECT_EQ(back.openness, light.openness);
        EXPECT_EQ(back.horizon, light.horizon);
        EXPECT_EQ(back.full, light.full);
        EXPECT_EQ(back.bounced, light.bounced);
        EXPECT_EQ(back.key, light.key);
        EXPECT_EQ(back.grid.width, 12);
        EXPECT_EQ(back.grid.height, 10);
        saveTerrainLight(folder / "b.light", back);
        EXPECT_EQ(bytesOf(folder / "a.light"), bytesOf(folder / "b.light"));
        EXPECT_EQ(light.openness.size(), 120u);
        EXPECT_EQ(light.full.empty(), kind == TerrainLightKind::Openness);
    }
}

TEST(TerrainLightFile, DoesNotDependOnTheThreadCount) {
    const TempFolder folder;
    const Heightfield ground = test::makeGround("rough", 61, 45, 2);
    const int before = threadCount();
    std::vector<std::string> files;
    for (const int threads : {1, 2, 5}) {
        setThreadCount(threads);
        saveTerrainLight(folder / "x.light", bake(ground));
        files.push_back(bytesOf(folder / "x.light"));
    }
    setThreadCount(before);
    EXPECT_FALSE(files[0].empty());
    EXPECT_EQ(files[0], files[1]);
    EXPECT_EQ(files[0], files[2]);
}

TEST(TerrainLightFile, NamesWhatIsWrong) {
    const TempFolder folder;
    const Heightfield ground = test::makeGround("smooth", 23, 19, 1);
    const auto file = folder / "ground.light";
    saveTerrainLight(file, bake(ground));
    const std::string good = bytesOf(file);
    const auto problemOf = [&](const std::string& bytes) {
        write(file, bytes);
        return errorOf([&] { loadTerrainLight(file, &ground); });
    };
    const auto says = [&](const std::string& what) {
        return AllOf(HasSubstr(file.string() + ":"), HasSubstr(what), HasSubstr("bake"),
                     Not(HasSubstr("\n")));
    };
    for (const std::size_t length : {std::size_t{0}, std::size_t{7}, std::size_t{79}})
        EXPECT_THAT(problemOf(good.substr(0, length)), says("something else")) << length;
    for (const std::size_t length : {std::size_t{80}, good.size() / 2, good.size() - 1})
        EXPECT_THAT(problemOf(good.substr(0, length)), says("cut off")) << length;
    EXPECT_THAT(problemOf(good + "x"), says("cut off or damaged"));
    EXPECT_THAT(problemOf("P5 4 4 255" + good), says("something else"));
    std::string other = good;
    other[8] = 9;
    EXPECT_THAT(problemOf(other), says("version"));
    // Any byte of the rest: sizes that do not fit, or a checksum that does not.
    int tried = 0;
    for (std::size_t at = 12; at < good.size(); at += at < 90 ? 1 : good.size() / 37) {
        std::string damaged = good;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
        EXPECT_THAT(problemOf(damaged), says("damage")) << at;
        ++tried;
    }
    EXPECT_GT(tried, 80);
    EXPECT_THAT(errorOf([&] { loadTerrainLight(folder / "none.light", nullptr); }),
                HasSubstr("can not be read"));
}

TEST(TerrainLightFile, IsOfOneGround) {
    const TempFolder folder;
    const Heightfield ground = test::makeGround("smooth", 23, 19, 1);
    saveTerrainLight(folder / "a.light", bake(ground));
    const Heightfield flat = test::makeGround("flat", 23, 19, 1);
    EXPECT_THAT(errorOf([&] { loadTerrainLight(folder / "a.light", &flat); }), HasSubstr("other ground"));
    EXPECT_NE(terrainLightCache(flat), terrainLightCache(ground));
    TerrainLightSettings more;
    more.bounces = 3;
    EXPECT_NE(terrainLightKey(ground, more), terrainLightKey(ground, {}));
}

}  // namespace
}  // namespace stereonav
