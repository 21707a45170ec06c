// Bad input: one line that says where and what to do, exit status 1, nothing half-written.
#include "tests/app/program.h"

namespace stereonav::test {
namespace {

class BadInput : public ProgramTest {
protected:
    // A render of `scene` that would leave out.png if it were not refused.
    void expectSceneRefused(const std::string& scene, const std::vector<std::string>& words) const {
        expectRefused({"render", scene, "--size", "32x24", "--out", "out.png"}, words);
    }

    void expectPathRefused(const std::string& path, const std::vector<std::string>& words) const {
        expectRefused({"play", hills(), "--size", "32x24", "--path", path, "--out", "frames"}, words);
        expectRefused({"compare", hills(), "--size", "32x24", "--path", path, "--json", "out.json"}, words);
    }
};

TEST_F(BadInput, SceneFileMissingOrEmpty) {
    expectSceneRefused("nowhere.tif", {"nowhere.tif"});
    expectSceneRefused("nowhere.toml", {"nowhere.toml"});
    expectSceneRefused(input("empty.tif", ""), {"empty.tif"});
    expectSceneRefused(input("empty.asc", ""), {"empty.asc"});
    expectSceneRefused(mFolder.string(), {mFolder.string()});
}

TEST_F(BadInput, NotAnElevationModel) {
    expectSceneRefused(input("letter.tif", "Dear reader,\nthis is a letter.\n"), {"letter.tif"});
    expectSceneRefused(input("short.hgt", std::string(1000, 'x')), {"short.hgt"});
}

TEST_F(BadInput, TruncatedElevationModel) {
    const std::string whole = contentOf(hills());
    expectSceneRefused(input("cut.asc", whole.substr(0, whole.size() / 2)), {"cut.asc"});
    const std::string head = "ncols 32\nnro";
    expectSceneRefused(input("head.asc", head), {"head.asc"});
}

TEST_F(BadInput, GridsWithoutASurface) {
    expectSceneRefused(grid("nodata.asc", 8, 8, 1, [](int, int) { return -9999; }), {"nodata.asc"});
    expectSceneRefused(grid("one.asc", 1, 1, 1, [](int, int) { return 5; }), {"one.asc"});
    expectSceneRefused(grid("row.asc", 9, 1, 1, [](int i, int) { return i; }), {"row.asc"});
    expectSceneRefused(grid("column.asc", 1, 9, 1, [](int, int j) { return j; }), {"column.asc"});
    expectSceneRefused(grid("nan.asc", 4, 4, 1, [](int, int) { return "nan"; }), {"nan.asc"});
}

TEST_F(BadInput, AGridOfAbsurdSizeIsRefusedBeforeItIsRead) {
    const std::string head = "ncols 100000\nnrows 100000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n";
    expectSceneRefused(input("huge.asc", head), {"huge.asc"});
}

TEST_F(BadInput, UnknownKeysInASceneFile) {
    const std::string toml = "[terrain]\nbuiltin = true\nvertical_scal = 2\n";
    expectSceneRefused(input("typo.toml", toml), {"typo.toml", "3", "vertical_scal", "vertical_scale"});
    expectSceneRefused(input("broken.toml", "[terrain\n"), {"broken.toml", "1"});
}

TEST_F(BadInput, AnImageOrSkyThatIsNoPicture) {
    expectRefused({"render", hills(), "--image", "nothing.png", "--out", "out.png"}, {"nothing.png"});
    expectRefused({"render", hills(), "--image", input("text.png", "no picture"), "--out", "out.png"},
                  {"text.png"});
    expectRefused({"render", hills(), "--sky", "nothing.hdr", "--out", "out.png"}, {"nothing.hdr"});
    expectRefused({"render", hills(), "--visibility", "20", "--out", "out.png"},
                  {"--visibility", "needs --sky physical"});
    expectRefused({"render", hills(), "--sky", "physical", "--medium", "snow", "--out", "out.png"},
                  {"--sky", "has no air"});
    expectRefused({"render", "colon", "--sky", "physical", "--out", "out.png"}, {"--sky", "a terrain"});
}

TEST_F(BadInput, PathsThatCanNotBeFlown) {
    expectPathRefused("nowhere.path", {"nowhere.path"});
    expectPathRefused(input("empty.path", ""), {"empty.path"});
    expectPathRefused(input("one.path", "0 0 0 500 0 0 0 1\n"), {"one.path"});
    expectPathRefused(input("twice.path", "0 0 0 500 0 0 0 1\n0 9 0 500 0 0 0 1\n"), {"twice.path"});
    expectPathRefused(input("zero.path", "0 0 0 500 0 0 0 1\n1 9 0 500 0 0 0 0\n"), {"zero.path"});
    expectPathRefused(input("odd.txt", "0 0 0 500 0 0 0 1\n1 9 0 500 0 0 0 1\n"), {"odd.txt"});
}

TEST_F(BadInput, Sizes) {
    const std::string scene = hills();
    for (const std::string size : {"0x400", "100000x400"}) {
        expectRefused({"info", scene, "--size", size}, {"--size", size});
        expectRefused({"render", scene, "--size", size, "--out", "out.png"}, {"--size", size});
        expectRefused({"play", scene, "--size", size, "--out", "frames"}, {"--size", size});
        expectRefused({"compare", scene, "--size", size, "--json", "out.json"}, {"--size", size});
    }
    for (const std::string size :
         {"500x0", "500x100000", "-5x5", "500", "500x", "axb", "500x400x3", "1e3x10", "99999999999x1"})
        expectRefused({"info", scene, "--size", size}, {"--size", size});
}

TEST_F(BadInput, ASizeThatFitsTheRangeButNotTheMemory) {
    const double bytes =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
    if (bytes > 200e9) GTEST_SKIP() << "this machine could hold it";
    expectRefused({"render", hills(), "--size", "32768x32768", "--out", "out.png"},
                  {"--size", "32768x32768"});
}

TEST_F(BadInput, AWindowWithoutADisplay) {
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    expectRefused({"view", hills()}, {"display"});
}

TEST_F(BadInput, UnknownNames) {
    expectRefused({"view", hills(), "--mode", "magic"}, {"magic", "arcd"});
    expectRefused({"compare", hills(), "--methods", "full,magic"}, {"magic", "paper", "cubic"});
    expectRefused({"render", hills(), "--method", "magic", "--out", "out.png"}, {"magic", "linear"});
    expectRefused({"render", hills(), "--mode", "magic", "--out", "out.png"}, {"magic", "sbsl", "arcd"});
    expectRefused({"render", hills(), "--simd", "magic", "--out", "out.png"}, {"magic", "avx2"});
    expectRefused({"fly", hills()}, {"fly", "--help"});
    expectRefused({"render", hills(), "--colour", "x", "--out", "out.png"}, {"--colour"});
}

TEST_F(BadInput, NumbersOutOfRange) {
    const std::string scene = hills();
    expectRefused({"render", scene, "--fov", "180", "--out", "out.png"}, {"--fov"});
    expectRefused({"render", scene, "--fov", "-1", "--out", "out.png"}, {"--fov"});
    expectRefused({"render", scene, "--vertical-scale", "0", "--out", "out.png"}, {"--vertical-scale"});
    expectRefused({"render", scene, "--separation", "-1", "--out", "out.png"}, {"--separation"});
    expectRefused({"render", scene, "--zero-parallax", "0", "--out", "out.png"}, {"--zero-parallax"});
    expectRefused({"render", scene, "--threads", "-2", "--out", "out.png"}, {"--threads"});
    expectRefused({"render", scene, "--pose", "1,2", "--out", "out.png"}, {"--pose"});
    expectRefused({"render", scene, "--pose", "1,2,nan", "--out", "out.png"}, {"--pose"});
    expectRefused({"render", scene, "--pose", "1,2,3,4,5,6,7", "--out", "out.png"}, {"--pose"});
    expectRefused({"play", scene, "--frames", "0", "--hash"}, {"--frames"});
    expectRefused({"play", scene, "--fps", "0", "--hash"}, {"--fps"});
    expectRefused({"play", scene, "--fps", "abc", "--hash"}, {"--fps"});
    expectRefused({"compare", scene, "--frames", "0"}, {"--frames"});
    expectRefused({"compare", scene, "--repeats", "0"}, {"--repeats"});
    expectRefused({"compare", scene, "--relative-separation", "1/0"}, {"--relative-separation"});
    expectRefused({"compare", scene, "--relative-separation", "wide"}, {"--relative-separation"});
}

// Refused before the scene is read: the scene named does not even exist.
TEST_F(BadInput, PlacesThatCanNotBeWrittenAreRefusedFirst) {
    const std::string file = input("file", "x");
    expectRefused({"render", "nowhere.tif", "--out", file + "/out.png"}, {"--out", file});
    expectRefused({"render", "nowhere.tif", "--out", "/proc/out.png"}, {"--out", "/proc"});
    expectRefused({"render", "nowhere.tif", "--out", "out.txt"}, {"--out", "out.txt"});
    expectRefused({"render", "nowhere.tif", "--out", "out"}, {"--out"});
    expectRefused({"render", "nowhere.tif"}, {"--out"});
    expectRefused({"play", "nowhere.tif", "--out", file + "/frames"}, {"--out", file});
    expectRefused({"play", "nowhere.tif", "--video", "/proc/flight.mp4"}, {"--video", "/proc"});
    expectRefused({"play", "nowhere.tif", "--video", "flight.gif"}, {"--video", "flight.gif", ".mp4"});
    expectRefused({"play", "nowhere.tif"}, {"--out", "--video", "--hash"});
    expectRefused({"compare", "nowhere.tif", "--json", file + "/a.json"}, {"--json", file});
    expectRefused({"compare", "nowhere.tif", "--csv", "/proc/a.csv"}, {"--csv", "/proc"});
    expectRefused({"compare", "nowhere.tif", "--images", "/proc/pictures"}, {"--images", "/proc"});
    expectRefused({"compare", "nowhere.tif", "--plot", "plot.txt"}, {"--plot", "plot.txt"});
}

// Damaged files hold bytes that would clear a terminal or break the line; what is said of them does not.
TEST_F(BadInput, BytesOfDamagedFilesDoNotReachTheTerminal) {
    const std::string path = input("odd.path", "0 0 0 0 0 0 0 1\n1 0 \x1b[2J\x0b\x7f\x01 0 0 0 1\n");
    const Outcome outcome = run({"play", hills(), "--size", "32x24", "--path", path, "--out", "frames"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("[2J"), std::string::npos) << "not quoted any more: " << outcome.err;
    for (const char c : outcome.err.substr(0, outcome.err.size() - 1))
        EXPECT_TRUE(static_cast<unsigned char>(c) >= ' ' && c != '\x7f') << static_cast<int>(c);
}

// Heights that are extreme but finite are a terrain like any other.
TEST_F(BadInput, ExtremeHeightRangesAreFlown) {
    const auto flat =
        grid("flat.asc", 16, 16, 10, [](int i, int j) { return (i + j) % 2 ? "1000" : "1000.0001"; });
    const auto steep =
        grid("steep.asc", 16, 16, 10, [](int i, int j) { return (i + j) % 5 ? "0" : "1000000"; });
    const auto pitted =
        grid("pitted.asc", 16, 16, 10, [](int i, int j) { return i == 5 && j > 3 ? "nan" : "20"; });
    for (const std::string& scene : {flat, steep, pitted}) {
        const Outcome outcome = run({"render", scene, "--size", "40x30", "--out", "out.png"});
        EXPECT_EQ(outcome.status, 0) << scene << outcome.err;
        EXPECT_EQ(outcome.err, "");
        EXPECT_TRUE(std::filesystem::exists(place() / "out.png"));
        std::filesystem::remove(place() / "out.png");
    }
}

}  // namespace
}  // namespace stereonav::test
