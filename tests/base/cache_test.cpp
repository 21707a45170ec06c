// What is kept unasked never stops the work, and takes no more room than is said.
#include "engine/base/cache.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <iterator>
#include <string>
#include <vector>

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
    // Adds a file of `bytes` bytes, last used `hours` hours ago.
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

TEST_F(CacheTest, TilesCountInTheLimit) {
    EXPECT_TRUE(keepFor("ground_1.tiles", 600, 3));
    EXPECT_TRUE(keepFor("a.bin", 300, 2, 1000));
    EXPECT_TRUE(there("ground_1.tiles"));
    EXPECT_TRUE(keepFor("b.bin", 300, 0, 1000));
    EXPECT_FALSE(there("ground_1.tiles"));
    EXPECT_TRUE(there("a.bin"));
}

TEST_F(CacheTest, KnowsWhatAFileWasMadeOf) {
    writeTextFile(mFolder / "study.nrrd", "x");
    fs::create_symlink(mFolder / "study.nrrd", mFolder / "link.nrrd");
    EXPECT_TRUE(keepFor("a.bin", 300, 1));
    EXPECT_TRUE(keepFor("b.bin", 300, 2));
    noteSource(keptFile("a.bin"), mFolder / "link.nrrd");
    noteSource(keptFile("gone.bin"), mFolder / "study.nrrd");
    noteSource(mFolder / "study.nrrd", mFolder / "study.nrrd");
    EXPECT_FALSE(fs::exists(mFolder / "study.nrrd.of")) << "it is written beside what is no kept file";
    const std::vector<Kept> all = allKept(cacheFolder());
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0].file, keptFile("a.bin"));
    EXPECT_EQ(all[0].source, fs::canonical(mFolder / "study.nrrd"));
    EXPECT_EQ(all[0].bytes, 300u);
    EXPECT_EQ(all[1].source, "");
    EXPECT_TRUE(removeKept(keptFile("a.bin")));
    EXPECT_EQ(std::distance(fs::directory_iterator(cacheFolder()), fs::directory_iterator()), 1);
}

// A folder that others could write to may hold files of theirs when it becomes the user's alone.
TEST_F(CacheTest, FilesOfAnotherUserAreNotBelieved) {
    if (geteuid() != 0) GTEST_SKIP() << "only root can give files to another user";
    constexpr uid_t kOther = 65534;
    writeTextFile(mFolder / "study.nrrd", "x");
    EXPECT_TRUE(keepFor("a.bin", 300, 1));
    noteSource(keptFile("a.bin"), mFolder / "study.nrrd");
    ASSERT_EQ(allKept(cacheFolder()).at(0).source, fs::canonical(mFolder / "study.nrrd"));
    ASSERT_EQ(chown((keptFile("a.bin").string() + ".of").c_str(), kOther, kOther), 0);
    EXPECT_EQ(allKept(cacheFolder()).at(0).source, "");
    const fs::path kept = keptFile("a.bin");
    ASSERT_EQ(chown(kept.c_str(), kOther, kOther), 0);
    EXPECT_FALSE(fs::exists(keptFile("a.bin"))) << "it is made anew";
}

// Temporaries of a process that is gone, by their names of today and of older programs; what is being written
// stays.
TEST_F(CacheTest, WhatCrashedRunsLeftGoes) {
    EXPECT_TRUE(keepFor("a.bin", 300, 1));
    const pid_t child = fork();
    if (child == 0) _exit(0);
    ASSERT_EQ(waitpid(child, nullptr, 0), child);
    const std::string gone = std::to_string(child), here = std::to_string(getpid());
    const std::string stay[] = {"." + here + ".part.bin",
                                ".a." + here + ".part.bin",
                                ".a." + here + ".0Zz9aB.part.bin",
                                ".a." + here + ".123456.part.bin",
                                ".a.part.bin",
                                "a." + gone + ".part.bin"};
    const std::string go[] = {".a." + gone + ".part.bin", ".a." + gone + ".0Zz9aB.part.bin",
                              ".a.part." + gone + ".0Zz9aB.part.tiles"};
    for (const auto& name : stay) writeTextFile(keptFile(name), "half");
    for (const auto& name : go) writeTextFile(keptFile(name), "half");
    EXPECT_EQ(removeLeftovers(cacheFolder()), 3);
    for (const auto& name : stay) EXPECT_TRUE(there(name)) << name;
    for (const auto& name : go) EXPECT_FALSE(there(name)) << name;
    writeTextFile(keptFile(go[0]), "half");
    EXPECT_TRUE(keepFor("b.bin", 300, 1));
    EXPECT_FALSE(there(go[0])) << "it would stay until somebody asks";
}

TEST_F(CacheTest, AFolderThatCanNotBeWrittenIsNoError) {
    writeTextFile(mFolder / "stereonav", "a file where the folder should be");
    EXPECT_FALSE(keepFor("a.bin", 10, 0));
    noteUse(keptFile("a.bin"));
}

}  // namespace
}  // namespace stereonav
