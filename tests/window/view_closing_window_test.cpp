// A recording in a window that is closed, killed, stopped, or shows another scene: the window asks before it
// closes, and what was recorded is there.

#include "engine/camera/recorded_path.h"
#include "tests/window/window_test.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

class ClosingWindow : public WindowTest {
protected:
    fs::path ground(const std::string& name) const {
        std::string text = "ncols 40\nnrows 40\nxllcorner 0\nyllcorner 0\ncellsize 30\n";
        for (int n = 0; n < 1600; ++n) text += std::to_string((n % 40 * (n % 40) + n / 40 * 3) % 97) + " ";
        writeTextFile(mFolder / name, text + "\n");
        return mFolder / name;
    }
};

TEST_F(ClosingWindow, AsksWhileAFlightIsRecordedAndKeepsIt) {
    const std::string scenes = "'" + ground("one.asc").string() + "' '" + ground("other.asc").string() + "'";
    ASSERT_EQ(drive("drive_closing.sh", scenes), 0) << textOf("problems.txt") << textOf("log.txt");
    EXPECT_EQ(textOf("ends.txt"), "quit 0\nclosed 0\nkilled 137\nstopped 1\nother 0\n");
    for (int number = 1; number <= 5; ++number) {
        const fs::path file = mFolder / "shots" / ("flight_000" + std::to_string(number) + ".gltf");
        ASSERT_TRUE(fs::exists(file)) << file;
        EXPECT_GE(readPath(file).duration(), 1) << file;
    }
    EXPECT_FALSE(fs::exists(mFolder / "shots/flight_0006.gltf"));
    std::size_t pictures = 0;
    for (const auto& entry : fs::directory_iterator(mFolder / "shots"))
        pictures += entry.path().extension() == ".png";
    EXPECT_EQ(pictures, 5u) << "one of each window: P in the search is a letter";
    EXPECT_THAT(textOf("log.txt"), testing::HasSubstr("flight_0005.gltf")) << "what became of it is told";
}

}  // namespace
}  // namespace stereonav
