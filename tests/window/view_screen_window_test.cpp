// The window asks once how wide the screen is, where that does not tell, and keeps the answer for the
// monitor; and what it prints with --json and --quiet.
#include <nlohmann/json.hpp>

#include "app/view/window_config.h"
#include "tests/window/window_test.h"

namespace stereonav {
namespace {

using ScreenWindow = WindowTest;

TEST_F(ScreenWindow, KeepsWhatItWasTold) {
    ASSERT_EQ(drive("drive_screen.sh"), 0) << textOf("problems.txt") << textOf("log.txt");
    const ReadConfig kept = readWindowConfig(mFolder / "kept.toml");
    EXPECT_EQ(kept.problem, "");
    ASSERT_EQ(kept.config.screens.size(), 1u) << textOf("kept.toml");
    EXPECT_EQ(kept.config.screens[0].width_mm, 598);
    EXPECT_FALSE(kept.config.screens[0].monitor.empty());
    EXPECT_EQ(readWindowConfig(mFolder / "again.toml").config, kept.config)
        << "the command line goes before it, and is not kept";

    const auto told = nlohmann::json::parse(textOf("told.json"), nullptr, false);
    ASSERT_TRUE(told.is_object()) << textOf("told.json");
    EXPECT_EQ(told["command"], "view");
    EXPECT_EQ(told["scene"], "terrain");
    ASSERT_TRUE(told["told"].is_array());
    EXPECT_THAT(told["told"].dump(), testing::HasSubstr("stereonav_")) << "the pictures that were saved";
    EXPECT_EQ(textOf("quiet.txt"), "");
}

}  // namespace
}  // namespace stereonav
