// Settings that a scene was made of, and those that come back when another one can not be loaded.
#include "app/view/scene_settings.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "app/view/notices.h"
#include "app/view/window_jobs.h"
#include "engine/base/error.h"
#include "tests/camera/temporary_folder.h"

namespace stereonav {
namespace {

// scene: "" is the built-in terrain.
SceneMade madeWith(const std::string& scene, const std::string& fov) {
    SettingTexts texts{{"fov", {fov}}};
    if (!scene.empty()) texts["SCENE"] = {scene};
    return {viewOptionsOf(texts), texts, {}};
}

class ShownSettings : public testing::Test {
protected:
    std::optional<ViewSession> session;
    SceneSettings settings{madeWith("", "50").options, session};
};

TEST_F(ShownSettings, BeforeASceneIsThereItHasWhatWasGiven) {
    EXPECT_EQ(settings.now().at("fov"), std::vector<std::string>{"50"});
    EXPECT_FALSE(settings.begun());
    EXPECT_FALSE(settings.history().canUndo());
}

TEST_F(ShownSettings, WhatIsLoadedCountsUntilItIsNotToBeHad) {
    settings.begin(madeWith("colon", "60"));
    settings.begin(madeWith("cloud", "60"));
    EXPECT_TRUE(settings.begun());
    EXPECT_EQ(settings.sceneName(), "cloud");
    settings.keepBefore();
    EXPECT_FALSE(settings.begun());
    EXPECT_EQ(settings.sceneName(), "terrain");
    EXPECT_EQ(settings.now().at("fov"), std::vector<std::string>{"50"});
}

TEST_F(ShownSettings, WhatArrivedStays) {
    settings.begin(madeWith("colon", "60"));
    settings.arrived();
    settings.keepBefore();
    EXPECT_EQ(settings.sceneName(), "colon");
    EXPECT_EQ(settings.fullName(), "colon");
}

TEST_F(ShownSettings, OptionsOfOtherScenesDoNotApply) {
    EXPECT_TRUE(settings.applies(*viewOption("sun")));
    EXPECT_FALSE(settings.applies(*viewOption("series")));
}

TEST_F(ShownSettings, SavesNoSceneOverAnotherFile) {
    const TemporaryFolder folder;
    const auto place = settings.save(folder / "kept");
    EXPECT_EQ(place.extension(), ".toml");
    EXPECT_TRUE(std::filesystem::exists(place));
    EXPECT_THROW(settings.save(folder / "kept.toml"), Error);
}

TEST_F(ShownSettings, FailureStaysUntilItIsForgotten) {
    Notices notices{ViewOptions{}};
    notices.tryTo([] { throw Error("file", "", "is damaged", ""); });
    EXPECT_NE(notices.failure().find("is damaged"), std::string::npos);
    notices.tryTo([] {});
    EXPECT_FALSE(notices.failure().empty());
    notices.forgetFailure();
    EXPECT_TRUE(notices.failure().empty());
}

TEST_F(ShownSettings, JobsKnowWhatCanBeBaked) {
    Notices notices{ViewOptions{}};
    WindowJobs jobs{session, settings, notices};
    EXPECT_TRUE(jobs.bakes());
    EXPECT_FALSE(jobs.bakeTakes("no such option", "1"));
    EXPECT_FALSE(jobs.busy());
    EXPECT_FALSE(jobs.look());
    EXPECT_EQ(jobs.atWork(), "");
    settings.begin(madeWith("cloud", "60"));
    EXPECT_FALSE(jobs.bakes());
}

}  // namespace
}  // namespace stereonav
