// What is kept unasked never stops the work, and takes no more room than is said.
#include "engine/base/cache.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <string>

#include "engine/base/error.h"
#include "engine/base/file.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

class CacheTest : public testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "stereonav-cache-XXXXXX").string();
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        mFolder = pattern;
        if (const char* before = std::getenv("XDG_CACHE_HOME")) mBefore = before;
        setenv("XDG_CACHE_HOME", mFolder.c_str(), 1);
    }
    void TearDown() override {
        mBefore.empty() ? unsetenv("XDG_CACHE_HOME") : setenv("XDG_CACHE_HOME", mBefore.c_str(), 1);
        fs::remove_all(mFolder);
    }
    // Of so many bytes, last used so many hours ago.
    static bool keepFor(const std::string& name, std::size_t bytes, int hours,
                        std::uintmax_t most = kMostKept) {
        const auto write = [&](const fs::path& file) { writeTextFile(file, std::string(bytes, 'x')); };
        const bool kept = keep(keptFile(name), write, most);
        if (kept)
            fs::last_write_time(keptFile(name), fs::file_time_type::clock::now() - std::chrono::hours(hours));
        return kept;
    }
    static bool there(const std::string& name) { return fs::exists(keptFile(name)); }

    fs::path mFolder;
    std::string mBefore;
};

TEST_F(CacheTest, KeepsWhatIsWritten) {
    EXPECT_TRUE(keepFor("a.bin", 10, 0));
    EXPECT_EQ(readTextFile(keptFile("a.bin")), std::string(10, 'x'));
}

TEST_F(CacheTest, TheLeastRecentlyUsedMakeRoom) {
    EXPECT_TRUE(keepFor("old.bin", 300, 3));
    EXPECT_TRUE(keepFor("older.nrrd", 300, 4));
    EXPECT_TRUE(keepFor("newer.bin", 300, 2));
    noteUse(keptFile("older.nrrd"));
    EXPECT_TRUE(keepFor("now.bin", 300, 0, 1000));
    EXPECT_FALSE(there("old.bin"));
    for (const char* name : {"older.nrrd", "newer.bin", "now.bin"}) EXPECT_TRUE(there(name)) << name;
    EXPECT_TRUE(keepFor("large.bin", 5000, 0, 1000)) << "what was just made stays, whatever its size";
    EXPECT_TRUE(there("large.bin"));
    EXPECT_FALSE(there("now.bin"));
}

TEST_F(CacheTest, WhatWasBakedStays) {
    EXPECT_TRUE(keepFor("a.bin", 10, 0));
    writeTextFile(cacheFolder() / "light.bake", std::string(5000, 'x'));
    writeTextFile(cacheFolder() / "terrain.light", std::string(5000, 'x'));
    EXPECT_TRUE(keepFor("b.bin", 10, 0, 100));
    for (const char* name : {"a.bin", "b.bin", "light.bake", "terrain.light"})
        EXPECT_TRUE(there(name)) << name;
}

TEST_F(CacheTest, AFolderThatCanNotBeWrittenIsNoError) {
    writeTextFile(mFolder / "stereonav", "a file where the folder should be");
    EXPECT_FALSE(keepFor("a.bin", 10, 0));
    noteUse(keptFile("a.bin"));
}

}  // namespace
}  // namespace stereonav
