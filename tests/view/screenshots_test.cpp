// Pictures that are saved beside the window: of the request at that time, one for each wish, and with one
// line where they can not be saved.
#include "app/view/screenshots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "engine/image/image_file.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/gate.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

// Returns a frame of one grey for each number.
std::shared_ptr<const ViewFrame> frameOf(long long version, float grey, bool twoEyes = true) {
    auto frame = std::make_shared<ViewFrame>();
    frame->request.version = version;
    frame->left.resize(8, 6);
    if (twoEyes) frame->right.resize(8, 6);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 8; ++x) {
            frame->left.color.at(x, y) = packColor(glm::vec3(grey));
            if (twoEyes) frame->right.color.at(x, y) = packColor(glm::vec3(grey / 2));
        }
    return frame;
}

class ScreenshotsTest : public testing::Test {
protected:
    ScreenshotsTest() { fs::create_directory(mFolder / "shots"); }
    std::vector<fs::path> files() const {
        std::vector<fs::path> all;
        for (const auto& entry : fs::directory_iterator(mFolder / "shots"))
            if (entry.path().filename().string().starts_with("stereonav_")) all.push_back(entry.path());
        std::sort(all.begin(), all.end());
        return all;
    }
    std::string reported() {
        std::string text;
        EXPECT_TRUE(test::waitFor([&] {
            if (const std::string now = mShots.report(); !now.empty()) text = now;
            return !mShots.waiting();
        }));
        return text;
    }
    // Returns the grey of a picture's pixel, 0 to 1.
    static float greyAt(const fs::path& file, int x) {
        const LinearImage picture = readLinearImage(file);
        return picture.pixels.at(static_cast<std::size_t>(2 * picture.width + x)).x;
    }

    TemporaryFolder mFolder;
    ComposeSetting mSideBySide{OutputMode::SideBySide, false, false};
    Screenshots mShots{mFolder / "shots"};
};

TEST_F(ScreenshotsTest, WaitForThePictureThatWasAskedFor) {
    mShots.wish(5);
    EXPECT_TRUE(mShots.waiting());
    mShots.take(nullptr, mSideBySide);
    mShots.take(frameOf(4, 0.9f), mSideBySide);
    EXPECT_TRUE(files().empty()) << "that one was asked for before";
    mShots.take(frameOf(5, 0.5f), mSideBySide);
    mShots.take(frameOf(6, 0.1f), mSideBySide);
    EXPECT_THAT(reported(), testing::HasSubstr("saved "));
    ASSERT_EQ(files().size(), 1u) << "once";
    EXPECT_NEAR(greyAt(files()[0], 2), 0.5, 0.01);
    EXPECT_NEAR(greyAt(files()[0], 12), 0.25, 0.01) << "the right eye beside it";
    EXPECT_EQ(mShots.report(), "");
}

TEST_F(ScreenshotsTest, EachWishHasAFileOfItsOwn) {
    std::ofstream(mFolder / "shots/stereonav_0002_sbsl.png") << "somebody else's";
    mShots.wish(1);
    mShots.wish(1);
    mShots.wish(3);
    mShots.take(frameOf(2, 0.5f), mSideBySide);
    ASSERT_TRUE(test::waitFor([&] { return files().size() == 3; }));
    EXPECT_TRUE(mShots.waiting()) << "for the third";
    mShots.take(frameOf(3, 0.25f, false), mSideBySide);
    reported();
    ASSERT_EQ(files().size(), 4u);
    EXPECT_EQ(fs::file_size(files()[1]), 15u) << "is left as it was";
    EXPECT_NEAR(greyAt(files()[0], 2), 0.5, 0.01);
    EXPECT_NEAR(greyAt(files()[2], 2), 0.5, 0.01);
    EXPECT_NEAR(greyAt(files()[3], 12), 0.25, 0.01) << "one eye is shown to both";
}

TEST_F(ScreenshotsTest, APictureThatIsThereIsTakenAtOnce) {
    mShots.wish(7);
    Plane<PackedColor> slice(8, 6);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 8; ++x) slice.at(x, y) = packColor(glm::vec3(0.75f));
    mShots.take(slice, mSideBySide);
    slice = Plane<PackedColor>(8, 6);  // drawn again meanwhile
    mShots.take(frameOf(9, 0.1f), mSideBySide);
    reported();
    ASSERT_EQ(files().size(), 1u);
    EXPECT_NEAR(greyAt(files()[0], 12), 0.75, 0.01);
}

TEST_F(ScreenshotsTest, WhatCanNotBeSavedIsTold) {
    fs::remove_all(mFolder / "shots");
    mShots.wish(1);
    mShots.take(frameOf(1, 0.5f), mSideBySide);
    const std::string told = reported();
    EXPECT_THAT(told, testing::HasSubstr("can not be written"));
    EXPECT_EQ(told.find('\n'), std::string::npos);
    EXPECT_FALSE(fs::exists(mFolder / "shots"));
}

}  // namespace
}  // namespace stereonav
