// The viewer with volumes, without a window: eyes that follow the room, surfaces that move, slices and seeds,
// scenes that replace another.
#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "app/view/input.h"
#include "app/view/session.h"
#include "app/view/status.h"
#include "engine/text/length_text.h"
#include "tests/view/fake_frames.h"
#include "tests/view/fake_scene.h"

namespace stereonav {
namespace {

// Hovers at its place; its clearance is set by the test.
class Hover final : public Flight {
public:
    explicit Hover(const double& clearance) : mClearance(clearance) {}
    void step(const FlightInput& input, double dt) override {
        mPose.position.x += 0.03 * input.forward * input.speedMultiplier * dt;
        mRolled += std::abs(input.rollRate) * dt;
    }
    void turnBy(double, double) override {}
    Pose pose() const override { return mPose; }
    void setPose(const Pose& pose) override { mPose = pose; }
    void goHome() override { mPose = {}; }
    int modeCount() const override { return 2; }
    int mode() const override { return mMode; }
    void setMode(int mode) override { mMode = mode; }
    std::string_view modeName(int mode) const override { return mode == 0 ? "guided" : "free"; }
    double speed() const override { return 0.03; }
    double clearanceNow() const override { return mClearance; }
    double rolled() const { return mRolled; }

private:
    const double& mClearance;
    Pose mPose;
    int mMode = 0;
    double mRolled = 0;
};

class ViewVolume : public testing::Test {
protected:
    ViewVolume() {
        mScene->makeFlight = [this] { return std::make_unique<Hover>(mClearance); };
        mScene->frames = &mFrames;
        mScene->way.method = mFrames.defaultMethod();
        mScene->stereo = {0.001, 0.03};
        mScene->largestSeparation = 0.004;
        mScene->surface.emplace();
        // The follower sets the eyes to a tenth of the free distance at once.
        mScene->makeFollower = [](const StereoSetting&) -> StereoFollower {
            return [](double free, double depth, double) { return StereoSetting{free / 10, depth}; };
        };
        VolumeFrame frame;
        frame.size = {40, 50, 60};
        frame.spacing = glm::dvec3(0.001);
        mStudy->grey = GreyVolume(frame);
        std::filesystem::create_directories(mFolder);
    }
    ~ViewVolume() override { std::filesystem::remove_all(mFolder); }
    ViewSession session() {
        return ViewSession(opened(*mScene), {OutputMode::SideBySide, std::nullopt, mFolder});
    }
    // Opens the slice view.
    void openSlices(ViewSession& s) {
        Pose at;
        at.position = {0.02, 0.03, 0.04};
        const_cast<Flight&>(s.flight()).setPose(at);
        s.act({ViewCommand::Slices});
        s.slices().show(mStudy);
        s.slices().picture(400, 400);
    }
    static ViewFrame frameOf(double depth) {
        ViewFrame frame;
        frame.left.resize(8, 8);
        frame.depthAhead = depth;
        return frame;
    }

    std::filesystem::path mFolder =  // folder for recorded flights
        std::filesystem::path(testing::TempDir()) / ("stereonav_volume_" + std::to_string(getpid()));
    double mClearance = 0.01;
    FakeFrames mFrames;
    std::shared_ptr<FakeParts> mScene = std::make_shared<FakeParts>();
    std::shared_ptr<SliceStudy> mStudy = std::make_shared<SliceStudy>();
};

constexpr double kFrameSeconds = 1.0 / 60;

TEST_F(ViewVolume, EyesFollowTheRoomUntilTheyAreSetByHand) {
    ViewSession s = session();
    EXPECT_TRUE(s.followsClearance());
    s.observe(frameOf(0.05));
    s.step({}, kFrameSeconds);
    EXPECT_DOUBLE_EQ(s.stereo().separation, 0.001);
    EXPECT_DOUBLE_EQ(s.stereo().zeroParallax, 0.05);
    mClearance = 0.02;
    s.step({}, kFrameSeconds);
    EXPECT_DOUBLE_EQ(s.stereo().separation, 0.002);
    EXPECT_TRUE(s.moving());
    s.act({ViewCommand::MoreSeparation});
    EXPECT_FALSE(s.followsClearance());
    mClearance = 0.005;
    for (int i = 0; i < 600; ++i) s.step({}, kFrameSeconds);
    EXPECT_NEAR(s.stereo().separation, 0.0022, 1e-6) << "by hand means by hand";
    EXPECT_DOUBLE_EQ(s.stereo().zeroParallax, 0.05);
    for (int i = 0; i < 100; ++i) s.act({ViewCommand::MoreSeparation});
    for (int i = 0; i < 600; ++i) s.step({}, kFrameSeconds);
    EXPECT_NEAR(s.stereo().separation, 0.004, 1e-6) << "what the flight keeps clear";
    s.act({ViewCommand::FollowClearance});
    EXPECT_TRUE(s.followsClearance());
    s.step({}, kFrameSeconds);
    EXPECT_DOUBLE_EQ(s.stereo().separation, 0.0005);
}

TEST_F(ViewVolume, FollowingKeepsTheParallaxComfortable) {
    ViewSession s = session();
    // The follower wants a millimetre; the picture's parallax is that of a wall at a fifth of the
    // zero-parallax distance: -6 % at a millimetre.
    double before = 0.001;
    for (int i = 0; i < 600; ++i) {
        ViewFrame frame = frameOf(0.05);
        frame.request.stereo = s.stereo();
        frame.nearParallax = -60 * s.stereo().separation;
        frame.farParallax = 10 * s.stereo().separation;
        s.observe(frame);
        s.step({}, kFrameSeconds);
        EXPECT_LE(s.stereo().separation, before * 1.0000001);
        EXPECT_GT(s.stereo().separation, before * 0.97) << "no jump";
        before = s.stereo().separation;
        EXPECT_TRUE(i < 599 || warningLine(frame).empty());
    }
    EXPECT_NEAR(s.stereo().separation, 0.95 * 0.025 / 60, 1e-6);
    // In a wide room the eyes get the whole separation again.
    for (int i = 0; i < 900; ++i) {
        ViewFrame frame = frameOf(0.05);
        frame.request.stereo = s.stereo();
        frame.nearParallax = -10 * s.stereo().separation;
        s.observe(frame);
        s.step({}, kFrameSeconds);
    }
    EXPECT_NEAR(s.stereo().separation, 0.001, 1e-6);
}

TEST_F(ViewVolume, EyesThatWereGivenAreNotMoved) {
    mScene->followsAtStart = false;
    ViewSession s = session();
    s.observe(frameOf(0.05));
    for (int i = 0; i < 60; ++i) s.step({}, kFrameSeconds);
    EXPECT_EQ(s.stereo().separation, 0.001);
    s.act({ViewCommand::FollowClearance});
    EXPECT_TRUE(s.followsClearance());
    mScene->makeFollower = nullptr;
    ViewSession none = session();
    none.act({ViewCommand::FollowClearance});
    EXPECT_FALSE(none.followsClearance());
}

TEST_F(ViewVolume, TextsSpeakMillimetres) {
    ViewFrame frame = frameOf(0.05);
    frame.request.stereo = {0.0013, 0.04};
    EXPECT_THAT(frameText(frame, 0), testing::HasSubstr("separation 1.3 mm  zero parallax 40.0 mm"));
    EXPECT_EQ(lengthText(0), "0.0 mm");
    EXPECT_EQ(lengthText(0.1), "0.10 m");
    EXPECT_EQ(lengthText(1250), "1.25 km");
}

TEST_F(ViewVolume, GuidedAndFreeFlightTakeTurns) {
    ViewSession s = session();
    s.act({ViewCommand::NextFlightMode});
    EXPECT_EQ(s.flight().mode(), 1);
    EXPECT_THAT(s.notice(), testing::HasSubstr("free"));
    s.act({ViewCommand::NextFlightMode});
    EXPECT_EQ(s.flight().mode(), 0);
    s.act({ViewCommand::NextFlightMode});
    s.act({ViewCommand::Reset});
    EXPECT_EQ(s.flight().mode(), 0);
}

TEST_F(ViewVolume, TheSurfaceMovesWhereThereIsOne) {
    ViewSession without = session();
    without.act({ViewCommand::HigherIsovalue});
    EXPECT_FALSE(without.surface().takeChange().has_value());
    mScene->surface->isovalue = 300;
    mScene->surface->isovalueStep = 10;
    ViewSession s = session();
    for (int i = 0; i < 3; ++i) s.act({ViewCommand::HigherIsovalue});
    s.act({ViewCommand::LowerIsovalue});
    const auto change = s.surface().takeChange();
    ASSERT_TRUE(change.has_value());
    EXPECT_EQ(change->surface.isovalue, 320);
    EXPECT_EQ(change->surface.translucent, false);
    EXPECT_FALSE(change->pieces.has_value());
    EXPECT_FALSE(s.surface().takeChange().has_value()) << "asked for once";
    // Keys that move the surface do not roll.
    FlightInput roll;
    roll.rollRate = 1;
    s.step(roll, kFrameSeconds);
    EXPECT_EQ(dynamic_cast<const Hover&>(s.flight()).rolled(), 0);
    without.step(roll, kFrameSeconds);
    EXPECT_GT(dynamic_cast<const Hover&>(without.flight()).rolled(), 0);
    // A change that failed is forgotten.
    s.surface().forgetChange();
    s.act({ViewCommand::HigherIsovalue});
    EXPECT_EQ(s.surface().takeChange()->surface.isovalue, 310);
}

TEST_F(ViewVolume, TranslucentAndBackKeepsTheSurface) {
    ViewSession s = session();
    s.act({ViewCommand::ToggleTranslucent});
    EXPECT_EQ(s.surface().takeChange()->surface.translucent, true);
    s.act({ViewCommand::ToggleTranslucent});
    EXPECT_EQ(s.surface().takeChange()->surface.translucent, false);
    mScene->surface.reset();
    ViewSession never = session();
    never.act({ViewCommand::ToggleTranslucent});
    EXPECT_FALSE(never.surface().takeChange().has_value());
}

TEST_F(ViewVolume, TransferFunctionsTakeTurns) {
    mScene->surface->transfers = {"", "bone", "glass"};
    const auto open = opened(*mScene);
    ViewSession s(open, {OutputMode::SideBySide, std::nullopt, mFolder});
    s.act({ViewCommand::NextTransfer});
    auto change = s.surface().takeChange();
    EXPECT_EQ(change->surface.translucent, true) << "first as it would be";
    EXPECT_EQ(change->surface.transfer, "");
    s.act({ViewCommand::NextTransfer});
    EXPECT_EQ(s.surface().takeChange()->surface.transfer, "bone");
    EXPECT_EQ(s.surface().now().transfer, "bone");
    // A function that can not be shown is not tried again at once.
    s.surface().forgetChange();
    EXPECT_EQ(s.surface().now().transfer, "");
    open->scene->offered<SurfaceChoices>()->translucent = true;
    s.surface().forgetChange();
    s.act({ViewCommand::NextTransfer});
    EXPECT_EQ(s.surface().takeChange()->surface.transfer, "glass");
    s.act({ViewCommand::NextTransfer});
    EXPECT_EQ(s.surface().takeChange()->surface.transfer, "");
}

TEST_F(ViewVolume, TransferFunctionsThatShowNothingAreLeftOut) {
    mScene->surface->transfers = {"", "bone", "glass", "metal"};
    mScene->surface->empty = {"bone", "metal"};
    mScene->surface->holds = "HU from -1000 to 40";
    mScene->surface->translucent = true;
    ViewSession s(opened(*mScene), {OutputMode::SideBySide, std::nullopt, mFolder});
    s.act({ViewCommand::NextTransfer});
    EXPECT_EQ(s.surface().takeChange()->surface.transfer, "glass");
    EXPECT_EQ(s.notice(), "transfer function: glass (bone left out: nothing of HU from -1000 to 40)");
    s.act({ViewCommand::NextTransfer});
    EXPECT_EQ(s.surface().takeChange()->surface.transfer, "");
    mScene->surface->empty = {"", "bone", "glass", "metal"};
    ViewSession none(opened(*mScene), {OutputMode::SideBySide, std::nullopt, mFolder});
    none.act({ViewCommand::NextTransfer});
    EXPECT_EQ(none.surface().takeChange()->surface.transfer, "") << "all of them: it stays";
}

TEST_F(ViewVolume, AmbientLightIsChosenByKeys) {
    ViewSession without = session();
    for (const ViewCommand command : {ViewCommand::NextAmbient, ViewCommand::LargerRadius,
                                      ViewCommand::NextModulation, ViewCommand::MoreSigma}) {
        without.act({command});
        EXPECT_FALSE(without.surface().takeChange().has_value());
        EXPECT_THAT(without.notice(), testing::HasSubstr("seen from outside"));
    }
    mScene->surface->ambient = AmbientChoice{false, "gaussian", 0.008, "", 0.008, 0};
    mScene->surface->ambientMethods = {"gaussian", "t-beta", "chebyshev"};
    mScene->surface->smallestRadius = 0.001;
    mScene->surface->largestRadius = 0.012;
    ViewSession s = session();
    s.act({ViewCommand::LargerRadius});
    EXPECT_FALSE(s.surface().takeChange().has_value()) << "of what?";
    s.act({ViewCommand::NextAmbient});
    EXPECT_EQ(s.surface().takeChange()->surface.ambient,
              (AmbientChoice{true, "gaussian", 0.008, "", 0.008, 0}));
    EXPECT_EQ(s.notice(), "ambient light gaussian within 8.0 mm");
    s.act({ViewCommand::NextAmbient});
    EXPECT_EQ(s.surface().takeChange()->surface.ambient->method, "t-beta");
    s.act({ViewCommand::PreviousAmbient});
    EXPECT_EQ(s.surface().takeChange()->surface.ambient->method, "gaussian");
    s.act({ViewCommand::LargerRadius});
    EXPECT_DOUBLE_EQ(s.surface().takeChange()->surface.ambient->radius, 0.01);
    s.act({ViewCommand::LargerRadius});
    s.act({ViewCommand::LargerRadius});
    EXPECT_DOUBLE_EQ(s.surface().takeChange()->surface.ambient->radius, 0.012);
    EXPECT_THAT(s.notice(), testing::HasSubstr("as large as it can be"));
    s.act({ViewCommand::PreviousAmbient});
    EXPECT_FALSE(s.surface().takeChange()->surface.ambient->lit);
    s.act({ViewCommand::PreviousAmbient});
    EXPECT_EQ(s.surface().takeChange()->surface.ambient->method, "chebyshev") << "round the other way";
    // There is no ambient light where light is baked.
    mScene->surface->ambientMethods.clear();
    ViewSession baked = session();
    baked.act({ViewCommand::NextAmbient});
    EXPECT_FALSE(baked.surface().takeChange().has_value());
}

TEST_F(ViewVolume, OpacityIsModulatedByKeys) {
    mScene->surface->ambient = AmbientChoice{false, "gaussian", 0.008, "", 0.008, 0};
    mScene->surface->smallestRadius = 0.001;
    mScene->surface->largestRadius = 0.1;
    mScene->surface->largestSigma = 500;
    mScene->surface->chosenSigma = 80;
    ViewSession s = session();
    s.act({ViewCommand::NextModulation});
    EXPECT_FALSE(s.surface().takeChange().has_value());
    EXPECT_THAT(s.notice(), testing::HasSubstr("translucent"));
    s.act({ViewCommand::ToggleTranslucent});
    s.act({ViewCommand::NextModulation});
    auto change = s.surface().takeChange();
    EXPECT_EQ(change->surface.translucent, true);
    EXPECT_EQ(change->surface.ambient->modulate, "variance");
    EXPECT_EQ(change->surface.ambient->sigma, 0) << "chosen";
    s.act({ViewCommand::MoreSigma});
    EXPECT_EQ(s.notice(), "opacity by variance within 8.0 mm, whole from 100");
    EXPECT_DOUBLE_EQ(s.surface().takeChange()->surface.ambient->sigma, 100);
    s.act({ViewCommand::LessSigma});
    EXPECT_DOUBLE_EQ(s.surface().takeChange()->surface.ambient->sigma, 80);
    for (int n = 0; n < 20; ++n) s.act({ViewCommand::MoreSigma});
    EXPECT_DOUBLE_EQ(s.surface().takeChange()->surface.ambient->sigma, 500);
    s.act({ViewCommand::LargerRadius});
    change = s.surface().takeChange();
    EXPECT_DOUBLE_EQ(change->surface.ambient->modulateRadius, 0.01);
    EXPECT_DOUBLE_EQ(change->surface.ambient->radius, 0.008) << "ambient light's own";
    s.act({ViewCommand::NextModulation});
    change = s.surface().takeChange();
    EXPECT_EQ(change->surface.ambient->modulate, "gradient");
    EXPECT_EQ(change->surface.ambient->sigma, 0);
    for (int n = 0; n < 30; ++n) s.act({ViewCommand::MoreSigma});
    EXPECT_DOUBLE_EQ(s.surface().takeChange()->surface.ambient->sigma, 1);
    s.act({ViewCommand::NextModulation});
    EXPECT_EQ(s.surface().takeChange()->surface.ambient->modulate, "");
}

// Keys during an earlier change start from what was asked for, not from what is shown.
TEST_F(ViewVolume, NoStepIsLostWhileScenesAreMade) {
    mScene->surface->isovalue = 300;
    mScene->surface->isovalueStep = 10;
    ViewSession s = session();
    s.act({ViewCommand::HigherIsovalue});
    EXPECT_EQ(s.surface().takeChange()->surface.isovalue, 310);
    s.act({ViewCommand::HigherIsovalue});
    EXPECT_EQ(s.surface().takeChange()->surface.isovalue, 320);
    auto first = std::make_shared<FakeParts>(*mScene);
    first->surface->isovalue = 310;
    first->changed = true;
    s.replaceScene(opened(*first));
    s.act({ViewCommand::HigherIsovalue});
    EXPECT_EQ(s.surface().takeChange()->surface.isovalue, 330);
    // A change that fails is forgotten: the shown state counts again.
    s.surface().forgetChange();
    s.act({ViewCommand::HigherIsovalue});
    EXPECT_EQ(s.surface().takeChange()->surface.isovalue, 320);
}

// A scene that was made from the one before it: playing goes on, and the chosen method of the right eye
// stays.
TEST_F(ViewVolume, WhatWasChangedInPlaceGoesOn) {
    ViewSession s = session();
    s.act({ViewCommand::Record});
    FlightInput forward;
    forward.forward = 1;
    for (int i = 0; i < 60; ++i) s.step(forward, 1.0 / 60);
    s.act({ViewCommand::Play});
    s.act({ViewCommand::NextMethod});
    const std::string_view method = s.requestFor(100, 100).way.method;
    EXPECT_NE(method, mScene->way.method);
    s.step({}, 0.1);
    auto other = std::make_shared<FakeParts>(*mScene);
    other->changed = true;
    s.replaceScene(opened(*other));
    EXPECT_TRUE(s.paths().playing());
    EXPECT_EQ(s.requestFor(100, 100).way.method, method);
    other = std::make_shared<FakeParts>(*mScene);
    other->changed = true;
    other->way.method = "selective";
    s.replaceScene(opened(*other));
    EXPECT_EQ(s.requestFor(100, 100).way.method, "selective") << "another default";
    s.replaceScene(opened(*mScene));
    EXPECT_FALSE(s.paths().playing());
}

TEST_F(ViewVolume, AnotherSceneTakesThePlaceAndTheFlightGoesOn) {
    ViewSession s = session();
    s.act({ViewCommand::NextFlightMode});
    FlightInput forward;
    forward.forward = 1;
    for (int i = 0; i < 60; ++i) s.step(forward, kFrameSeconds);
    const glm::dvec3 here = s.pose().position;
    EXPECT_GT(here.x, 0.02);
    const StereoSetting eyes = s.stereo();
    const long long version = s.requestFor(100, 100).version;
    auto other = std::make_shared<FakeParts>(*mScene);
    other->way.method = "depthsplat";
    other->surface->translucent = true;
    s.replaceScene(opened(*other));
    EXPECT_EQ(s.pose().position, here);
    EXPECT_EQ(s.flight().mode(), 1);
    EXPECT_EQ(s.stereo().separation, eyes.separation);
    EXPECT_GT(s.requestFor(100, 100).version, version) << "it must be drawn, though nothing moved";
    EXPECT_EQ(s.requestFor(100, 100).way.method, "depthsplat");
    s.act({ViewCommand::ToggleTranslucent});
    EXPECT_EQ(s.surface().takeChange()->surface.translucent, false) << "from what is shown now";
}

TEST_F(ViewVolume, SlicesAreReadOnceAndLeftByEscape) {
    ViewSession without = session();
    without.act({ViewCommand::Slices});
    EXPECT_FALSE(without.slices().takeStudyWish()) << "a scene without slices";
    EXPECT_FALSE(without.slices().shown());
    mScene->readSlices = [this](Progress&) { return mStudy; };
    ViewSession s = session();
    s.act({ViewCommand::Slices});
    EXPECT_TRUE(s.slices().takeStudyWish());
    EXPECT_FALSE(s.slices().takeStudyWish());
    s.slices().show(mStudy);
    EXPECT_TRUE(s.slices().shown());
    s.act({ViewCommand::Back});
    EXPECT_FALSE(s.slices().shown());
    s.act({ViewCommand::Slices});
    EXPECT_TRUE(s.slices().shown()) << "kept";
    EXPECT_FALSE(s.slices().takeStudyWish());
    s.act({ViewCommand::Back});
    EXPECT_FALSE(s.slices().shown());
}

TEST_F(ViewVolume, PagesTurnWithinTheStudy) {
    ViewSession s = session();
    openSlices(s);
    EXPECT_THAT(s.slices().status(), testing::HasSubstr("axial slice 41 of 60"));
    s.act({ViewCommand::NextSlice});
    EXPECT_THAT(s.slices().status(), testing::HasSubstr("slice 42 of 60, z = 41.0 mm"));
    s.turnWheel(2);
    EXPECT_THAT(s.slices().status(), testing::HasSubstr("slice 41 "));
    for (int i = 0; i < 100; ++i) s.act({ViewCommand::PreviousSlice});
    EXPECT_THAT(s.slices().status(), testing::HasSubstr("slice 1 of 60"));
    for (int i = 0; i < 100; ++i) s.turnWheel(-1);
    EXPECT_THAT(s.slices().status(), testing::HasSubstr("slice 60 of 60"));
    s.act({ViewCommand::Slices});
    EXPECT_THAT(s.slices().status(), testing::HasSubstr("coronal slice 31 of 50"));
    s.act({ViewCommand::Slices});
    EXPECT_THAT(s.slices().status(), testing::HasSubstr("sagittal slice 21 of 40"));
    const long long version = s.slices().version();
    s.slices().picture(400, 400);
    EXPECT_EQ(s.slices().version(), version + 1);
    s.slices().picture(400, 400);
    EXPECT_EQ(s.slices().version(), version + 1) << "nothing changed, nothing is drawn";
    s.slices().picture(300, 400);
    EXPECT_EQ(s.slices().version(), version + 2);
}

TEST(ViewPlaces, ClicksLieInTheEyeThatIsShownThere) {
    EXPECT_EQ(placeInEye(OutputLayout::SideBySide, {0.25, 0.3}), glm::dvec2(0.5, 0.3));
    EXPECT_EQ(placeInEye(OutputLayout::SideBySide, {0.75, 0.3}), glm::dvec2(0.5, 0.3));
    EXPECT_EQ(placeInEye(OutputLayout::TopBottom, {0.25, 0.75}), glm::dvec2(0.25, 0.5));
    const auto packed = [](int row) { return placeInEye(OutputLayout::FramePacked, {0.25, row / 2205.0}); };
    EXPECT_NEAR(packed(540).y, 0.5, 1e-6);
    EXPECT_NEAR(packed(1125 + 540).y, 0.5, 1e-6);
    EXPECT_NEAR(packed(1100).y, 1, 1e-6) << "in the gap";
    EXPECT_NEAR(packed(2205).y, 1, 1e-6);
    EXPECT_EQ(packed(540).x, 0.25);
    EXPECT_EQ(placeInEye(OutputLayout::Anaglyph, {0.25, 0.75}), glm::dvec2(0.25, 0.75));
}

}  // namespace
}  // namespace stereonav
