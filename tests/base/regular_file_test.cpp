// Files that are read are regular ones, and those that other files name lie beside them.
#include "engine/base/regular_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

#include "engine/base/error.h"
#include "engine/base/named_file.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/error_of.h"

namespace stereonav {
namespace {

using testing::HasSubstr;

TEST(RegularFile, GivesItsBytes) {
    const TemporaryFolder folder;
    std::ofstream(folder / "a") << "0123456789";
    std::filesystem::create_symlink("a", folder / "link");
    for (const char* name : {"a", "link"}) {
        RegularFile file(folder / name);
        EXPECT_EQ(file.size(), 10u);
        char bytes[20] = {};
        EXPECT_EQ(file.read(bytes, 4), 4u);
        EXPECT_EQ(file.read(bytes + 4, 16), 6u);
        EXPECT_STREQ(bytes, "0123456789");
        file.seek(7);
        EXPECT_EQ(file.read(bytes, 20), 3u);
        EXPECT_EQ(file.read(bytes, 20), 0u);
        EXPECT_EQ(firstBytes(folder / name, 3), "012");
        EXPECT_EQ(firstBytes(folder / name, 30), "0123456789");
    }
}

// Nobody writes into the pipe: who waited for it would wait for ever.
TEST(RegularFile, AnythingElseIsRefusedAtOnce) {
    const TemporaryFolder folder;
    const auto refused = [](const std::filesystem::path& file) {
        return test::errorOf([&] { RegularFile opened(file); });
    };
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    std::filesystem::create_symlink("pipe", folder / "link");
    std::filesystem::create_directory(folder / "folder");
    const int plug = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_un place{};
    place.sun_family = AF_UNIX;
    ASSERT_LT((folder / "socket").string().size(), sizeof place.sun_path);
    std::strcpy(place.sun_path, (folder / "socket").c_str());
    ASSERT_EQ(bind(plug, reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
    EXPECT_THAT(refused(folder / "pipe"), HasSubstr("pipe: expected a file, found a pipe; copy"));
    EXPECT_THAT(refused(folder / "link"), HasSubstr("link: expected a file, found a pipe; copy"));
    EXPECT_THAT(refused(folder / "folder"), HasSubstr("folder: expected a file, found a folder; name"));
    EXPECT_THAT(refused(folder / "socket"), HasSubstr("socket: expected a file, found a socket"));
    EXPECT_THAT(refused("/dev/null"), HasSubstr("/dev/null: expected a file, found a device"));
    EXPECT_THAT(refused(folder / "none"), HasSubstr("none: can not be opened; check the name"));
    close(plug);
}

TEST(NamedFile, LiesInTheFolderOrBelow) {
    using namespace std::string_literals;
    const auto named = [](const std::string& name) { return fileNamedBy("/data/study/a.nhdr", name); };
    EXPECT_EQ(named("b.raw"), "/data/study/b.raw");
    EXPECT_EQ(named("./raw/b.raw"), "/data/study/raw/b.raw");
    EXPECT_EQ(named("raw//c/../b.raw"), "/data/study/raw/b.raw");
    EXPECT_EQ(named("..b"), "/data/study/..b");
    EXPECT_EQ(named("a b%2f..\\c"), "/data/study/a b%2f..\\c");
    // Out of it and back.
    EXPECT_EQ(named("/data/study/raw/b.raw"), "/data/study/raw/b.raw");
    EXPECT_EQ(named("../study/b.raw"), "/data/study/b.raw");
    EXPECT_EQ(named("b.raw\0/../../c"s), "/data/study/b.raw") << "as the system reads it";
    EXPECT_EQ(fileNamedBy("a.nhdr", "b.raw"), "b.raw");
    EXPECT_EQ(fileNamedBy("a.nhdr", (std::filesystem::current_path() / "b.raw").string()), "b.raw");
    EXPECT_EQ(fileNamedBy("../a.nhdr", "raw/b.raw"), "../raw/b.raw");
    EXPECT_EQ(fileNamedBy("/a.nhdr", "b.raw"), "/b.raw");
}

TEST(NamedFile, NothingElsewhereIsNamed) {
    using namespace std::string_literals;
    for (const std::string& name :
         {"/etc/passwd"s, "//etc/passwd"s, "/data/study2/b.raw"s, "/data/study/../b.raw"s, "../b.raw"s, ".."s,
          "."s, "/data/study"s, "raw/../../b.raw"s, "./../other/b.raw"s, "../study2/b.raw"s,
          "raw/.././../b.raw"s, ""s, "../b.raw\0/../study/c"s, "\0b.raw"s})
        EXPECT_EQ(fileNamedBy("/data/study/a.nhdr", name), std::nullopt) << name;
    EXPECT_EQ(fileNamedBy("a.nhdr", "../b.raw"), std::nullopt);
}

}  // namespace
}  // namespace stereonav
