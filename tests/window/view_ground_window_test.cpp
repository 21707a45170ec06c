// What is painted on the ground, set in the window under Xvfb: the picture follows, and it is said, undone
// and saved as any option.
#include "app/view/setting_texts.h"
#include "tests/window/window_test.h"

namespace stereonav {
namespace {

using GroundWindow = WindowTest;

std::filesystem::path writeGround(const std::filesystem::path& folder) {
    std::string text = "ncols 60\nnrows 60\nxllcorner 0\nyllcorner 0\ncellsize 30\n";
    for (int y = 0; y < 60; ++y) {
        for (int x = 0; x < 60; ++x)
            text += std::to_string(std::lround(200 + 90 * std::sin(x / 7.0) * std::cos(y / 9.0))) + " ";
        text += "\n";
    }
    writeTextFile(folder / "ground.asc", text);
    return folder / "ground.asc";
}

TEST_F(GroundWindow, PaintIsExchangedInThePicture) {
    writeTextFile(mFolder / "far.geojson", R"({"type":"LineString","coordinates":[[9250,200],[9000,0]]})");
    const std::string ground = writeGround(mFolder).string(), far = (mFolder / "far.geojson").string();
    ASSERT_EQ(drive("drive_ground.sh", "'" + ground + "' '" + far + "'"), 0)
        << textOf("problems.txt") << textOf("log.txt");
    EXPECT_EQ(textOf("status.txt"), "0\n") << textOf("log.txt");
    const auto said = [&](const char* file, const char* key) {
        const SettingTexts texts =
            settingTextsOf(viewOptionsOf({{"SCENE", {(mFolder / file).string()}}}).scene.given);
        const auto found = texts.find(key);
        return found == texts.end() ? std::string() : found->second.back();
    };
    const std::string interval = said("seen.toml", "contours");
    ASSERT_NE(interval, "");
    EXPECT_GT(std::stod(interval), 5);
    EXPECT_LT(std::stod(interval), 500);
    EXPECT_TRUE(said("seen.toml", "paint").starts_with("viewshed:")) << said("seen.toml", "paint");
    EXPECT_EQ(said("failed.toml", "paint"), "") << "it was undone";
    EXPECT_EQ(said("failed.toml", "contours"), interval);
    EXPECT_EQ(said("failed.toml", "tracks"), "") << "it is not shown";
}

}  // namespace
}  // namespace stereonav
