// Files are written whole or not at all, and nothing is left beside them.
#include "engine/base/file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/files_read.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

template <typename Call>
std::string messageOf(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

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

TEST_F(FileTest, MissingFoldersAreNamedAndNotMade) {
    for (const auto& [name, folder] : {std::pair{"one/a.txt", "one"}, {"one/two/a.txt", "one/two"}}) {
        const std::string message = messageOf([&] { writeTextFile(in(name), "x"); });
        EXPECT_THAT(message, HasSubstr("there is no folder \"" + in(folder).string() + "\""));
        EXPECT_EQ(messageOf([&] { checkPlaceForFile(in(name)); }), message);
    }
    EXPECT_EQ(entries(), 0);
}

TEST_F(FileTest, TheCachesFolderAloneIsMade) {
    const char* before = std::getenv("XDG_CACHE_HOME");
    const std::string kept = before ? before : "";
    setenv("XDG_CACHE_HOME", in("new/cache").c_str(), 1);
    writeTextFile(cacheFolder() / "a.bin", "x");
    EXPECT_EQ(readTextFile(cacheFolder() / "a.bin"), "x");
    EXPECT_EQ(fs::status(cacheFolder()).permissions(), fs::perms::owner_all) << "others can look in";
    EXPECT_THROW(writeTextFile(cacheFolder() / "below/a.bin", "x"), Error);
    setenv("XDG_CACHE_HOME", (cacheFolder() / "a.bin").c_str(), 1);
    EXPECT_THAT(messageOf([&] { writeTextFile(cacheFolder() / "b.bin", "x"); }),
                AllOf(HasSubstr("its folder can not be made"), HasSubstr("XDG_CACHE_HOME")));
    before ? setenv("XDG_CACHE_HOME", kept.c_str(), 1) : unsetenv("XDG_CACHE_HOME");
}

TEST_F(FileTest, KeepsThePermissionsOfWhatItReplaces) {
    writeTextFile(in("a.txt"), "old");
    fs::permissions(in("a.txt"), fs::perms(0640));
    writeTextFile(in("a.txt"), "new");
    EXPECT_EQ(fs::status(in("a.txt")).permissions(), fs::perms(0640));
}

// While one lives new files get what this leaves.
class Umask {
public:
    explicit Umask(mode_t mask) : mBefore(umask(mask)) {}
    ~Umask() { umask(mBefore); }

private:
    mode_t mBefore;
};

TEST_F(FileTest, NewFilesHaveWhatTheUmaskLeaves) {
    for (const auto& [mask, left] : {std::pair{0022, 0644}, {0002, 0664}, {0077, 0600}, {0000, 0666}}) {
        const Umask now(static_cast<mode_t>(mask));
        writeTextFile(in("a.txt"), "new");
        EXPECT_EQ(fs::status(in("a.txt")).permissions(), fs::perms(left)) << std::oct << mask;
        fs::remove(in("a.txt"));
    }
}

TEST_F(FileTest, UntilItIsInItsPlaceNobodyElseReadsIt) {
    const Umask open(0);
    writeTextFile(in("a.txt"), "old");
    for (const int mode : {0600, 0640, 0644, 0666}) {
        fs::permissions(in("a.txt"), fs::perms(mode));
        writeFileAtomically(in("a.txt"), [&](const fs::path& temporary) {
            EXPECT_EQ(fs::status(temporary).permissions(), fs::perms(0600)) << "before it is written";
            std::ofstream(temporary) << "new";
            EXPECT_EQ(fs::status(temporary).permissions(), fs::perms(0600));
        });
        EXPECT_EQ(fs::status(in("a.txt")).permissions(), fs::perms(mode));
    }
}

// Somebody else's link or file at the name that a temporary had until now, which could be foreseen, and at
// any name of one that was seen.
TEST_F(FileTest, NothingGoesThroughWhatWasPlantedForATemporary) {
    writeTextFile(in("victim"), "as it was");
    const std::string process = std::to_string(getpid());
    for (const std::string& name : {".a." + process + ".part.txt", ".a." + process + ".part"})
        fs::create_symlink(in("victim"), in(name));
    std::vector<fs::path> names;
    for (int n = 0; n < 3; ++n)
        writeFileAtomically(in("a.txt"), [&](const fs::path& temporary) {
            names.push_back(temporary);
            EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(temporary)));
            std::ofstream(temporary) << "new";
        });
    for (const fs::path& name : names) fs::create_symlink(in("victim"), name);
    writeTextFile(in("a.txt"), "newer");
    checkPlaceForFile(in("a.txt"));
    EXPECT_EQ(readTextFile(in("a.txt")), "newer");
    EXPECT_EQ(readTextFile(in("victim")), "as it was");
    EXPECT_NE(names[0], names[1]) << "it can be foreseen";
    EXPECT_EQ(entries(), 2 + 2 + 3) << "what is planted stays, and nothing else does";
}

TEST_F(FileTest, TwoOfOnePlaceDoNotMeet) {
    PendingFile first(in("a.txt")), second(in("a.txt"));
    EXPECT_NE(first.temporary(), second.temporary());
    std::ofstream(first.temporary()) << "first";
    std::ofstream(second.temporary()) << "second";
    first.finish();
    second.finish();
    EXPECT_EQ(readTextFile(in("a.txt")), "second");
}

TEST_F(FileTest, ATemporaryThatBecameALinkIsNotPutIntoItsPlace) {
    writeTextFile(in("victim"), "as it was");
    EXPECT_THROW(writeFileAtomically(in("a.txt"),
                                     [&](const fs::path& temporary) {
                                         fs::remove(temporary);
                                         fs::create_symlink(in("victim"), temporary);
                                     }),
                 Error);
    EXPECT_FALSE(fs::exists(fs::symlink_status(in("a.txt"))));
    EXPECT_EQ(readTextFile(in("victim")), "as it was");
}

// What the program keeps for itself: a planted link in its place is replaced, not followed.
TEST_F(FileTest, ForTheUserAloneALinkIsReplaced) {
    const Umask open(0);
    writeTextFile(in("victim"), "as it was");
    fs::create_directory(in("folder"));
    for (const char* to : {"victim", "folder", "nowhere"}) {
        fs::create_symlink(in(to), in("a.txt"));
        PendingFile file(in("a.txt"), Over::Anything, Readers::UserAlone);
        std::ofstream(file.temporary()) << "kept";
        file.finish();
        EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(in("a.txt")))) << to;
        EXPECT_EQ(fs::status(in("a.txt")).permissions(), fs::perms(0600));
        fs::remove(in("a.txt"));
    }
    writeTextFile(in("a.txt"), "of before");
    PendingFile file(in("a.txt"), Over::Anything, Readers::UserAlone);
    std::ofstream(file.temporary()) << "kept";
    file.finish();
    EXPECT_EQ(fs::status(in("a.txt")).permissions(), fs::perms(0600)) << "the mode of before stayed";
    EXPECT_EQ(readTextFile(in("victim")), "as it was");
}

TEST_F(FileTest, LinksAreWrittenThrough) {
    fs::create_directories(in("far"));
    writeTextFile(in("far/a.txt"), "old");
    fs::create_symlink("far/a.txt", in("one.txt"));
    fs::create_symlink(in("one.txt"), in("two.txt"));
    fs::create_symlink("far/none.txt", in("new.txt"));
    writeTextFile(in("two.txt"), "through two");
    writeTextFile(in("new.txt"), "through one to nothing");
    for (const char* link : {"one.txt", "two.txt", "new.txt"}) EXPECT_TRUE(fs::is_symlink(in(link))) << link;
    EXPECT_EQ(readTextFile(in("far/a.txt")), "through two");
    EXPECT_EQ(readTextFile(in("far/none.txt")), "through one to nothing");
    writeFileAtomically(in("one.txt"), [&](const fs::path& temporary) {
        EXPECT_EQ(temporary.parent_path(), in("far")) << "not beside the target";
        std::ofstream(temporary) << "by a writer";
    });
    EXPECT_EQ(readTextFile(in("far/a.txt")), "by a writer");
    EXPECT_EQ(entries(), 6);
}

TEST_F(FileTest, LinksThatLeadNowhereAreNamed) {
    fs::create_symlink("b", in("a"));
    fs::create_symlink("a", in("b"));
    fs::create_symlink("none/file", in("c"));
    EXPECT_THAT(messageOf([&] { writeTextFile(in("a"), "x"); }), HasSubstr("leads nowhere"));
    EXPECT_THAT(messageOf([&] { writeTextFile(in("c"), "x"); }), HasSubstr("there is no folder"));
    EXPECT_EQ(entries(), 3);
}

TEST_F(FileTest, PipesAreWrittenInto) {
    ASSERT_EQ(mkfifo(in("pipe.txt").c_str(), 0600), 0);
    EXPECT_NO_THROW(checkPlaceForFile(in("pipe.txt")));
    for (const bool whole : {true, false}) {
        std::string read;
        std::thread reader([&] { std::getline(std::ifstream(in("pipe.txt")), read, '\0'); });
        if (whole)
            writeTextFile(in("pipe.txt"), "a line");
        else
            writeFileAtomically(in("pipe.txt"), [&](const fs::path& temporary) {
                EXPECT_EQ(temporary.extension(), ".txt");
                std::ofstream(temporary) << "a line";
            });
        reader.join();
        EXPECT_EQ(read, "a line");
        EXPECT_TRUE(fs::is_fifo(in("pipe.txt")));
    }
    EXPECT_EQ(entries(), 1);
}

// Nothing may ever come out of them.
TEST_F(FileTest, PipesAndDevicesAreNotRead) {
    ASSERT_EQ(mkfifo(in("pipe").c_str(), 0600), 0);
    EXPECT_THAT(messageOf([&] { readTextFile(in("pipe")); }), HasSubstr("expected a file, found a pipe"));
    EXPECT_THAT(messageOf([&] { readTextFile("/dev/zero"); }), HasSubstr("expected a file, found a device"));
    EXPECT_THAT(messageOf([&] { checkFileToRead(in("")); }), HasSubstr("expected a file, found a folder"));
    EXPECT_NO_THROW(checkFileToRead(in("not there")));
}

TEST_F(FileTest, WhatWasReadIsNotReplaced) {
    writeTextFile(in("a.txt"), "old");
    fs::create_hard_link(in("a.txt"), in("b.txt"));
    fs::create_symlink(in("a.txt"), in("link.txt"));
    const int file = open(in("a.txt").c_str(), O_RDONLY);
    noteFileRead(file);
    close(file);
    for (const char* name : {"a.txt", "b.txt", "link.txt"}) {
        const fs::path place = in(name);
        EXPECT_THAT(messageOf([&] { writeTextFile(place, "new"); }), HasSubstr("is read in this run"));
        EXPECT_EQ(readTextFile(place), "old");
    }
    EXPECT_EQ(entries(), 3);
    writeTextFile(in("c.txt"), "new");  // next to it
    const auto write = [](const fs::path& temporary) { std::ofstream(temporary) << "new"; };
    writeFileAtomically(in("a.txt"), write, Over::Anything);
    EXPECT_EQ(readTextFile(in("a.txt")), "new");
    writeTextFile(in("a.txt"), "newer");  // which is another file now
    EXPECT_EQ(readTextFile(in("b.txt")), "old");
}

// It began to be read while it was made: seen at the end.
TEST_F(FileTest, WhatIsReadMeanwhileIsNotReplaced) {
    writeTextFile(in("a.txt"), "old");
    const auto write = [&](const fs::path& temporary) {
        std::ofstream(temporary) << "new";
        const int file = open(in("a.txt").c_str(), O_RDONLY);
        noteFileRead(file);
        close(file);
    };
    EXPECT_THAT(messageOf([&] { writeFileAtomically(in("a.txt"), write); }), HasSubstr("would be lost"));
    EXPECT_EQ(readTextFile(in("a.txt")), "old");
    EXPECT_EQ(entries(), 1);
}

TEST_F(FileTest, LongNamesAreWritten) {
    const std::string name = std::string(250, 'a') + ".txt";
    writeTextFile(in(name), "x");
    EXPECT_EQ(readTextFile(in(name)), "x");
}

// Also for the superuser, who could replace it by a file.
TEST_F(FileTest, AFullDeviceIsAnErrorAndStays) {
    fs::create_symlink("/dev/full", in("link"));
    for (const fs::path& place : {fs::path("/dev/full"), in("link")}) {
        EXPECT_THAT(messageOf([&] { writeTextFile(place, "x"); }), HasSubstr("No space left"));
        const auto writer = [](const fs::path& temporary) { std::ofstream(temporary) << "x"; };
        EXPECT_THAT(messageOf([&] { writeFileAtomically(place, writer); }), HasSubstr("No space left"));
    }
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
    EXPECT_TRUE(fs::is_symlink(in("link")));
    EXPECT_NO_THROW(writeTextFile("/dev/null", "x"));
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

// What a full disk does to a file that is written in one go or by a writer of its own: a limit stands for it.
TEST_F(FileTest, AFullDiskLeavesTheOldFile) {
    writeTextFile(in("a.txt"), "old");
    const pid_t child = fork();
    if (child == 0) {
        signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{1000, 1000};
        setrlimit(RLIMIT_FSIZE, &limit);
        const std::string message = messageOf([&] { writeTextFile(in("a.txt"), std::string(5000, 'x')); });
        _exit(message.find("a.txt: can not be written: File too large") != std::string::npos ? 0 : 1);
    }
    int status = 1;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(readTextFile(in("a.txt")), "old");
    EXPECT_EQ(entries(), 1);
}

TEST(StandardOutput, HasSeveralNames) {
    for (const char* name : {"-", "/dev/stdout", "/dev/fd/1"}) EXPECT_TRUE(isStandardOutput(name)) << name;
    for (const char* name : {"", "./-", "--", "a-", "/dev/stderr"})
        EXPECT_FALSE(isStandardOutput(name)) << name;
    testing::internal::CaptureStdout();
    std::printf("before ");
    writeTextFile("-", "a line");
    writeFileAtomically("-", [](const fs::path& temporary) { std::ofstream(temporary) << ", another"; });
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "before a line, another");
    EXPECT_FALSE(fs::exists("-"));
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
    for (const char* none : {"", "some/where"}) {
        setenv("XDG_CACHE_HOME", none, 1);
        EXPECT_EQ(cacheFolder().filename().string().rfind("stereonav", 0), 0u);
        EXPECT_TRUE(cacheFolder().is_absolute());
    }
    before ? setenv("XDG_CACHE_HOME", kept.c_str(), 1) : unsetenv("XDG_CACHE_HOME");
}

}  // namespace
}  // namespace stereonav
