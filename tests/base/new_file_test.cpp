// New files: nothing that is there is written over.
#include "engine/base/new_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <set>

#include "tests/camera/temporary_folder.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

class NewFile : public testing::Test {
protected:
    void put(const std::string& name, const std::string& text = "kept") const {
        std::ofstream(mFolder / name) << text;
    }
    std::string freeName(const std::string& name) const {
        return freePlace(mFolder / name).filename().string();
    }
    std::set<std::string> names() const {
        std::set<std::string> all;
        for (const auto& entry : fs::directory_iterator(mFolder / ""))
            all.insert(entry.path().filename().string());
        return all;
    }

    TemporaryFolder mFolder;
};

TEST_F(NewFile, HasItsNameOrTheFirstFreeNumber) {
    EXPECT_EQ(freeName("a.mp4"), "a.mp4");
    put("a.mp4");
    EXPECT_EQ(freeName("a.mp4"), "a_0002.mp4");
    put("a_0002.mp4");
    put("a_0004.mp4");
    EXPECT_EQ(freeName("a.mp4"), "a_0003.mp4");
    fs::create_directory(mFolder / "pictures");
    EXPECT_EQ(freeName("pictures"), "pictures_0002");
    fs::create_symlink("nowhere", mFolder / "link.png");
    EXPECT_EQ(freeName("link.png"), "link_0002.png") << "a link is something, wherever it leads";
    EXPECT_EQ(freeName("none/a.png"), "a.png");
    EXPECT_EQ(freePlace("/dev/null"), "/dev/null") << "it is written into";
}

TEST_F(NewFile, AHeldPlaceIsNobodyElses) {
    put("a.mp4");
    {
        const HeldPlace first(mFolder / "a.mp4", HeldPlace::Kind::File),
            second(mFolder / "a.mp4", HeldPlace::Kind::File);
        EXPECT_EQ(first.path(), mFolder / "a_0002.mp4");
        EXPECT_EQ(second.path(), mFolder / "a_0003.mp4");
        EXPECT_EQ(freeName("a.mp4"), "a_0004.mp4");
        std::ofstream(second.path()) << "a movie";
    }
    EXPECT_EQ(names(), (std::set<std::string>{"a.mp4", "a_0003.mp4"})) << "what was written stays";
    EXPECT_EQ(fs::file_size(mFolder / "a.mp4"), 4u);
}

TEST_F(NewFile, AHeldFolderIsNobodyElses) {
    fs::create_directory(mFolder / "empty");
    fs::create_directory(mFolder / "full");
    put("full/1.png");
    {
        const HeldPlace empty(mFolder / "empty", HeldPlace::Kind::Folder),
            full(mFolder / "full", HeldPlace::Kind::Folder), fresh(mFolder / "new", HeldPlace::Kind::Folder),
            left(mFolder / "left", HeldPlace::Kind::Folder);
        EXPECT_EQ(empty.path(), mFolder / "empty");
        EXPECT_EQ(full.path(), mFolder / "full_0002");
        EXPECT_EQ(HeldPlace(mFolder / "full", HeldPlace::Kind::Folder).path(), mFolder / "full_0003");
        EXPECT_TRUE(fs::is_directory(fresh.path()));
        put("new/1.png");
    }
    EXPECT_EQ(names(), (std::set<std::string>{"empty", "full", "new"}));
}

// The writer says what is wrong, and nothing is left.
TEST_F(NewFile, NothingIsHeldWhereNothingCanBe) {
    const HeldPlace none(mFolder / "none/a.mp4", HeldPlace::Kind::File),
        folder(mFolder / "none/a", HeldPlace::Kind::Folder);
    EXPECT_EQ(none.path(), mFolder / "none/a.mp4");
    EXPECT_EQ(folder.path(), mFolder / "none/a");
    EXPECT_EQ(HeldPlace("/dev/null", HeldPlace::Kind::File).path(), "/dev/null");
    ASSERT_EQ(mkfifo((mFolder / "pipe").c_str(), 0600), 0);
    EXPECT_EQ(HeldPlace(mFolder / "pipe", HeldPlace::Kind::File).path(), mFolder / "pipe");
    EXPECT_EQ(names(), std::set<std::string>{"pipe"});
}

}  // namespace
}  // namespace stereonav
