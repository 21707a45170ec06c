// Starts the program in a window under Xvfb, drives it with keys and mouse, and looks at the pictures
// it saves and at the window's own pixels. Needs xvfb-run and xdotool; import (ImageMagick) for the pixels.
#include "engine/image/stereo_compose.h"
#include "tests/window/window_test.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

using ViewWindow = WindowTest;

// The middle of the window, where no text lies, against the picture that was saved.
void expectWindowShows(const fs::path& window, const Picture& saved) {
    const Picture shown = readColorImage(window);
    ASSERT_EQ(shown.width(), saved.width());
    ASSERT_EQ(shown.height(), saved.height());
    const int y = saved.height() * 4 / 10, height = saved.height() / 10;
    EXPECT_LT(difference(shown, 0, y, saved, 0, y, saved.width(), height), kSame) << window;
}

TEST_F(ViewWindow, ObeysKeysAndMouse) {
    ASSERT_EQ(drive("drive_view.sh"), 0) << textOf("problems.txt") << textOf("log.txt");
    EXPECT_EQ(textOf("status.txt"), "0\n") << textOf("log.txt");
    std::map<std::string, Picture> shots;
    std::map<std::string, std::string> names;
    for (const auto& [step, file] : steps()) {
        shots[step] = readColorImage(file);
        names[step] = file.stem().string().substr(std::string("stereonav_0001_").size());
    }
    ASSERT_EQ(shots.size(), 17u);
    const Picture& start = shots["start"];
    ASSERT_EQ(start.width(), 640);
    ASSERT_EQ(start.height(), 240);
    EXPECT_THAT(textOf("log.txt"), testing::HasSubstr("saved "));

    // Eye swap exchanges the halves exactly; the halves are two different eyes.
    EXPECT_LT(difference(start, 0, 0, shots["swapped"], 320, 0, 320, 240), 1e-9);
    EXPECT_LT(difference(start, 320, 0, shots["swapped"], 0, 0, 320, 240), 1e-9);
    EXPECT_GT(difference(start, 0, 0, start, 320, 0, 320, 240), kDifferent);

    // Each mode under its name, in its size.
    EXPECT_EQ(names["anaglyph"], "arcd");
    EXPECT_EQ(names["anaglyph_next"], "agmg");
    EXPECT_EQ(names["left"], "ml");
    EXPECT_EQ(names["top_bottom"], "tbl");
    EXPECT_EQ(shots["anaglyph"].width(), 640);
    EXPECT_EQ(shots["top_bottom"].height(), 240);
    EXPECT_GT(difference(shots["anaglyph"], shots["left"]), kDifferent);
    EXPECT_GT(difference(shots["one_eye"], shots["left"]), 0.1) << "the head lies between the eyes";

    EXPECT_EQ(difference(start, shots["side_by_side"]), 0.0) << "back in the first mode";

    // Flight and stereo settings change the picture; keys that change nothing do not.
    EXPECT_GT(difference(start, shots["moved"]), kDifferent);
    EXPECT_GT(difference(shots["moved"], shots["separated"]), 0.1);
    EXPECT_GT(difference(shots["separated"], shots["recorded"]), kDifferent);
    EXPECT_GT(difference(shots["playing"], shots["recorded"]), kDifferent);
    EXPECT_LT(difference(shots["turned"], shots["recorded"]), kSame) << "the end of recording moves nothing";
    EXPECT_LT(difference(shots["played"], shots["recorded"]), kSame) << "the flight ends where it ended";
    EXPECT_GT(difference(shots["dragged"], shots["played"]), kDifferent);
    EXPECT_GT(difference(shots["home"], shots["dragged"]), kDifferent);
    EXPECT_EQ(shots["resized"].width(), 500);
    EXPECT_EQ(shots["resized"].height(), 200);
    EXPECT_TRUE(fs::exists(mFolder / "shots" / "flight_0001.gltf"));

    if (!installed("import"))
        GTEST_SKIP() << "import is not installed: the window's own pixels are not looked at";
    expectWindowShows(mFolder / "window_anaglyph.png", shots["anaglyph"]);
    expectWindowShows(mFolder / "window_side_by_side.png", start);
}

}  // namespace
}  // namespace stereonav
