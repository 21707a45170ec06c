// Files are written whole or not at all, and nothing is left beside them.
#include "engine/base/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "engine/base/error.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

class FileTest : public testing::Test {
protected:
    void SetUp() override {
        mFolder = fs::temp_directory_path() / ("stereonav-file-test-" + std::to_string(getpid()));
        fs::remove_all(mFolder);
        fs::create_directories(mFolder);
    }
    void TearDown() override { fs::remove_all(mFolder); }

    fs::path in(const std::string& name) const { return mFolder / name; }
    int entries() const {
        int n = 0;
        for ([[maybe_unused]] const auto& e : fs::recursive_directory_iterator(mFolder)) ++n;
        return n;
    }

private:
    fs::path mFolder;
};

TEST_F(FileTest, WritesAndReadsBytesAsTheyAre) {
    const std::string content("a\r\n\0z\xff", 6);
    writeTextFile(in("a.txt"), content);
    EXPECT_EQ(readTextFile(in("a.txt")), content);
    EXPECT_EQ(entries(), 1) << "the temporary stayed";
}

TEST_F(FileTest, ReplacesWhatWasThere) {
    writeTextFile(in("a.txt"), std::string(1000, 'x'));
    writeTextFile(in("a.txt"), "short");
    EXPECT_EQ(readTextFile(in("a.txt")), "short");
}

TEST_F(FileTest, MakesMissingFolders) {
    writeTextFile(in("one/two/a.txt"), "x");
    EXPECT_EQ(readTextFile(in("one/two/a.txt")), "x");
}

TEST_F(FileTest, TemporaryLiesBesideWithTheSameExtension) {
    fs::path seen;
    writeFileAtomically(in("a.png"), [&](const fs::path& temporary) {
        seen = temporary;
        std::ofstream(temporary) << "x";
        EXPECT_FALSE(fs::exists(in("a.png"))) << "the place itself is written to";
    });
    EXPECT_EQ(seen.parent_path(), in("a.png").parent_path());
    EXPECT_EQ(seen.extension(), ".png");
    EXPECT_NE(seen, in("a.png"));
    EXPECT_FALSE(fs::exists(seen));
}

TEST_F(FileTest, FailureLeavesTheOldFileAndNothingElse) {
    writeTextFile(in("a.txt"), "old");
    const auto failing = [](const fs::path& temporary) {
        std::ofstream(temporary) << "half";
        throw std::logic_error("in the middle");
    };
    EXPECT_THROW(writeFileAtomically(in("a.txt"), failing), std::logic_error);
    EXPECT_EQ(readTextFile(in("a.txt")), "old");
    EXPECT_EQ(entries(), 1);
    EXPECT_THROW(writeFileAtomically(in("new.txt"), failing), std::logic_error);
    EXPECT_EQ(entries(), 1);
}

TEST_F(FileTest, WriterThatWritesNothingIsAnError) {
    EXPECT_THROW(writeFileAtomically(in("a.txt"), [](const fs::path&) {}), Error);
    EXPECT_EQ(entries(), 0);
}

TEST_F(FileTest, PlaceBelowAFileIsRefusedByName) {
    writeTextFile(in("plain"), "x");
    try {
        writeTextFile(in("plain/a.txt"), "y");
        FAIL() << "a file was taken for a folder";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("plain/a.txt"));
        EXPECT_THAT(error.what(), HasSubstr("can not be written"));
    }
    EXPECT_EQ(entries(), 1);
}

TEST_F(FileTest, FolderInThePlaceOfTheFileIsRefused) {
    fs::create_directories(in("a.txt"));
    EXPECT_THROW(writeTextFile(in("a.txt"), "x"), Error);
    EXPECT_TRUE(fs::is_directory(in("a.txt")));
    EXPECT_EQ(entries(), 1);
}

TEST_F(FileTest, ReadingNamesWhatIsMissing) {
    try {
        readTextFile(in("absent.toml"));
        FAIL() << "read a file that is not there";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("absent.toml"));
    }
    EXPECT_THROW(readTextFile(in(".")), Error) << "read a folder";
}

TEST(CacheFolder, FollowsTheEnvironment) {
    const char* before = std::getenv("XDG_CACHE_HOME");
    const std::string kept = before ? before : "";
    setenv("XDG_CACHE_HOME", "/some/where", 1);
    EXPECT_EQ(cacheFolder(), fs::path("/some/where/stereonav"));
    setenv("XDG_CACHE_HOME", "", 1);
    EXPECT_EQ(cacheFolder().filename().string().rfind("stereonav", 0), 0u);
    EXPECT_TRUE(cacheFolder().is_absolute());
    before ? setenv("XDG_CACHE_HOME", kept.c_str(), 1) : unsetenv("XDG_CACHE_HOME");
}

}  // namespace
}  // namespace stereonav
