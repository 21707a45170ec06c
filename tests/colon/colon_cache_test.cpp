// The cache gives back what was found, and nothing when its file is damaged, cut off or another's.
#include "colon/scene/colon_cache.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>

#include "engine/base/file.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

class ColonCacheTest : public ::testing::Test {
protected:
    void SetUp() override {
        mFolder = fs::temp_directory_path() / ("stereonav-cache-" + std::to_string(::getpid()));
        fs::remove_all(mFolder);
        fs::create_directories(mFolder);
        if (const char* before = std::getenv("XDG_CACHE_HOME")) mBefore = before;
        setenv("XDG_CACHE_HOME", mFolder.c_str(), 1);
    }
    void TearDown() override {
        mBefore.empty() ? unsetenv("XDG_CACHE_HOME") : setenv("XDG_CACHE_HOME", mBefore.c_str(), 1);
        fs::remove_all(mFolder);
    }
    fs::path onlyFile() const { return fs::directory_iterator(cacheFolder())->path(); }
    fs::path mFolder;
    std::string mBefore;
};

FoundColon tube() {
    FoundColon found;
    VolumeFrame frame;
    frame.size = {40, 37, 50};
    frame.spacing = {0.0007, 0.0008, 0.0009};
    frame.origin = {0.1, -0.2, 0.3};
    found.format = "NRRD";
    found.ofMask = true;
    found.studyFrame = frame;
    found.studyFrame.size = {140, 137, 150};
    found.notes = {"one", ""};
    found.values = {-1024, 1266};
    found.lumen.isovalue = -450;
    found.lumen.field = GreyVolume(frame);
    found.lumen.lumen = MaskVolume(frame);
    for (int k = 0; k < 50; ++k)
        for (int j = 0; j < 37; ++j)
            for (int i = 0; i < 40; ++i) {
                const double d = std::hypot(i - 9.0, j - 9.0);
                found.lumen.field.at(i, j, k) = static_cast<std::int16_t>(10 * d + k);
                found.lumen.lumen.at(i, j, k) = d < 4 && k > 10 ? 1 + (k > 30) : 0;
            }
    found.lumen.segments = {{100, 0.1, {1, 2, 3}, {4, 5, 6}}, {200, 0.2, {}, {}}};
    found.centreline.points = {{{1, 2, 3}, 0.01, 1}, {{1, 2, 4}, 0.02, 2}};
    found.polyps = {{{1, 1, 1}, 0.007, PolypShape::Flat, 0.5}};
    return found;
}

TEST_F(ColonCacheTest, GivesBackWhatWasKept) {
    const FoundColon found = tube();
    ASSERT_TRUE(writeColonCache(7, found));
    bool damaged = true;
    const auto kept = readColonCache(7, damaged);
    ASSERT_TRUE(kept);
    EXPECT_FALSE(damaged);
    EXPECT_EQ(kept->notes, found.notes);
    EXPECT_EQ(kept->format, found.format);
    EXPECT_TRUE(kept->ofMask);
    EXPECT_EQ(kept->studyFrame.size, found.studyFrame.size);
    EXPECT_EQ(kept->studyFrame.spacing, found.studyFrame.spacing);
    EXPECT_EQ(kept->values.lowest, -1024);
    EXPECT_EQ(kept->values.highest, 1266);
    EXPECT_EQ(kept->lumen.segments.size(), 2u);
    EXPECT_EQ(kept->centreline.points[1].segment, 2);
    EXPECT_EQ(kept->polyps.at(0).shape, PolypShape::Flat);
    const glm::ivec3 size = found.lumen.field.frame.size;
    ASSERT_EQ(kept->lumen.field.frame.size, size);
    int checked = 0;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                ASSERT_EQ(kept->lumen.lumen.at(i, j, k), found.lumen.lumen.at(i, j, k));
                if (i > 12 + kKeptMargin || j > 12 + kKeptMargin || k < 11 - kKeptMargin) continue;
                ++checked;
                ASSERT_EQ(kept->lumen.field.at(i, j, k), found.lumen.field.at(i, j, k)) << i << j << k;
            }
    EXPECT_GT(checked, 10000);
}

TEST_F(ColonCacheTest, FarValuesAreDroppedAsTheCacheDoes) {
    FoundColon found = tube();
    ASSERT_TRUE(writeColonCache(7, found));
    bool damaged = true;
    const auto kept = readColonCache(7, damaged);
    ASSERT_TRUE(kept);
    ASSERT_NE(found.lumen.field.at(36, 36, 49), 0);
    dropFarValues(found.lumen);
    EXPECT_EQ(found.lumen.field.at(36, 36, 49), 0);
    for (std::size_t n = 0; n < found.lumen.field.frame.count(); ++n) {
        ASSERT_EQ(found.lumen.field.values[n], kept->lumen.field.values[n]) << n;
        ASSERT_EQ(found.lumen.lumen.values[n], kept->lumen.lumen.values[n]) << n;
    }
}

TEST_F(ColonCacheTest, NothingKeptIsNotDamage) {
    bool damaged = true;
    EXPECT_FALSE(readColonCache(8, damaged));
    EXPECT_FALSE(damaged);
}

TEST_F(ColonCacheTest, AnyDamageIsSeen) {
    ASSERT_TRUE(writeColonCache(7, tube()));
    const fs::path file = onlyFile();
    const auto size = static_cast<std::streamoff>(fs::file_size(file));
    for (std::streamoff at = 0; at < size; at += at < 64 ? 1 : size / 40 + 1) {
        std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
        stream.seekg(at);
        const char was = static_cast<char>(stream.get());
        stream.seekp(at);
        stream.put(static_cast<char>(was ^ 0x10));
        stream.flush();
        bool damaged = false;
        EXPECT_FALSE(readColonCache(7, damaged)) << at;
        EXPECT_TRUE(damaged) << at;
        stream.seekp(at);
        stream.put(was);
    }
    bool damaged = true;
    EXPECT_TRUE(readColonCache(7, damaged));
    fs::resize_file(file, static_cast<std::uintmax_t>(size) - 5);
    EXPECT_FALSE(readColonCache(7, damaged));
    EXPECT_TRUE(damaged);
}

TEST_F(ColonCacheTest, KeysFollowTheSettings) {
    ColonOptions a, b;
    EXPECT_EQ(colonCacheKey(1, a), colonCacheKey(1, b));
    EXPECT_NE(colonCacheKey(1, a), colonCacheKey(2, a));
    b.segmentation.seeds = {{0, 0, 0.1}};
    EXPECT_NE(colonCacheKey(1, a), colonCacheKey(1, b));
    b = {};
    b.centreline.reversed = true;
    EXPECT_NE(colonCacheKey(1, a), colonCacheKey(1, b));
    b = {};
    b.opacity = 0.5;  // a matter of looks
    EXPECT_EQ(colonCacheKey(1, a), colonCacheKey(1, b));
}

}  // namespace
}  // namespace stereonav
