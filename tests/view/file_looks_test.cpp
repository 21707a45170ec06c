// Descriptions of files are read beside the window: the last wish goes first, and what is known stays known.
#include "app/view/file_looks.h"

#include <gmock/gmock.h>

#include <atomic>
#include <fstream>

#include "engine/base/error.h"
#include "tests/support/gate.h"
#include "tests/support/wait_for.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

class FileLooksTest : public testing::Test {
protected:
    void SetUp() override {
        mFolder = fs::path(testing::TempDir()) / ("stereonav_looks_" + std::to_string(getpid()));
        fs::create_directories(mFolder);
        for (const char* name : {"a", "b", "bad"}) write(name, name);
    }
    void TearDown() override { fs::remove_all(mFolder); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(mFolder / name) << text;
    }
    FileLook await(FileLooks& looks, const std::string& name) const {
        FileLook look;
        EXPECT_TRUE(test::waitFor([&] {
            look = looks.look(mFolder / name);
            return !look.busy;
        })) << "no look at "
            << name;
        return look;
    }
    fs::path mFolder;
    std::atomic<int> mLooked = 0, mReady = 0;
};

TEST_F(FileLooksTest, TellsOnceAndKeepsIt) {
    FileLooks looks([this] { ++mReady; },
                    [this](const std::string& file, Progress&) {
                        ++mLooked;
                        if (file.ends_with("bad")) throw Error(file, "", "is broken", "mend it");
                        return Facts{factForText("kind", fs::path(file).filename().string())};
                    });
    EXPECT_TRUE(looks.look(mFolder / "a").busy);
    const FileLook a = await(looks, "a");
    ASSERT_EQ(a.rows.size(), 1u);
    EXPECT_EQ(a.rows[0].second, "a");
    const FileLook bad = await(looks, "bad");
    EXPECT_TRUE(bad.rows.empty());
    EXPECT_THAT(bad.problem, testing::HasSubstr("is broken"));
    EXPECT_EQ(bad.problem.find('\n'), std::string::npos);
    await(looks, "a");
    EXPECT_EQ(mLooked, 2) << "a is known";
    EXPECT_GE(mReady, 1);
    write("a", "longer");
    await(looks, "a");
    EXPECT_EQ(mLooked, 3) << "it was changed";
}

TEST_F(FileLooksTest, AnotherWishEndsTheOneBefore) {
    std::atomic<bool> ended = false;
    FileLooks looks([] {},
                    [&](const std::string& file, Progress& progress) {
                        ++mLooked;
                        try {
                            if (file.ends_with("a"))  // takes for ever
                                test::waitFor([&] { return progress.report(0, ""), false; });
                        } catch (const Cancelled&) {
                            ended = true;
                            throw;
                        }
                        return Facts{factForText("kind", "b")};
                    });
    looks.look(mFolder / "a");
    ASSERT_TRUE(test::waitFor([&] { return mLooked > 0; }));
    const FileLook b = await(looks, "b");
    EXPECT_TRUE(ended);
    EXPECT_EQ(b.rows.size(), 1u);
    EXPECT_TRUE(looks.look(mFolder / "a").busy) << "it is not known";
}  // and it ends while a is looked at

// A file that is changed while it is read: that description is of the file before.
TEST_F(FileLooksTest, AFileThatChangesMeanwhileIsLookedAtAgain) {
    test::Gate gate;
    std::atomic<int> number = 0;
    FileLooks looks([] {},
                    [&](const std::string&, Progress&) {
                        const int mine = ++number;
                        gate.pass();
                        return Facts{factForText("kind", std::to_string(mine))};
                    });
    looks.look(mFolder / "a");
    gate.await();
    write("a", "longer than before");
    EXPECT_TRUE(looks.look(mFolder / "a").busy);
    gate.open();
    const FileLook now = await(looks, "a");
    ASSERT_EQ(now.rows.size(), 1u);
    EXPECT_EQ(now.rows[0].second, "2");
}

// a, b, a: the description of a belongs to a, and what was known stays known.
TEST_F(FileLooksTest, ThereAndBackTellsTheSame) {
    test::Gate gate;
    FileLooks looks([] {},
                    [&](const std::string& file, Progress& progress) {
                        ++mLooked;
                        gate.pass();
                        progress.report(0, "");
                        return Facts{factForText("kind", fs::path(file).filename().string())};
                    });
    looks.look(mFolder / "a");
    gate.await();
    EXPECT_TRUE(looks.look(mFolder / "b").busy);
    EXPECT_TRUE(looks.look(mFolder / "a").busy);
    gate.open();
    const FileLook a = await(looks, "a");
    ASSERT_EQ(a.rows.size(), 1u);
    EXPECT_EQ(a.rows[0].second, "a");
    const int looked = mLooked;
    EXPECT_EQ(await(looks, "b").rows.at(0).second, "b");
    EXPECT_EQ(await(looks, "a").rows.at(0).second, "a");
    EXPECT_EQ(mLooked, looked + 1) << "a is known";
}

}  // namespace
}  // namespace stereonav
