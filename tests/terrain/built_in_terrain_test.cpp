// The generated terrain: the same bits always, mountains in range, and a cache that mends itself;
// the erosion behind it against the closed form of a steady river.
#include "terrain/built_in/built_in_terrain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "engine/base/file.h"
#include "engine/base/hash.h"
#include "engine/base/parallel.h"
#include "terrain/built_in/erosion.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

std::uint64_t hashOf(const BuiltInTerrain& t) {
    Hash hash;
    hash.add(t.heights.data(), t.heights.size() * sizeof(float));
    for (int y = 0; y < t.color.height(); ++y)
        hash.add(t.color.row(y), sizeof(PackedColor) * static_cast<std::size_t>(t.color.width()));
    return hash.value();
}

TEST(BuiltInTerrain, IsTheSameForAnyThreadCount) {
    Progress progress;
    const int before = threadCount();
    setThreadCount(1);
    const auto one = hashOf(generateBuiltInTerrain(5, 129, progress));
    setThreadCount(4);
    const auto four = hashOf(generateBuiltInTerrain(5, 129, progress));
    setThreadCount(before);
    EXPECT_EQ(one, four);
    EXPECT_NE(one, hashOf(generateBuiltInTerrain(6, 129, progress)));
}

TEST(BuiltInTerrain, HasMountainsAndPlains) {
    Progress progress;
    for (const std::uint64_t seed : {0ull, 1ull, 2ull, ~0ull}) {
        const BuiltInTerrain t = generateBuiltInTerrain(seed, 257, progress);
        ASSERT_EQ(t.heights.size(), 257u * 257u);
        EXPECT_EQ(t.color.width(), 771);
        EXPECT_EQ(t.color.height(), 771);
        const auto [low, high] = std::minmax_element(t.heights.begin(), t.heights.end());
        EXPECT_GE(*low, 0.0f);
        EXPECT_NEAR(*high, 2500.0f, 1.0f);
        const auto below = [&](float h) {
            return std::count_if(t.heights.begin(), t.heights.end(), [h](float x) { return x < h; }) /
                   double(t.heights.size());
        };
        EXPECT_GT(below(300), 0.05) << "seed " << seed << " has no low ground";
        EXPECT_LT(below(1200), 0.95) << "seed " << seed << " has no mountains";
        EXPECT_THAT(t.heights, testing::Each(testing::Truly([](float h) { return std::isfinite(h); })));
    }
}

TEST(BuiltInTerrain, TakesItsSmallestSizeAndRefusesOthers) {
    Progress progress;
    EXPECT_EQ(generateBuiltInTerrain(1, kBuiltInSizeMin, progress).heights.size(), 17u * 17u);
    EXPECT_EQ(generateBuiltInTerrain(1, 100, progress).heights.size(), 10000u);
    for (const int size : {-1, 0, 16, 2050, 100000}) {
        try {
            generateBuiltInTerrain(1, size, progress);
            FAIL() << size;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(),
                        testing::HasSubstr("expected 17 to 2049 samples, got " + std::to_string(size)));
        }
    }
}

TEST(BuiltInTerrain, StopsWhenAsked) {
    Progress progress;
    progress.cancel();
    EXPECT_THROW(generateBuiltInTerrain(1, 65, progress), Cancelled);
}

// Caching in a folder of its own; the environment is put back afterwards.
class BuiltInCache : public testing::Test {
protected:
    void SetUp() override {
        if (const char* old = std::getenv("XDG_CACHE_HOME")) mOld = old;
        mFolder = fs::temp_directory_path() / ("stereonav_cache_test_" + std::to_string(getpid()));
        fs::remove_all(mFolder);
        setenv("XDG_CACHE_HOME", mFolder.c_str(), 1);
    }
    void TearDown() override {
        mOld.empty() ? unsetenv("XDG_CACHE_HOME") : setenv("XDG_CACHE_HOME", mOld.c_str(), 1);
        fs::remove_all(mFolder);
    }
    // The one file in the cache.
    static fs::path cached() {
        fs::path found;
        for (const auto& entry : fs::directory_iterator(cacheFolder())) {
            EXPECT_TRUE(found.empty()) << "more than one file: " << entry.path();
            found = entry.path();
        }
        return found;
    }
    static void overwrite(const fs::path& file, std::streamoff at, char byte) {
        std::fstream io(file, std::ios::in | std::ios::out | std::ios::binary);
        io.seekp(at);
        io.put(byte);
    }
    fs::path mFolder;
    std::string mOld;
    int mMade = 0;
    // Counts the steps of making: what is read back is told at its begin and its end alone.
    Progress mProgress{
        [this](double fraction, const std::string&) { mMade += fraction > 0 && fraction < 1; }};
};

TEST_F(BuiltInCache, SecondTimeIsReadAndEqual) {
    const auto first = hashOf(builtInTerrain(3, 65, mProgress));
    EXPECT_GT(mMade, 0);
    EXPECT_TRUE(fs::exists(cached()));
    mMade = 0;
    EXPECT_EQ(hashOf(builtInTerrain(3, 65, mProgress)), first);
    EXPECT_EQ(mMade, 0);
}

TEST_F(BuiltInCache, DamageIsNoticedAndMended) {
    const auto truth = hashOf(builtInTerrain(3, 65, mProgress));
    const fs::path file = cached();
    const auto bytes = static_cast<std::streamoff>(fs::file_size(file));
    for (const std::streamoff at :
         {std::streamoff{0}, std::streamoff{8}, std::streamoff{35}, std::streamoff{5000}, bytes - 1}) {
        overwrite(file, at, '\x5a');
        mMade = 0;
        EXPECT_EQ(hashOf(builtInTerrain(3, 65, mProgress)), truth) << at;
        EXPECT_GT(mMade, 0) << "damage at " << at << " was not noticed";
    }
    fs::resize_file(file, 100);
    mMade = 0;
    EXPECT_EQ(hashOf(builtInTerrain(3, 65, mProgress)), truth);
    EXPECT_GT(mMade, 0);
    mMade = 0;
    EXPECT_EQ(hashOf(builtInTerrain(3, 65, mProgress)), truth);
    EXPECT_EQ(mMade, 0) << "the mended cache was not used";
}

TEST_F(BuiltInCache, AFolderThatCanNotBeWrittenIsDoneWithout) {
    fs::create_directories(mFolder);
    std::ofstream(mFolder / "stereonav") << "a file where the folder should be";
    EXPECT_EQ(builtInTerrain(3, 33, mProgress).size, 33);
}

// A steady landscape has the slope U / (K sqrt(A)) everywhere: uplift and cutting in balance (Braun and
// Willett 2013, equation 6 with m = 1/2, n = 1).
TEST(Erosion, ReachesTheSteadySlope) {
    Landscape land;
    land.size = 41;
    land.spacing = 100;
    land.height.assign(41 * 41, 0.0f);
    land.uplift.assign(41 * 41, 1.0f);
    land.talus.assign(41 * 41, 1e6f);
    for (int k = 0; k < 41 * 41; ++k) land.height[k] = static_cast<float>(k * 7919 % 101) * 0.1f;
    fillDepressions(land);
    const float erodibility = 1e-3f;
    for (int k = 0; k < 300; ++k) erode(land, 200, erodibility, 1);
    int checked = 0, steady = 0;
    for (int i = 0; i < 41 * 41; ++i) {
        const int r = land.receiver[i];
        if (r == i) continue;
        const bool straight = std::abs(r - i) == 1 || std::abs(r - i) == 41;
        const float slope = (land.height[i] - land.height[r]) / (straight ? 100.0f : 141.421356f);
        const float truth = 1.0f / (erodibility * std::sqrt(land.drainage[i]));
        ++checked;
        steady += std::abs(slope / truth - 1) < 0.01f;
    }
    EXPECT_EQ(checked, 39 * 39);
    // The few others lie where a divide has just moved and the drainage with it.
    EXPECT_GT(steady, 0.97 * checked);
}

TEST(Erosion, AllWaterReachesTheBorder) {
    Landscape land;
    land.size = 33;
    land.spacing = 30;
    land.height.resize(33 * 33);
    for (int k = 0; k < 33 * 33; ++k) land.height[k] = static_cast<float>(k * 104729 % 977);
    land.uplift.assign(33 * 33, 0.3f);
    land.talus.assign(33 * 33, 0.7f);
    fillDepressions(land);
    erode(land, 50, 1e-3f, 9);
    double arrived = 0;
    for (int i = 0; i < 33 * 33; ++i) {
        const int x = i % 33, y = i / 33;
        const bool border = x == 0 || y == 0 || x == 32 || y == 32;
        EXPECT_EQ(land.receiver[i] == i, border) << i;
        if (border)
            arrived += land.drainage[i];
        else
            EXPECT_GT(land.height[i], land.height[land.receiver[i]]) << i;
    }
    EXPECT_DOUBLE_EQ(arrived, 33 * 33 * 900.0);
}

}  // namespace
}  // namespace stereonav
