// Tiles on disk hold what levels in memory do, and what is damaged is refused.
#include "terrain/tiles/tile_store.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "engine/base/error.h"
#include "terrain/ground/ground_levels.h"
#include "terrain/tiles/tile_maker.h"

namespace stereonav {
namespace {

std::vector<float> roughHeights(const glm::ivec2& size, double missing) {
    std::mt19937 random(9);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<float> heights;
    heights.reserve(static_cast<std::size_t>(size.x) * size.y);
    for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; ++i)
            heights.push_back(unit(random) < missing
                                  ? std::nanf("")
                                  : static_cast<float>(300 * std::sin(i / 70.) * std::cos(j / 50.)) +
                                        10 * unit(random));
    return heights;
}

TileSource sourceOf(const std::vector<float>& heights, const glm::ivec2& size, int rows) {
    return {size, 77, rows, 0, [&heights, size](int first, int count, float* to) {
                std::copy_n(heights.data() + static_cast<std::ptrdiff_t>(first) * size.x,
                            static_cast<std::ptrdiff_t>(count) * size.x, to);
            }};
}

// Compares bits, so that values which are no numbers count too.
bool sameBits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

std::vector<float> wholeLevel(const TileStore& store, int level) {
    const glm::ivec2 size = store.size(level);
    std::vector<float> heights(static_cast<std::size_t>(size.x) * size.y);
    store.read(level, glm::ivec2(0), size, heights.data());
    return heights;
}

class Tiles : public testing::Test {
protected:
    std::filesystem::path mFile = std::filesystem::path(testing::TempDir()) / "made_ground.tiles";
    Progress mProgress;

    void TearDown() override { std::filesystem::remove(mFile); }

    void make(const std::vector<float>& heights, const glm::ivec2& size, int rows = 64) {
        makeTiles(sourceOf(heights, size, rows), mFile, mProgress);
    }
};

TEST_F(Tiles, HoldTheLevelsAndBoundsOfTheGroundInMemory) {
    struct Case {
        glm::ivec2 size;
        double missing;
        int rows;
    };
    for (const Case& c : {Case{{1300, 900}, 0, 64}, Case{{1025, 1025}, 0.01, 256}, Case{{700, 1281}, 0.3, 1},
                          Case{{257, 130}, 0, 1000}, Case{{2, 2}, 0, 1}}) {
        const std::vector<float> heights = roughHeights(c.size, c.missing);
        make(heights, c.size, c.rows);
        const TileStore store(mFile, 77);
        const Heightfield ground(c.size.x, c.size.y, {3, 5}, heights, "rough");
        const GroundLevels levels(ground);
        ASSERT_EQ(store.levels(), levels.count()) << c.size.x;
        EXPECT_TRUE(sameBits(wholeLevel(store, 0), heights)) << c.size.x;
        for (int level = 1; level < store.levels(); ++level) {
            const glm::ivec2 size = store.size(level);
            ASSERT_EQ(size, levels.size(level));
            const Heightfield part = levels.part(level, glm::ivec2(0), size).value();
            EXPECT_TRUE(sameBits(wholeLevel(store, level),
                                 std::vector<float>(part.data(), part.data() + std::size_t(size.x) * size.y)))
                << "level " << level << " of " << c.size.x;
            for (int j = 0; j < levels.blocks(level).y; ++j)
                for (int i = 0; i < levels.blocks(level).x; ++i)
                    ASSERT_EQ(store.bounds(level)[static_cast<std::size_t>(j) * levels.blocks(level).x + i],
                              levels.errorBound(level, i, j))
                        << level << " " << i << " " << j << " of " << c.size.x;
        }
        const auto known = std::count_if(heights.begin(), heights.end(), [](float h) { return h == h; });
        EXPECT_EQ(store.missing(), static_cast<long long>(heights.size()) - known);
        if (c.missing == 0) {
            EXPECT_EQ(store.low(), ground.minHeight());
            EXPECT_EQ(store.high(), ground.maxHeight());
        }
    }
}

TEST_F(Tiles, GiveAnyPart) {
    const glm::ivec2 size(900, 700);
    const std::vector<float> heights = roughHeights(size, 0);
    make(heights, size);
    const TileStore store(mFile, 77);
    for (const auto& [low, part] : {std::pair{glm::ivec2(0), glm::ivec2(1)},
                                    {{255, 255}, {2, 2}},
                                    {{899, 699}, {1, 1}},
                                    {{200, 10}, {600, 680}}}) {
        std::vector<float> got(static_cast<std::size_t>(part.x) * part.y);
        store.read(0, low, part, got.data());
        for (int j = 0; j < part.y; ++j)
            for (int i = 0; i < part.x; ++i)
                ASSERT_EQ(got[static_cast<std::size_t>(j) * part.x + i],
                          heights[static_cast<std::size_t>(low.y + j) * size.x + low.x + i]);
    }
}

void damage(const std::filesystem::path& file, std::uint64_t at) {
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(at));
    const char before = static_cast<char>(stream.get());
    stream.seekp(static_cast<std::streamoff>(at));
    stream.put(static_cast<char>(before ^ 4));
}

TEST_F(Tiles, AreRefusedWhereDamaged) {
    const glm::ivec2 size(600, 500);
    const std::vector<float> heights = roughHeights(size, 0);
    make(heights, size);
    EXPECT_THROW(TileStore(mFile, 78), Error) << "of other heights";
    EXPECT_THROW(TileStore(mFile.string() + ".none", 77), Error);
    const TileFilePlan plan(size);

    damage(mFile, plan.levels()[0].data + 5 * kTileBytes + 1000);
    {
        const TileStore store(mFile, 77);
        std::vector<float> tile(static_cast<std::size_t>(kTileSide) * 10);
        store.read(0, {0, 0}, {kTileSide, 10}, tile.data());  // another one is fine
        try {
            store.read(0, {2 * kTileSide, kTileSide}, {80, 10}, tile.data());
            FAIL() << "a damaged tile was given";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("tile 2, 1 of level 0"), std::string::npos)
                << error.what();
        }
    }
    damage(mFile, plan.levels()[1].bounds);
    EXPECT_THROW(TileStore(mFile, 77), Error) << "its index";
    make(heights, size);
    damage(mFile, 16);
    EXPECT_THROW(TileStore(mFile, 77), Error) << "its head";
    make(heights, size);
    std::filesystem::resize_file(mFile, std::filesystem::file_size(mFile) - 1);
    EXPECT_THROW(TileStore(mFile, 77), Error) << "cut off";
    std::ofstream(mFile) << "something else";
    EXPECT_THROW(TileStore(mFile, 77), Error);
}

TEST_F(Tiles, SayWhereTheyCanNotBeWritten) {
    const glm::ivec2 size(300, 300);
    const std::vector<float> heights = roughHeights(size, 0);
    try {
        makeTiles(sourceOf(heights, size, 16), "/dev/full/no", mProgress);
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("/dev/full/no"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace stereonav
