// The interface of the window, as a person uses it under Xvfb: files opened by typing their names, scenes
// saved, steps undone, panels beside the picture, a card of the start page in the right eye's part.
#include "app/view/setting_texts.h"
#include "tests/window/window_test.h"

namespace stereonav {
namespace {

using PanelsWindow = WindowTest;

// A small DEM: ESRI ASCII grid.
std::filesystem::path writeDem(const std::filesystem::path& folder) {
    std::string text = "ncols 40\nnrows 40\nxllcorner 0\nyllcorner 0\ncellsize 30\n";
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 40; ++x) text += std::to_string((x * x + 3 * y) % 97) + " ";
        text += "\n";
    }
    const std::filesystem::path file = folder / "ground.asc";
    writeTextFile(file, text);
    return file;
}

TEST_F(PanelsWindow, OpensSavesUndoesAndStartsAgain) {
    const std::filesystem::path dem = writeDem(mFolder);
    ASSERT_EQ(drive("drive_panels.sh", "'" + dem.string() + "'"), 0)
        << textOf("problems.txt") << textOf("log.txt");
    EXPECT_EQ(textOf("status.txt"), "0\n") << textOf("log.txt");
    const auto separation = [&](const char* file) {
        const SettingTexts said =
            settingTextsOf(viewOptionsOf({{"SCENE", {(mFolder / file).string()}}}).scene.given);
        const auto found = said.find("separation");
        return found == said.end() ? 0 : std::stod(found->second.back());
    };
    EXPECT_THAT(textOf("first.toml"), testing::HasSubstr("scene = \"" + dem.string() + "\""));
    EXPECT_EQ(separation("first.toml"), 0) << "nothing was set";
    EXPECT_GT(separation("narrowed.toml"), 0);
    EXPECT_EQ(textOf("undone.toml"), textOf("first.toml"));
    EXPECT_EQ(textOf("redone.toml"), textOf("narrowed.toml"));

    std::map<std::string, Picture> shots;
    for (const auto& [step, file] : steps()) shots[step] = readColorImage(file);
    ASSERT_TRUE(shots.contains("with_panels") && shots.contains("without"));
    EXPECT_LT(shots["with_panels"].width(), shots["without"].width()) << "panels lie beside the picture";
    ASSERT_TRUE(shots.contains("apart") && shots.contains("flown_from_controls") &&
                shots.contains("together"));
    EXPECT_EQ(shots["apart"].width(), shots["without"].width());
    EXPECT_GT(difference(shots["apart"], shots["flown_from_controls"]), kDifferent);
    EXPECT_EQ(shots["together"].width(), shots["with_panels"].width());
    EXPECT_TRUE(std::filesystem::exists(mFolder / ".local/state/stereonav/recent.json"));
    EXPECT_THAT(textOf(".config/stereonav/window.toml"), testing::HasSubstr("speed_by_distance = true"));
}

}  // namespace
}  // namespace stereonav
