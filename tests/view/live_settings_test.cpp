// Settings that a session takes at once: the function in use is reported, and goes back without reading the
// scene.
#include "app/view/live_settings.h"

#include <gtest/gtest.h>

#include "engine/base/error.h"
#include "tests/view/fake_frames.h"
#include "tests/view/fake_scene.h"

namespace stereonav {
namespace {

constexpr const char* kGivenCurve = "curve:0:1:1:1:0,100:1:1:1:1";

class StillFlight final : public Flight {
public:
    void step(const FlightInput&, double) override {}
    void turnBy(double, double) override {}
    Pose pose() const override { return mPose; }
    void setPose(const Pose& pose) override { mPose = pose; }
    void goHome() override { mPose = {}; }
    int modeCount() const override { return 1; }
    int mode() const override { return 0; }
    void setMode(int) override {}
    std::string_view modeName(int) const override { return "still"; }
    double speed() const override { return 1; }
    double clearanceNow() const override { return 1; }

private:
    Pose mPose;
};

class LiveSettings : public testing::Test {
protected:
    LiveSettings() {
        mScene.makeFlight = [] { return std::make_unique<StillFlight>(); };
        mScene.frames = &mFrames;
        mScene.way.method = mFrames.defaultMethod();
        mScene.surface.emplace();
        mScene.surface->isovalue = 100;
        mScene.surface->transfers = {"", "tissue"};
        mScene.values.emplace();
        mScene.values->begun.isovalue = 100;
        mScene.values->begun.isovalueChosen = true;
        mScene.values->begun.opacity = 0.95;
    }
    void openedThrough(const std::string& transfer) {
        mScene.surface->translucent = mScene.values->begun.translucent = true;
        mScene.values->begun.transfer = transfer;
    }
    ViewSession session() { return ViewSession(opened(mScene), {OutputMode::SideBySide, std::nullopt, "."}); }
    static SettingTexts texts(const ViewSession& session) { return withLive(session, {}); }

    FakeFrames mFrames;
    FakeParts mScene;
};

TEST_F(LiveSettings, SayWhatIsSeenThrough) {
    ViewSession s = session();
    EXPECT_EQ(texts(s), SettingTexts()) << "as it was opened";
    EXPECT_EQ(withLive(s, {{"transfer", {"tissue"}}, {"opacity", {"1"}}}), SettingTexts()) << "it is opaque";
    s.act({ViewCommand::ToggleTranslucent});
    EXPECT_EQ(texts(s), (SettingTexts{{"opacity", {"0.95"}}}));
    setLive(s, "transfer", kGivenCurve);
    EXPECT_EQ(texts(s), (SettingTexts{{"transfer", {kGivenCurve}}}));
    EXPECT_EQ(withLive(s, {{"opacity", {"0.95"}}}), texts(s)) << "one of them alone";
    EXPECT_EQ(valueNow(s, "transfer"), kGivenCurve);
    EXPECT_EQ(valueNow(s, "opacity"), "");
    setLive(s, "opacity", "0.95");
    EXPECT_EQ(texts(s), (SettingTexts{{"opacity", {"0.95"}}}));
    setLive(s, "transfer", std::nullopt);
    EXPECT_EQ(texts(s), (SettingTexts{{"opacity", {"0.95"}}})) << "there is none to take back";
    setLive(s, "opacity", std::nullopt);
    EXPECT_EQ(texts(s), SettingTexts());
}

TEST_F(LiveSettings, GoBackToTheFileThatTheSceneWasOpenedWith) {
    openedThrough("my function.txt");
    ViewSession s = session();
    const SettingTexts first{{"transfer", {"my function.txt"}}};
    EXPECT_EQ(texts(s), first);
    setLive(s, "transfer", kGivenCurve);
    EXPECT_EQ(texts(s), (SettingTexts{{"transfer", {kGivenCurve}}}));
    ASSERT_TRUE(isLive(s, "transfer", "my function.txt"));
    setLive(s, "transfer", "my function.txt");
    EXPECT_EQ(texts(s), first);
    EXPECT_EQ(s.surface().now().transfer, "") << "that of the options";
    EXPECT_FALSE(isLive(s, "opacity", "0.95")) << "it was not opened with one";
}

TEST_F(LiveSettings, AreThoseThatNeedNoReading) {
    ViewSession s = session();
    for (const char* text : {"tissue", kGivenCurve}) EXPECT_TRUE(isLive(s, "transfer", text)) << text;
    EXPECT_FALSE(isLive(s, "transfer", "other.txt"));
    EXPECT_TRUE(isLive(s, "opacity", "0.950"));
    EXPECT_FALSE(isLive(s, "opacity", "0.5"));
    EXPECT_FALSE(isLive(s, "opacity")) << "while it is dragged the scene is not read again and again";
    EXPECT_TRUE(isLive(s, "isovalue", std::nullopt));
    mScene.values->begun.isovalueChosen = false;
    EXPECT_FALSE(isLive(session(), "isovalue", std::nullopt)) << "what would be chosen is not known";
    EXPECT_THROW(setLive(s, "transfer", "curve:0:1:1:1:2"), Error);
    EXPECT_EQ(texts(s), SettingTexts());
}

TEST_F(LiveSettings, AnIsovalueIsSaidWhereItIsAnotherOne) {
    ViewSession s = session();
    setLive(s, "isovalue", "120");
    EXPECT_EQ(texts(s), (SettingTexts{{"isovalue", {"120"}}}));
    setLive(s, "isovalue", std::nullopt);
    EXPECT_EQ(texts(s), SettingTexts());
    // Another function makes another scene, with the same isovalue.
    mScene.changed = true;
    s.replaceScene(opened(mScene));
    EXPECT_EQ(texts(s), SettingTexts());
}

TEST(SettingText, WhatDoesNotGoWithItGivesWay) {
    SettingTexts settings{{"opacity", {"0.5"}}, {"fov", {"40"}}};
    setText(settings, "transfer", "tissue");
    EXPECT_EQ(settings, (SettingTexts{{"fov", {"40"}}, {"transfer", {"tissue"}}}));
    setText(settings, "opacity", "0.7");
    EXPECT_EQ(settings, (SettingTexts{{"fov", {"40"}}, {"opacity", {"0.7"}}}));
    setText(settings, "opacity", "0.8");
    EXPECT_EQ(settings.at("opacity"), std::vector<std::string>{"0.8"});
}

}  // namespace
}  // namespace stereonav
