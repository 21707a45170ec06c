// Settings as texts: the command line comes back from them, scene files keep the user's own text, and steps
// are undone.
#include "app/view/setting_texts.h"

#include <gmock/gmock.h>

#include "app/view/settings_history.h"
#include "engine/base/error.h"
#include "engine/base/file.h"

namespace stereonav {
namespace {

TEST(SettingTexts, MakeTheOptionsOfACommandLine) {
    const ViewOptions options = viewOptionsOf({{"SCENE", {"cloud"}}, {"fov", {"50"}}, {"model", {"direct"}}});
    EXPECT_EQ(options.scene.scene, "cloud");
    EXPECT_EQ(options.scene.fov_deg, 50);
    EXPECT_EQ(options.scene.medium.model, MediumModel::Direct);
    EXPECT_EQ(settingTextsOf(options.scene.given),
              (SettingTexts{{"SCENE", {"cloud"}}, {"fov", {"50"}}, {"model", {"direct"}}}));
}

TEST(SettingTexts, WhatDoesNotGoIsRefusedAsOnTheCommandLine) {
    EXPECT_THROW(viewOptionsOf({{"fov", {"500"}}}), Error);
    EXPECT_THROW(viewOptionsOf({{"model", {"direct"}}}), Error) << "of media";
    EXPECT_THROW(viewOptionsOf({{"SCENE", {"cloud"}}, {"lamp", {"head"}}, {"light-from", {"1,2"}}}), Error);
}

TEST(SettingTexts, ACommandLineIsReadByAShell) {
    EXPECT_EQ(commandLineOf({{"SCENE", {"my dem's.tif"}}, {"open-holes", {""}}, {"sun", {"250,15"}}}),
              "stereonav view 'my dem'\\''s.tif' --open-holes --sun=250,15");
    EXPECT_EQ(renderLineOf({{"sweep", {"cpu"}}, {"fov", {"40"}}}, "1,2,3,4,5,6", {640, 480}),
              "stereonav render --fov=40 --size=640x480 --pose=1,2,3,4,5,6 --out view.png");
    EXPECT_EQ(shellWord(""), "''");
    EXPECT_EQ(shellWord("a\nb"), "$'a\\x0ab'");
    EXPECT_EQ(shellWord("\x1b[201~\xff'\\"), "$'\\x1b[201~\\xff\\'\\\\'");
}

TEST(SavedScene, KeepsWhatAPersonWrote) {
    const std::string before =
        "# my mountains\n[terrain]\nbuiltin = true  # yes\n\n[options]  # looks\nfov = \"45\"  # usual\n"
        "mode = 'arcd'\n\n[stereo]\nseparation_m = 3\n";
    EXPECT_EQ(savedScene(before, "", {{"fov", {"45"}}, {"mode", {"arcd"}}},
                         {{"fov", {"60"}}, {"mode", {"arcd"}}, {"open-holes", {""}}}),
              "# my mountains\n[terrain]\nbuiltin = true  # yes\n\n[options]  # looks\nfov = \"60\" # usual\n"
              "mode = 'arcd'\nopen-holes = true\n\n[stereo]\nseparation_m = 3\n");
}

TEST(SavedScene, MakesAFileOfAStudy) {
    EXPECT_EQ(
        savedScene("", "/data/a \"b\".nrrd", {}, {{"fov", {"60"}}, {"seed", {"1,2,3", "4,5,6"}}}),
        "scene = \"/data/a \\\"b\\\".nrrd\"\n\n[options]\nfov = \"60\"\nseed = [\"1,2,3\", \"4,5,6\"]\n");
}

TEST(SavedScene, RefusesWhatItWouldBreak) {
    EXPECT_THROW(savedScene("[options]\nseed = [\"1,2,3\",\n\"4,5,6\"]\n", "", {}, {{"seed", {"1,2,3"}}}),
                 Error);
}

TEST(SavedScene, IsReadBackAsItWasSet) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "saved_scene_test.toml";
    const SettingTexts set{{"fov", {"60"}}, {"mode", {"arcd"}}, {"separation", {"12.5"}}};
    writeTextFile(file, savedScene("", "terrain", {}, set));
    SettingTexts read = settingTextsOf(viewOptionsOf({{"SCENE", {file.string()}}}).scene.given);
    read.erase("SCENE");
    EXPECT_EQ(read, set);
}

TEST(SettingsHistory, GoesBackAndForth) {
    SettingsHistory history;
    const SettingTexts a{{"fov", {"40"}}}, b{{"fov", {"50"}}}, c{{"fov", {"60"}}};
    history.start(a);
    EXPECT_FALSE(history.canUndo());
    EXPECT_FALSE(history.undo());
    history.observe(b, true, 0.1);
    history.observe(c, true, 5);  // during a drag
    history.observe(c, false, 5);
    EXPECT_TRUE(history.canUndo());
    EXPECT_EQ(history.undo(), a) << "one step";
    history.observe(a, false, 5);
    EXPECT_EQ(history.redo(), c);
    history.observe(c, false, 5);
    EXPECT_EQ(history.redo(), std::nullopt);
    history.observe(b, false, 0.1);
    EXPECT_EQ(history.undo(), c) << "what has not come to rest counts too";
    history.observe(c, false, 1);
    history.observe(a, false, 1);
    history.observe(a, false, 1);
    EXPECT_FALSE(history.canRedo()) << "another way was taken";
}

TEST(SettingsHistory, WhatComesBackByItselfIsNoStep) {
    SettingsHistory history;
    const SettingTexts a{{"fov", {"40"}}}, b{{"fov", {"50"}}};
    history.start(a);
    history.observe(b, true, 0.1);
    history.observe(a, true, 0.1);
    history.observe(a, false, 5);
    EXPECT_FALSE(history.canUndo());
}

// A load that was cancelled, or failed: opened, undone, redone.
TEST(SettingsHistory, WhatDidNotComeAboutIsNoStep) {
    SettingsHistory history;
    const SettingTexts a{{"fov", {"40"}}}, b{{"fov", {"50"}}}, c{{"fov", {"60"}}};
    const auto rest = [&](const SettingTexts& at) {
        history.observe(at, false, 1);
        history.observe(at, false, 1);
    };
    history.start(a);
    rest(b);
    history.backTo(a);
    rest(a);
    EXPECT_FALSE(history.canUndo());
    EXPECT_FALSE(history.canRedo());
    history.observe(b, false, 0.1);
    history.backTo(a);
    rest(a);
    EXPECT_FALSE(history.canUndo()) << "before it came to rest";

    rest(b);
    rest(c);
    EXPECT_EQ(history.undo(), b);
    history.backTo(c);
    rest(c);
    EXPECT_FALSE(history.canRedo());
    EXPECT_EQ(history.undo(), b) << "what was there stays";
    EXPECT_EQ(history.redo(), c);
    EXPECT_EQ(history.undo(), b);
    rest(b);
    EXPECT_EQ(history.redo(), c);
    history.backTo(b);
    EXPECT_FALSE(history.canRedo());
    EXPECT_EQ(history.undo(), a);
}

TEST(SettingText, APictureHasThePlaceAndTheEyesThatAreSeen) {
    Pose pose;
    pose.position = {1.5, -2, 1234.5678};
    EXPECT_THAT(poseText(pose), testing::StartsWith("1.5,-2,1234.57,"));
    const std::vector<std::string> words =
        commandWords(command::kRender,
                     withEyes({{"separation", {"9"}}, {"fov", {"40"}}}, StereoSetting{.separation = 0.25}));
    EXPECT_THAT(words, testing::Contains("--separation=0.25")) << "not as it was asked for";
    EXPECT_THAT(words, testing::Contains("--fov=40"));
    EXPECT_THAT(words, testing::Contains(testing::StartsWith("--zero-parallax=")));
    const std::vector<std::string> one =
        commandWords(command::kRender, withEyes({}, StereoSetting{.separation = 0.25}, true));
    EXPECT_THAT(one, testing::IsSupersetOf({"--separation=0", "--mode=ml"})) << "in the middle of the head";
}

}  // namespace
}  // namespace stereonav
