// Coverage in a window: what was not seen is tinted in both eyes, a key flies to it, and it is gone when it
// is switched off.
#include <cmath>

#include "tests/support/byte_study.h"
#include "tests/window/window_test.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

// Pixels of one half that are tinted: much more blue than red.
int tintedPixels(const Picture& picture, bool right) {
    int count = 0;
    const int half = picture.width() / 2;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = right ? half : 0; x < (right ? picture.width() : half); ++x)
            count += byteOf(picture.at(x, y), 2) > byteOf(picture.at(x, y), 0) + 25;
    return count;
}

class CoverageWindow : public WindowTest {
protected:
    // A straight tube of 200 mm, 16 mm wide, with a ring near its start: its far part is met too flat to
    // count as seen, and what is behind the ring is hidden.
    fs::path tube() const {
        return test::writeByteStudy(mFolder / "tube.nrrd", {24, 24, 204}, {0, 0, 0}, [](int i, int j, int k) {
            return std::hypot(i - 11.5, j - 11.5) < 8 && k > 1 && k < 202;
        });
    }
};

TEST_F(CoverageWindow, TintsWhatWasNotSeenAndFliesThere) {
    ASSERT_EQ(drive("drive_coverage.sh",
                    "'" + tube().string() + "' --separation 0.001 --zero-parallax 0.03 --method cubic"),
              0)
        << textOf("problems.txt") << textOf("log.txt");
    EXPECT_EQ(textOf("status.txt"), "0\n") << textOf("log.txt");
    std::map<std::string, Picture> shots;
    for (const auto& [step, file] : steps()) shots[step] = readColorImage(file);
    ASSERT_EQ(shots.size(), 4u);
    for (const bool right : {false, true}) {
        EXPECT_EQ(tintedPixels(shots["start"], right), 0);
        EXPECT_GT(tintedPixels(shots["followed"], right), 100);
        EXPECT_EQ(tintedPixels(shots["off"], right), 0);
    }
    EXPECT_GT(difference(shots["followed"], shots["unseen"]), kDifferent) << "the eyes are elsewhere";
    EXPECT_LT(difference(shots["start"], shots["off"]), 1e-9);
    EXPECT_NE(textOf("first.json").find("stereonav_coverage"), std::string::npos);
}

}  // namespace
}  // namespace stereonav
