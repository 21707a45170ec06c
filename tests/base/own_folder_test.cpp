// What is kept is for the user alone, and folders that others could have prepared are not used.
#include "engine/base/own_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <map>
#include <string>

#include "engine/base/cache.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/placed_file.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

template <typename Call>
std::string refusalOf(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

class OwnFolderTest : public testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "stereonav-own-XXXXXX").string();
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        mFolder = pattern;
        for (const char* name : {"XDG_CACHE_HOME", "HOME", "TMPDIR"})
            if (const char* value = std::getenv(name)) mBefore[name] = value;
        setenv("XDG_CACHE_HOME", mFolder.c_str(), 1);
    }
    void TearDown() override {
        for (const char* name : {"XDG_CACHE_HOME", "HOME", "TMPDIR"})
            mBefore.contains(name) ? setenv(name, mBefore[name].c_str(), 1) : unsetenv(name);
        fs::remove_all(mFolder);
    }
    fs::path cache() const { return mFolder / "stereonav"; }
    static fs::perms modeOf(const fs::path& path) { return fs::status(path).permissions(); }

    fs::path mFolder;
    std::map<std::string, std::string> mBefore;
};

TEST_F(OwnFolderTest, IsMadeForTheUserAloneWhateverTheUmask) {
    for (const mode_t mask : {0000, 0022, 0077, 0777}) {
        const mode_t before = umask(mask);
        const std::string refusal = refusalOf([&] { makeOwnFolder(mFolder / "new/folder", "advice"); });
        umask(before);
        EXPECT_EQ(refusal, "") << std::oct << mask;
        EXPECT_EQ(modeOf(mFolder / "new/folder"), fs::perms::owner_all);
        EXPECT_EQ(modeOf(mFolder / "new"), fs::perms::owner_all);
        fs::remove_all(mFolder / "new");
    }
}

TEST_F(OwnFolderTest, RightsOfOthersAreTakenAway) {
    for (const int mode : {0777, 0755, 0770, 0710, 0701}) {
        fs::create_directory(cache());
        ASSERT_EQ(chmod(cache().c_str(), static_cast<mode_t>(mode)), 0);
        EXPECT_EQ(cacheFolder(), cache());
        EXPECT_EQ(modeOf(cache()), fs::perms::owner_all) << std::oct << mode;
        fs::remove(cache());
    }
}

TEST_F(OwnFolderTest, WhatIsKeptIsReadByTheUserAlone) {
    const mode_t before = umask(0);
    writeTextFile(keptFile("a.bin"), "x");
    const PlacedFile placed(keptFile("b.bin"), PlacedFile::For::Writing);
    umask(before);
    for (const char* name : {"a.bin", "b.bin"}) EXPECT_EQ(modeOf(keptFile(name)), fs::perms(0600)) << name;
}

TEST_F(OwnFolderTest, NothingGoesThroughALinkInTheCache) {
    writeTextFile(mFolder / "victim", "as it was");
    fs::create_directory(cache());
    const auto plant = [&] {
        fs::remove(cache() / "a.bin");
        fs::create_symlink(mFolder / "victim", cache() / "a.bin");
    };
    plant();
    EXPECT_FALSE(fs::exists(fs::symlink_status(keptFile("a.bin")))) << "it would be read";
    plant();
    writeTextFile(cache() / "a.bin", "x");
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(cache() / "a.bin")));
    plant();
    for (const auto what : {PlacedFile::For::Writing, PlacedFile::For::GoingOn})
        EXPECT_NE(PlacedFile(cache() / "a.bin", what).error(), 0);
    EXPECT_EQ(readTextFile(mFolder / "victim"), "as it was");
}

// A folder on a larger disk, say.
TEST_F(OwnFolderTest, MayBeALinkOfTheUsers) {
    fs::create_directory(mFolder / "elsewhere");
    ASSERT_EQ(chmod((mFolder / "elsewhere").c_str(), 0755), 0);
    fs::create_directory_symlink(mFolder / "elsewhere", cache());
    writeTextFile(keptFile("a.bin"), "x");
    EXPECT_EQ(readTextFile(mFolder / "elsewhere/a.bin"), "x");
    EXPECT_EQ(modeOf(mFolder / "elsewhere"), fs::perms::owner_all);
}

TEST_F(OwnFolderTest, OfAnotherUserIsRefused) {
    if (geteuid() != 0) GTEST_SKIP() << "only root can make a folder of another user";
    constexpr uid_t kOther = 65534;
    fs::create_directory(cache());
    ASSERT_EQ(chown(cache().c_str(), kOther, kOther), 0);
    const auto refused =
        AllOf(HasSubstr(cache().string()), HasSubstr("of another user"), HasSubstr("XDG_CACHE_HOME"));
    EXPECT_THAT(refusalOf([] { cacheFolder(); }), refused);
    EXPECT_THAT(refusalOf([&] { writeTextFile(cache() / "a.bin", "x"); }), refused);
    EXPECT_TRUE(fs::is_empty(cache()));
    fs::remove(cache());
    fs::create_directory(mFolder / "theirs");
    fs::create_directory_symlink(mFolder / "theirs", cache());
    ASSERT_EQ(lchown(cache().c_str(), kOther, kOther), 0);
    EXPECT_THAT(refusalOf([] { cacheFolder(); }), HasSubstr("link that another user made"));
}

TEST_F(OwnFolderTest, WithoutAHomeItIsTheUsersInTheTemporaryFolder) {
    unsetenv("XDG_CACHE_HOME");
    setenv("TMPDIR", mFolder.c_str(), 1);
    for (const char* home : {"", "relative"}) {
        *home ? setenv("HOME", home, 1) : unsetenv("HOME");
        EXPECT_EQ(cacheFolder(), mFolder / ("stereonav-" + std::to_string(geteuid())));
    }
    writeTextFile(keptFile("a.bin"), "x");
    EXPECT_EQ(modeOf(cacheFolder()), fs::perms::owner_all);
    ASSERT_EQ(chmod(cacheFolder().c_str(), 0777), 0);
    EXPECT_EQ(modeOf(cacheFolder()), fs::perms::owner_all);
    if (geteuid() != 0) GTEST_SKIP() << "only root can make a folder of another user";
    ASSERT_EQ(chown(cachePlace().c_str(), 65534, 65534), 0);
    EXPECT_THAT(refusalOf([] { cacheFolder(); }), HasSubstr("of another user"));
}

}  // namespace
}  // namespace stereonav
