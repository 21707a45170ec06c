// The viewer's logic without a window: settings move slowly, all modes can be reached, flights are recorded
// and played, parallax is checked.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <set>

#include "app/view/live_settings.h"
#include "app/view/session.h"
#include "app/view/status.h"
#include "engine/base/error.h"
#include "tests/view/session_fixture.h"

namespace stereonav {
namespace {

class ViewSessionTest : public SessionFixture {};

constexpr double kFrame = 1.0 / 60;

TEST_F(ViewSessionTest, SeparationMovesSlowlyToItsTarget) {
    ViewSession s = session();
    s.act({ViewCommand::MoreSeparation});
    double before = s.stereo().separation;
    EXPECT_EQ(before, 20.0) << "nothing jumps";
    for (int i = 0; i < 240; ++i) {
        s.step({}, kFrame);
        EXPECT_GE(s.stereo().separation, before);
        EXPECT_LT(s.stereo().separation / before, 1.01) << "a step at 60 Hz";
        before = s.stereo().separation;
    }
    EXPECT_DOUBLE_EQ(before, 22.0);
    EXPECT_FALSE(s.moving()) << "and then rests";
    for (int i = 0; i < 200; ++i) s.act({ViewCommand::MoreSeparation});
    for (int i = 0; i < 600; ++i) s.step({}, kFrame);
    EXPECT_LE(s.stereo().separation, 0.25 * 600 * 1.0001);
    for (int i = 0; i < 200; ++i) s.act({ViewCommand::LessSeparation});
    for (int i = 0; i < 600; ++i) s.step({}, kFrame);
    EXPECT_EQ(s.stereo().separation, 0.0);
    s.act({ViewCommand::MoreSeparation});
    for (int i = 0; i < 600; ++i) s.step({}, kFrame);
    EXPECT_GT(s.stereo().separation, 0.0) << "none is not for ever";
}

TEST_F(ViewSessionTest, EyesThatFitAPictureOfAnotherShapeAreNotTaken) {
    ViewSession s = session();
    ViewFrame wide = frameWith(-0.0095, 0.019);
    wide.request = s.requestFor(2560, 720);
    ASSERT_TRUE(wide.request.fitEyes);
    wide.request.stereo = {11, 390};
    // Panels were opened before that frame came.
    EXPECT_TRUE(s.requestFor(1600, 720).fitEyes);
    s.observe(wide);
    EXPECT_EQ(s.stereo().separation, 20);
    EXPECT_TRUE(s.requestFor(1600, 720).fitEyes) << "they are still to be fitted";
    ViewFrame narrow = wide;
    narrow.request = s.requestFor(1600, 720);
    narrow.request.stereo = {7, 390};
    s.observe(narrow);
    EXPECT_EQ(s.stereo().separation, 7);
    EXPECT_FALSE(s.requestFor(1600, 720).fitEyes);
}

TEST_F(ViewSessionTest, EyesAreSetBackToWhatTheWindowBeganWith) {
    ViewSession s = session();
    ViewFrame first = frameWith(-0.0095, 0.019);
    first.request.fitEyes = true;
    first.request.stereo = {11, 390};
    s.observe(first);
    const auto said = [&](const char* key) { return withLive(s, {}).contains(key); };
    EXPECT_FALSE(said("separation") || said("zero-parallax")) << "nobody set them";
    setLive(s, "separation", "30");
    EXPECT_TRUE(said("separation"));
    EXPECT_TRUE(said("zero-parallax")) << "given one alone, the other would be the scene's own";
    setLive(s, "zero-parallax", "777.77");
    setLive(s, "separation", std::nullopt);
    EXPECT_EQ(s.eyesWanted().separation, 11);
    EXPECT_EQ(s.eyesWanted().zeroParallax, 777.77);
    setLive(s, "zero-parallax", std::nullopt);
    EXPECT_EQ(s.eyesWanted().zeroParallax, 390);
    EXPECT_FALSE(said("separation") || said("zero-parallax"));
}

TEST_F(ViewSessionTest, TheSlowChangeDoesNotDependOnTheFrameRate) {
    ViewSession fine = session(), coarse = session();
    fine.act({ViewCommand::FartherZeroParallax});
    coarse.act({ViewCommand::FartherZeroParallax});
    for (int i = 0; i < 30; ++i) fine.step({}, 0.01);
    coarse.step({}, 0.3);
    EXPECT_NEAR(fine.stereo().zeroParallax, coarse.stereo().zeroParallax, 1e-9);
    EXPECT_GT(coarse.stereo().zeroParallax, 600.0);
    EXPECT_LT(coarse.stereo().zeroParallax, 660.0);
}

TEST_F(ViewSessionTest, EveryModeIsReachedByStepping) {
    ViewSession s = session();
    std::set<OutputMode> seen;
    const auto pictures = std::count_if(outputModes().begin(), outputModes().end(),
                                        [](const OutputModeInfo& info) { return fitsInPicture(info.mode); });
    for (int i = 0; i < pictures; ++i) {
        seen.insert(s.compose().mode);
        s.act({ViewCommand::NextMode});
    }
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(pictures)) << "all but those of shutter glasses";
    EXPECT_EQ(s.compose().mode, OutputMode::SideBySide) << "and round again";
    s.act({ViewCommand::PreviousMode});
    EXPECT_EQ(s.compose().mode, OutputMode::Right);
    s.act({ViewCommand::SetMode, OutputMode::Checkerboard});
    s.act({ViewCommand::SwapEyes});
    EXPECT_EQ(s.compose().mode, OutputMode::Checkerboard);
    EXPECT_TRUE(s.compose().swapEyes);
    s.act({ViewCommand::LinearAnaglyph});
    EXPECT_TRUE(s.compose().linearAnaglyph);
    s.act({ViewCommand::ToggleStereo});
    EXPECT_EQ(s.compose().mode, OutputMode::Left);
    EXPECT_FALSE(s.compose().swapEyes);
    EXPECT_FALSE(s.requestFor(100, 100).twoEyes);
    s.act({ViewCommand::Reset});
    EXPECT_EQ(s.compose().mode, OutputMode::SideBySide);
    EXPECT_TRUE(s.requestFor(100, 100).twoEyes);
    EXPECT_EQ(s.compose(), (ComposeSetting{OutputMode::SideBySide, false, false}));
}

// The window begins so where no mode was given or kept.
TEST_F(ViewSessionTest, OneEyeIsShownAtFirstAndAfterReset) {
    ViewSession s(opened(*mScene),
                  {OutputMode::SideBySide, std::nullopt, mFolder, false, false, false, false});
    const auto shows = [&](OutputMode mode, bool two) {
        EXPECT_EQ(s.compose().mode, mode);
        EXPECT_EQ(s.stereoOn(), two);
        EXPECT_EQ(s.requestFor(100, 100).twoEyes, two) << "nothing is cast for an eye that is not shown";
    };
    shows(OutputMode::Left, false);
    EXPECT_FALSE(withLive(s, {}).contains("mode")) << "the command line of what is seen";
    s.act({ViewCommand::ToggleStereo});
    shows(OutputMode::SideBySide, true);
    EXPECT_EQ(withLive(s, {}).at("mode"), std::vector<std::string>{"sbsl"});
    s.act({ViewCommand::Reset});
    shows(OutputMode::Left, false);
    s.act({ViewCommand::NextMode});
    shows(OutputMode::SideBySide, true);
    s.chooseMode(OutputMode::RedCyanDubois);
    shows(OutputMode::RedCyanDubois, true);
    s.act({ViewCommand::ToggleStereo});
    shows(OutputMode::Left, false);
    s.act({ViewCommand::ToggleStereo});
    shows(OutputMode::RedCyanDubois, true);
    setLive(s, "mode", std::nullopt);
    shows(OutputMode::Left, false);
    EXPECT_EQ(s.shownMode(), s.firstMode());
}

TEST_F(ViewSessionTest, TheKeyForStereoLeavesTheLeftEyeAlone) {
    ViewSession s = session();
    s.act({ViewCommand::SetMode, OutputMode::Left});
    EXPECT_FALSE(s.stereoOn());
    s.act({ViewCommand::ToggleStereo});
    EXPECT_EQ(s.compose().mode, OutputMode::SideBySide);
    EXPECT_TRUE(s.stereoOn());
}

TEST_F(ViewSessionTest, ModesOfShutterGlassesAreReachedWhereTheWindowBeganSo) {
    ViewSession s(opened(*mScene), {OutputMode::Alternating, std::nullopt, mFolder});
    s.act({ViewCommand::NextMode});
    EXPECT_EQ(s.compose().mode, OutputMode::Left);
    s.act({ViewCommand::PreviousMode});
    EXPECT_EQ(s.compose().mode, OutputMode::Alternating);
    s.act({ViewCommand::SetMode, OutputMode::AlternatingRightFirst});
    EXPECT_EQ(s.compose().mode, OutputMode::AlternatingRightFirst);
    s.act({ViewCommand::SetMode, OutputMode::QuadBuffer});
    EXPECT_EQ(s.compose().mode, OutputMode::AlternatingRightFirst) << "the window has no quad buffer";
    EXPECT_THAT(s.notice(), testing::HasSubstr("--mode quad"));
    ViewSession quad(opened(*mScene), {OutputMode::Left, std::nullopt, mFolder, true});
    quad.act({ViewCommand::SetMode, OutputMode::QuadBuffer});
    EXPECT_EQ(quad.compose().mode, OutputMode::QuadBuffer);
}

TEST_F(ViewSessionTest, RequestsAskForEyesThatFillTheWindow) {
    ViewSession s = session();
    FrameRequest r = s.requestFor(1280, 720);
    EXPECT_EQ(std::pair(r.lens.width, r.lens.height), std::pair(640, 720));
    const long long version = r.version;
    EXPECT_EQ(s.requestFor(1280, 720).version, version) << "nothing changed, nothing to render";
    s.act({ViewCommand::SetMode, OutputMode::SideBySideHalf});
    r = s.requestFor(1280, 720);
    EXPECT_EQ(std::pair(r.lens.width, r.lens.height), std::pair(1280, 720));
    EXPECT_GT(r.version, version);
    s.act({ViewCommand::SetMode, OutputMode::TopBottom});
    r = s.requestFor(1280, 721);
    EXPECT_EQ(std::pair(r.lens.width, r.lens.height), std::pair(1280, 360));
}

TEST_F(ViewSessionTest, PlaysTheScenesFlightOnItsOwnClock) {
    ViewSession s = session();
    s.act({ViewCommand::Play});
    for (int i = 0; i < 4; ++i) s.step({}, 0.25);
    EXPECT_NEAR(s.pose().position.x, 50.0, 1e-9) << "half of 2 s, whatever the frame rate";
    s.act({ViewCommand::Play});
    EXPECT_FALSE(s.paths().playing());
    EXPECT_NEAR(s.pose().position.x, 50.0, 1e-6) << "stopping stays there";
}

TEST_F(ViewSessionTest, ParallaxBeyondTheBudgetIsSaid) {
    EXPECT_EQ(warningLine(frameWith(-0.01, 0.015)), "");
    EXPECT_THAT(warningLine(frameWith(-0.015, 0.02)), testing::HasSubstr("3.5 %"));
    EXPECT_THAT(warningLine(frameWith(-0.03, -0.01)), testing::HasSubstr("before the screen"));
    EXPECT_THAT(warningLine(frameWith(0.03, 0.05)), testing::HasSubstr("behind the screen"));
    ViewFrame oneEye = frameWith(-0.5, 0.5);
    oneEye.request.twoEyes = false;
    EXPECT_EQ(warningLine(oneEye), "");
    EXPECT_EQ(comfortReading(oneEye).state, ComfortState::Comfortable);
    // A meter shows short excursions, too.
    const ComfortReading reading = comfortReading(frameWith(-0.015, 0.014));
    EXPECT_EQ(reading.state, ComfortState::Excursion);
    EXPECT_EQ(reading.near, -0.015);
    EXPECT_EQ(reading.far, 0.014);
    EXPECT_NEAR(reading.range, 0.029, 1e-12);
    EXPECT_THAT(reading.advice, testing::HasSubstr("short time"));
    EXPECT_EQ(warningLine(frameWith(-0.015, 0.014)), "");
    EXPECT_THAT(comfortReading(frameWith(0.01, 0.03)).advice, testing::HasSubstr("behind the screen"));
    EXPECT_EQ(comfortReading(frameWith(-0.01, 0.015)).advice, "");
}

TEST_F(ViewSessionTest, TheFramesTextHoldsItsFigures) {
    ViewFrame frame = frameWith(-0.01, 0.015);
    frame.timings.left_ms = 3.14;
    const std::string line = frameText(frame, 24.04);
    for (const char* part : {"24.0 fps", "left 3.1 ms", "warp 0.4 ms", "fill 0.3 ms", "holes 7.0 %",
                             "separation 20.0 m", "zero parallax 600 m", "-1.0 to +1.5 %"})
        EXPECT_THAT(line, testing::HasSubstr(part));
    EXPECT_THAT(frameText(frame, 0), testing::StartsWith("left 3.1 ms")) << "no rate is known yet";
}

TEST_F(ViewSessionTest, TheErrorIsOfWhatIsShown) {
    ViewSession s = session();
    ViewFrame frame = frameWith(-0.01, 0.015);
    frame.request.version = 4;
    EXPECT_EQ(s.measuredText(frame), "");
    s.observe(FrameTruth{3, {50.0, 9, 0.1}, 1, ""});
    EXPECT_EQ(s.measuredText(frame), "") << "of another frame";
    s.observe(FrameTruth{4, {52.34, 41, 0.061}, 1, ""});
    EXPECT_EQ(s.measuredText(frame), "error 52.3 dB, 41 of 255 at most, in 6.1 % of the right eye");
    s.observe(FrameTruth{4, {}, 0, "one eye is shown"});
    EXPECT_EQ(s.measuredText(frame), "");
    // The choice of what the right eye shows is part of the request.
    const long long before = s.requestFor(640, 360).version;
    s.setTruth(TruthView::Difference);
    EXPECT_EQ(s.requestFor(640, 360).truth, TruthView::Difference);
    EXPECT_EQ(s.requestFor(640, 360).version, before + 1);
}

TEST_F(ViewSessionTest, AFlightComesToRestExactly) {
    ViewSession s = session();
    FlightInput input;
    input.forward = 1;
    input.yawRate = 0.5;
    for (int i = 0; i < 60; ++i) s.step(input, kFrame);
    EXPECT_TRUE(s.moving());
    for (int i = 0; i < 1200; ++i) s.step({}, kFrame);
    EXPECT_FALSE(s.moving());
    const long long version = s.requestFor(100, 100).version;
    for (int i = 0; i < 60; ++i) s.step({}, kFrame);
    EXPECT_EQ(s.requestFor(100, 100).version, version);
    s.act({ViewCommand::Screenshot});
    s.step({}, kFrame);
    EXPECT_EQ(s.requestFor(100, 100).version, version) << "what is left of the motion stays where it is";
    s.look(0.1, 0);
    s.step({}, kFrame);
    EXPECT_TRUE(s.moving());
    EXPECT_GT(s.requestFor(100, 100).version, version);
}

TEST_F(ViewSessionTest, APathThatIsWorkedOnTakesOneStepBack) {
    ViewSession s = session();
    const long long first = s.paths().version();
    const RecordedPath own = s.paths().path();
    const auto lasting = [](double seconds) {
        return RecordedPath({{0, kStart}, {seconds, poseFromAngles({9, 9, 600}, 0, 0, 0)}}, "test");
    };
    s.paths().edit([&](const RecordedPath&) { return lasting(3); });
    const long long edited = s.paths().version();
    EXPECT_NE(edited, first);
    s.act({ViewCommand::Play});
    s.paths().set(lasting(5));
    s.paths().set(lasting(7));
    EXPECT_FALSE(s.paths().playing());
    EXPECT_EQ(s.paths().path().duration(), 7);
    EXPECT_NE(s.paths().version(), edited);
    s.paths().undo();
    EXPECT_EQ(s.paths().path().duration(), own.duration()) << "what was there before it was worked on";
    s.paths().edit(
        [](const RecordedPath&) -> RecordedPath { throw Error("", "path", "is not so", "change it"); });
    EXPECT_THAT(s.notice(), testing::HasSubstr("is not so"));
    EXPECT_EQ(s.paths().path().duration(), own.duration());
}

// Flies north at full input towards a wall there, and returns the times at which the distance has halved
// again. The distance ahead is given with every step.
std::vector<double> timesOfHalving(ViewSession& s, double wall, double first, int count) {
    FlightInput forward;
    forward.forward = 1;
    std::vector<double> times;
    double time = 0, next = first;
    while (static_cast<int>(times.size()) < count && time < 120) {
        ViewFrame frame;
        frame.depthAhead = wall - s.pose().position.y;
        s.observe(frame);
        s.step(forward, kFrame);
        time += kFrame;
        if (wall - s.pose().position.y > next) continue;
        times.push_back(time);
        next /= 2;
    }
    return times;
}

TEST_F(ViewSessionTest, TowardsAWallEveryHalvingTakesAsLong) {
    ViewSession s = session();
    s.goTo(poseFromAngles({0, 0, 500}, 0, 0, 0));
    EXPECT_FALSE(s.moves().speedByDistance());
    s.act({ViewCommand::SpeedByDistance});
    EXPECT_TRUE(s.moves().speedByDistance());
    const std::vector<double> times = timesOfHalving(s, 5000, 1600, 6);
    ASSERT_EQ(times.size(), 6u);
    const double halving = times[1] - times[0];
    EXPECT_GT(halving, 1.5);
    EXPECT_LT(halving, 4);
    for (std::size_t n = 2; n < times.size(); ++n)
        EXPECT_NEAR(times[n] - times[n - 1], halving, 0.05 * halving) << n;
    // At a constant speed this is not the case.
    ViewSession even = session();
    even.goTo(poseFromAngles({0, 0, 500}, 0, 0, 0));
    const std::vector<double> others = timesOfHalving(even, 5000, 1600, 4);
    ASSERT_EQ(others.size(), 4u);
    EXPECT_NEAR(others[2] - others[1], (others[1] - others[0]) / 2, 0.1);
}

TEST_F(ViewSessionTest, TheSpeedByDistanceHasNoJumpsAndBounds) {
    ViewSession s = session();
    const double usual = s.moves().speed();
    s.act({ViewCommand::SpeedByDistance});
    const auto after = [&](double depth, double seconds) {
        ViewFrame frame;
        frame.depthAhead = depth;
        s.observe(frame);
        for (double time = 0; time < seconds; time += kFrame) s.step({}, kFrame);
        return s.moves().speed();
    };
    EXPECT_EQ(after(0, 1), usual) << "no frame has told yet";
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double sky : {infinity, std::nan("")}) EXPECT_EQ(after(sky, 5), usual);
    EXPECT_NEAR(after(400, 10), 100, 0.2);
    // A silhouette passes: from 400 m to 8 m and back.
    EXPECT_GT(after(8, kFrame / 2), 0.85 * 100);
    EXPECT_NEAR(after(1e-9, 10), 0.02 * usual, 1e-3 * usual);
    EXPECT_NEAR(after(1e300, 10), 4 * usual, 0.02 * usual);
    s.turnWheel(1);
    EXPECT_NEAR(after(1e300, 10), 1.2 * 4 * usual, 0.02 * usual) << "the wheel's is a factor";
    s.act({ViewCommand::SpeedByDistance});
    EXPECT_LT(after(1e300, 10), 1.21 * usual);
}

TEST_F(ViewSessionTest, TheSkyAndAPlayedFlightKnowNoDistance) {
    ViewSession near = session(), usual = session();
    near.act({ViewCommand::SpeedByDistance});
    ViewFrame frame;
    frame.depthAhead = std::numeric_limits<double>::infinity();
    FlightInput forward;
    forward.forward = 1;
    for (int i = 0; i < 60; ++i) {
        near.observe(frame);
        near.step(forward, kFrame);
        usual.step(forward, kFrame);
    }
    EXPECT_EQ(near.pose().position, usual.pose().position) << "over the sky";
    frame.depthAhead = 0.01;
    near.observe(frame);
    near.act({ViewCommand::Play});
    usual.act({ViewCommand::Play});
    for (int i = 0; i < 60; ++i) {
        near.step({}, kFrame);
        usual.step({}, kFrame);
    }
    EXPECT_TRUE(near.paths().playing());
    EXPECT_EQ(near.pose().position, usual.pose().position);
}

TEST_F(ViewSessionTest, ScreenshotsAreWishedOnceEach) {
    ViewSession s = session();
    EXPECT_FALSE(s.takeScreenshotWish());
    s.act({ViewCommand::Screenshot});
    EXPECT_TRUE(s.takeScreenshotWish());
    EXPECT_FALSE(s.takeScreenshotWish());
}

TEST_F(ViewSessionTest, TheSunMovesWhereLightIsBaked) {
    ViewSession without = session();
    const long long before = without.requestFor(640, 360).version;
    without.act({ViewCommand::HigherSun});
    EXPECT_EQ(without.requestFor(640, 360).version, before) << "nothing to light";
    EXPECT_THAT(without.notice(), testing::HasSubstr("baked"));
    mScene->moveSun = [](const SunPlace&) {};
    mScene->sun = {0.02, 1.5};
    ViewSession moving = session();
    const FrameRequest first = moving.requestFor(640, 360);
    EXPECT_EQ(first.sun, mScene->sun);
    moving.act({ViewCommand::SunAnticlockwise});
    const FrameRequest turned = moving.requestFor(640, 360);
    EXPECT_GT(turned.version, first.version);
    EXPECT_NEAR(turned.sun.azimuth, 0.02 + 2 * std::numbers::pi - 3 * std::numbers::pi / 180, 1e-9);
    for (int k = 0; k < 300; ++k) moving.act({ViewCommand::HigherSun});
    EXPECT_NEAR(moving.requestFor(640, 360).sun.elevation, std::numbers::pi / 2, 1e-9);
    for (int k = 0; k < 300; ++k) moving.act({ViewCommand::LowerSun});
    EXPECT_NEAR(moving.requestFor(640, 360).sun.elevation, -0.15, 1e-9);
}

TEST_F(ViewSessionTest, TheSkyTurnsAndTilts) {
    mScene->moveSun = [](const SunPlace&) {};
    mScene->turnsSky = true;
    ViewSession s = session();
    for (int k = 0; k < 10; ++k) s.act({ViewCommand::SunAnticlockwise});
    EXPECT_THAT(s.notice(), testing::HasSubstr("turned by 30 degrees, tilted by 0")) << "as --turn counts";
    for (int k = 0; k < 20; ++k) s.act({ViewCommand::SunClockwise});
    EXPECT_THAT(s.notice(), testing::HasSubstr("turned by -30 degrees"));
    for (int k = 0; k < 300; ++k) s.act({ViewCommand::LowerSun});
    EXPECT_NEAR(s.requestFor(640, 360).sun.elevation, -std::numbers::pi / 2, 1e-9);
    for (int k = 0; k < 300; ++k) s.act({ViewCommand::HigherSun});
    EXPECT_NEAR(s.requestFor(640, 360).sun.elevation, std::numbers::pi / 2, 1e-9);
    // Another surface of the same study keeps it; one with another light does not.
    const SunPlace turned = s.requestFor(640, 360).sun;
    s.replaceScene(opened(*mScene));
    EXPECT_EQ(s.requestFor(640, 360).sun, turned);
    s.act({ViewCommand::Reset});
    EXPECT_EQ(s.requestFor(640, 360).sun, mScene->sun);
    s.act({ViewCommand::SunClockwise});
    auto other = std::make_shared<FakeParts>(*mScene);
    other->moveSun = nullptr;
    other->lightStays = "stays for this reason";
    s.replaceScene(opened(*other));
    EXPECT_EQ(s.requestFor(640, 360).sun, mScene->sun);
    s.act({ViewCommand::SunClockwise});
    EXPECT_EQ(s.notice(), "stays for this reason");
}

}  // namespace
}  // namespace stereonav
