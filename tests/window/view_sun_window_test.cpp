// The sun by date and time, typed into the window under Xvfb: what is set is what the engine says.
#include "app/view/setting_texts.h"
#include "app/view/sun_clock.h"
#include "tests/window/window_test.h"

namespace stereonav {
namespace {

using SunWindow = WindowTest;

// Without a place on the Earth: latitude and longitude are 0 until they are typed.
std::filesystem::path writeGroundNowhere(const std::filesystem::path& folder) {
    std::string text = "ncols 40\nnrows 40\nxllcorner 0\nyllcorner 0\ncellsize 30\n";
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 40; ++x) text += std::to_string((x * x + 3 * y) % 97) + " ";
        text += "\n";
    }
    writeTextFile(folder / "ground.asc", text);
    return folder / "ground.asc";
}

TEST_F(SunWindow, IsSetByDateAndTime) {
    ASSERT_EQ(drive("drive_sun.sh", "'" + writeGroundNowhere(mFolder).string() + "'"), 0)
        << textOf("problems.txt") << textOf("log.txt");
    EXPECT_EQ(textOf("status.txt"), "0\n") << textOf("log.txt");
    const auto sunOf = [&](const char* file) {
        const SettingTexts said =
            settingTextsOf(viewOptionsOf({{"SCENE", {(mFolder / file).string()}}}).scene.given);
        const auto found = said.find("sun");
        return found == said.end() ? std::string() : found->second.back();
    };
    const SunClock clock = *withTime(*withDate({}, "2024-06-21"), "09:30");
    EXPECT_EQ(sunOf("set.toml"), sunOptionText(sunThen(clock, 0).world));
    EXPECT_NE(sunOf("undone.toml"), sunOf("set.toml"));
}

}  // namespace
}  // namespace stereonav
