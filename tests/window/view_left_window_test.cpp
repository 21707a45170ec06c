// The first start shows one eye; size, place, mode and view are there again at the next one.
#include <sstream>

#include "tests/window/window_test.h"

namespace stereonav {
namespace {

class LeftWindow : public WindowTest {
protected:
    // The window's x, y, width and height in a step.
    std::string placeOf(const std::string& step) const {
        std::istringstream in(textOf("sizes.txt"));
        for (std::string line; std::getline(in, line);)
            if (line.starts_with(step + " ")) return line.substr(step.size() + 1);
        return "";
    }
};

TEST_F(LeftWindow, BeginsWithOneEyeAndIsThereAgainAsItWas) {
    std::string text = "ncols 40\nnrows 40\nxllcorner 0\nyllcorner 0\ncellsize 30\n";
    for (int n = 0; n < 1600; ++n) text += std::to_string((n % 40 * (n % 40) + n / 40 * 3) % 97) + " ";
    const std::filesystem::path ground = mFolder / "ground.asc";
    writeTextFile(ground, text + "\n");
    ASSERT_EQ(drive("drive_left.sh", "'" + ground.string() + "'"), 0)
        << textOf("problems.txt") << textOf("log.txt");
    const auto files = steps();
    const auto mode = [&](const char* step) {
        const std::string stem = files.at(step).stem().string();
        return stem.substr(stem.rfind('_') + 1);
    };
    std::map<std::string, Picture> shots;
    for (const auto& [step, file] : files) shots[step] = readColorImage(file);
    EXPECT_EQ(mode("first"), "ml") << "one eye";
    EXPECT_THAT(placeOf("first"), testing::HasSubstr(" 1177 720 ")) << "of 1280x720, as the screen has room";
    EXPECT_EQ(mode("left"), "tbl");
    EXPECT_EQ(placeOf("left"), "100 60 640 480 ");
    EXPECT_EQ(mode("again"), "tbl");
    EXPECT_EQ(placeOf("again"), placeOf("left"));
    EXPECT_LT(difference(shots["again"], shots["left"]), kSame) << "the same view";
    EXPECT_EQ(mode("reset"), "ml") << "as at first, not as it was left";
    EXPECT_EQ(mode("said"), "arcd");
    EXPECT_EQ(mode("kept"), "ml");
    EXPECT_EQ(placeOf("kept"), placeOf("again")) << "--size is not kept";
}

}  // namespace
}  // namespace stereonav
