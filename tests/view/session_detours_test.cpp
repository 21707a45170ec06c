// Settings there and back: the session is then as if nothing had been touched, paths come back one by one,
// and requests from before a change are not taken after it.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/view/live_settings.h"
#include "app/view/session.h"
#include "engine/base/error.h"
#include "engine/nav/navigator.h"
#include "tests/support/plain_steps.h"
#include "tests/view/fake_frames.h"
#include "tests/view/fake_scene.h"

namespace stereonav {
namespace {

RecordedPath lasting(double seconds) {
    return RecordedPath({{0, poseFromAngles({0, 0, 500}, 0, 0, 0)},
                         {seconds, poseFromAngles({10 * seconds, 0, 500}, 0, 0, 0)}},
                        "test");
}

// Returns a scene with all settings that can be set at once.
FakeParts richScene() {
    FakeParts scene;
    scene.makeFlight = []() -> std::unique_ptr<Flight> {
        return std::make_unique<Navigator>([](const glm::dvec2&) { return 0.0; },
                                           poseFromAngles({0, 0, 500}, 0, -0.1, 0), FlightSetting{});
    };
    static FakeFrames frames;
    scene.frames = &frames;
    scene.way.method = frames.defaultMethod();
    scene.path = lasting(2);
    scene.stereo = {20, 600};
    scene.lens.verticalFov = 0.8;
    scene.moveSun = [](const SunPlace&) {};
    scene.sun = {1.0, 0.5};
    scene.surface.emplace();
    scene.surface->isovalue = 100;
    scene.surface->isovalueStep = 10;
    scene.surface->transfers = {"", "tissue", "bone"};
    scene.surface->ambient = AmbientChoice{false, "gaussian", 0.008, "", 0.008, 0};
    scene.surface->ambientMethods = {"gaussian", "t-beta"};
    scene.surface->smallestRadius = 0.001;
    scene.surface->largestRadius = 0.1;
    scene.surface->largestSigma = 500;
    scene.surface->chosenSigma = 80;
    scene.values.emplace();
    scene.values->begun.isovalue = 100;
    scene.values->begun.isovalueChosen = true;
    scene.values->begun.opacity = 0.95;
    return scene;
}

class NoPaint final : public EyePainter {
public:
    void paint(const EyeView&, EyeImage&) const override {}
};

class SessionDetours : public testing::Test {
protected:
    static ViewSession sessionOf(const FakeParts& parts) {
        return ViewSession(opened(parts), {OutputMode::SideBySide, std::nullopt, "."});
    }
    // Returns a text with the whole request for a frame and all settings.
    static std::string told(ViewSession& s) {
        const FrameRequest r = s.requestFor(640, 360);
        const ComposeSetting c = s.compose();
        std::string text = fmt::format(
            "{} {} {} {} {} {} {} {:.9g} {:.9g} {} {} {} {} {} {} {} {} {}", r.lens.width, r.lens.height,
            r.lens.verticalFov, r.stereo.separation, r.stereo.zeroParallax, r.way.method, r.model,
            r.sun.azimuth, r.sun.elevation, r.twoEyes, static_cast<int>(r.mode), static_cast<int>(r.truth),
            static_cast<int>(c.mode), c.swapEyes, c.linearAnaglyph, r.paintOver != nullptr, s.eyes().clamp(),
            s.followsClearance());
        const SurfaceChange surface = s.surface().now();
        const bool translucent = surface.translucent.value_or(false);
        // A function that is not in use is remembered for when it is.
        text += fmt::format(" {} {} {}", surface.isovalue.value_or(-1), translucent,
                            translucent ? *surface.transfer : "");
        if (surface.ambient)
            text += fmt::format(" {} {} {} {} {} {}", surface.ambient->lit, surface.ambient->method,
                                surface.ambient->radius, surface.ambient->modulate,
                                surface.ambient->modulateRadius, surface.ambient->sigma);
        for (const auto& [key, texts] : withLive(s, {})) text += " " + key + "=" + texts.back();
        return text;
    }
    static void rest(ViewSession& s) {
        for (int n = 0; n < 600; ++n) s.step({}, 1.0 / 60);
    }
    static void act(ViewSession& s, ViewCommand command, int times = 1) {
        for (int n = 0; n < times; ++n) s.act({command});
    }

    FakeParts mParts = richScene();
};

struct Detour {
    const char* name;
    std::function<void(ViewSession&)> there, back;
};

const std::vector<Detour>& detours() {
    using S = ViewSession;
    using C = ViewCommand;
    static const auto key = [](C command, int times = 1) {
        return [=](S& s) {
            for (int n = 0; n < times; ++n) s.act({command});
        };
    };
    static const auto live = [](const char* name, const char* text) {
        return std::pair{[=](S& s) { setLive(s, name, text); },
                         [=](S& s) { setLive(s, name, std::nullopt); }};
    };
    static const std::vector<Detour> all = [] {
        std::vector<Detour> list = {
            {"method, round", key(C::NextMethod), key(C::NextMethod, 2)},
            {"mode, on and back", key(C::NextMode), key(C::PreviousMode)},
            {"mode, by name", [](S& s) { s.chooseMode(OutputMode::TopBottom); },
             [](S& s) { s.chooseMode(OutputMode::SideBySide); }},
            {"stereo off and on", key(C::ToggleStereo), key(C::ToggleStereo)},
            {"eyes swapped", key(C::SwapEyes), key(C::SwapEyes)},
            {"anaglyph", key(C::LinearAnaglyph), key(C::LinearAnaglyph)},
            {"full cast", key(C::ShowFullCast), key(C::ShowFullCast)},
            {"difference", key(C::ShowDifference), key(C::ShowDifference)},
            {"holes", key(C::ShowHoles), key(C::ShowHoles)},
            {"one truth, then another", [](S& s) { s.act({C::ShowFullCast}), s.act({C::ShowHoles}); },
             key(C::ShowHoles)},
            {"comfort", key(C::KeepComfortable), key(C::KeepComfortable)},
            {"sun there and back", key(C::SunClockwise, 3), key(C::SunAnticlockwise, 3)},
            {"sun up and down", key(C::HigherSun, 2), key(C::LowerSun, 2)},
            {"sun placed",
             [](S& s) {
                 s.light().place({2, 1});
             },
             [](S& s) {
                 s.light().place({1.0, 0.5});
             }},
            {"field of view", [](S& s) { s.setFov(0.3); }, [](S& s) { s.setFov(std::nullopt); }},
            {"isovalue", key(C::HigherIsovalue, 4), key(C::LowerIsovalue, 4)},
            {"translucent", key(C::ToggleTranslucent), key(C::ToggleTranslucent)},
            {"ambient, round", key(C::NextAmbient), key(C::NextAmbient, 2)},
            {"ambient, on and back", key(C::NextAmbient, 2), key(C::PreviousAmbient, 2)},
            {"paint", [](S& s) { s.setPaint(std::make_shared<NoPaint>()); },
             [](S& s) { s.setPaint(nullptr); }},
        };
        for (const auto& [name, text] : {std::pair{"mode", "tbl"},
                                         {"method", "depthsplat"},
                                         {"fov", "33"},
                                         {"sun", "250,15"},
                                         {"isovalue", "140"},
                                         {"transfer", "tissue"}}) {
            auto [there, back] = live(name, text);
            list.push_back({name, there, back});
        }
        return list;
    }();
    return all;
}

TEST_F(SessionDetours, ThereAndBackIsAsIfNeverLeft) {
    for (const Detour& detour : detours()) {
        SCOPED_TRACE(detour.name);
        ViewSession s = sessionOf(mParts);
        rest(s);
        const std::string before = told(s);
        const long long version = s.requestFor(640, 360).version;
        detour.there(s);
        rest(s);
        EXPECT_NE(told(s), before) << "it is a detour";
        detour.back(s);
        rest(s);
        EXPECT_EQ(told(s), before);
        EXPECT_GE(s.requestFor(640, 360).version, version) << "what was asked for on the way is older";
    }
}

// Detours within another one are undone in turn.
TEST_F(SessionDetours, OneWithinAnotherToo) {
    for (std::size_t n = 0; n < detours().size(); ++n) {
        const Detour &outer = detours()[n], &inner = detours()[(n + 7) % detours().size()];
        SCOPED_TRACE(std::string(outer.name) + ", " + inner.name);
        ViewSession s = sessionOf(mParts);
        rest(s);
        const std::string before = told(s);
        outer.there(s);
        const std::string between = told(s);
        inner.there(s);
        inner.back(s);
        rest(s);
        EXPECT_EQ(told(s), between);
        outer.back(s);
        rest(s);
        EXPECT_EQ(told(s), before);
    }
}

// The frame of A that was asked for before B is not the one that is asked for after it.
TEST_F(SessionDetours, WhatIsAskedForAfterADetourHasANumberOfItsOwn) {
    ViewSession s = sessionOf(mParts);
    std::vector<long long> versions = {s.requestFor(640, 360).version};
    for (const double fov : {0.3, 0.8, 0.3, 0.8}) {
        s.setFov(fov);
        versions.push_back(s.requestFor(640, 360).version);
        EXPECT_EQ(s.requestFor(640, 360).version, versions.back()) << "asked for once";
        if (versions.size() > 2) {
            EXPECT_GT(versions.back(), versions[versions.size() - 2]);
        }
    }
    const auto one = std::make_shared<NoPaint>(), other = std::make_shared<NoPaint>();
    for (const auto& paint : {one, other, one}) {
        s.setPaint(paint);
        const FrameRequest request = s.requestFor(640, 360);
        EXPECT_GT(request.version, versions.back());
        EXPECT_EQ(request.paintOver, paint);
        versions.push_back(request.version);
        s.setPaint(paint);
        EXPECT_EQ(s.requestFor(640, 360).version, versions.back()) << "the same again is nothing new";
    }
}

// A measurement of A is neither shown beside B, nor beside A once it is asked for again.
TEST_F(SessionDetours, AMeasuringIsOfItsOwnPictureAlone) {
    ViewSession s = sessionOf(mParts);
    ViewFrame frame;
    frame.request = s.requestFor(640, 360);
    s.observe(FrameTruth{frame.request.version, {50, 9, 0.1}, 1, ""});
    EXPECT_NE(s.measuredText(frame), "");
    s.setFov(0.3);
    frame.request = s.requestFor(640, 360);
    EXPECT_EQ(s.measuredText(frame), "");
    s.setFov(0.8);
    frame.request = s.requestFor(640, 360);
    EXPECT_EQ(s.measuredText(frame), "") << "the same view, but another picture";
}

// --- paths

TEST_F(SessionDetours, PathsComeBackOneByOne) {
    ViewSession s = sessionOf(mParts);
    test::PlainSteps<double> plain(s.paths().path().duration());
    double next = 10;
    for (const char step : std::string("eeuueeeuuuueueeu")) {
        const long long version = s.paths().version();
        if (step == 'e') {
            s.paths().edit([&](const RecordedPath& now) {
                EXPECT_EQ(now.duration(), plain.now());
                return lasting(++next);
            });
            plain.change(next);
        } else {
            s.paths().undo();
            const bool could = plain.canUndo();
            plain.undo();
            EXPECT_EQ(s.paths().version() != version, could);
        }
        ASSERT_EQ(s.paths().path().duration(), plain.now());
    }
}

TEST_F(SessionDetours, AsManyPathsAsAreKept) {
    ViewSession s = sessionOf(mParts);
    for (int n = 1; n <= 70; ++n) s.paths().edit([&](const RecordedPath&) { return lasting(100 + n); });
    for (int n = 1; n <= 80; ++n) s.paths().undo();
    EXPECT_EQ(s.paths().path().duration(), 120) << "fifty steps back";
}

// Undo of long recordings: as many steps as a million places allow, and always one.
TEST_F(SessionDetours, StepsOfLongPathsAreFewer) {
    const auto ofPlaces = [](std::size_t count) {
        std::vector<PathSample> samples(count);
        for (std::size_t n = 0; n < count; ++n) samples[n].time = static_cast<double>(n);
        return RecordedPath(std::move(samples), "test");
    };
    for (const auto& [count, steps] : {std::pair<std::size_t, int>{300'000, 3}, {1'200'000, 1}}) {
        SCOPED_TRACE(count);
        ViewSession s = sessionOf(mParts);
        const RecordedPath path = ofPlaces(count);
        for (int n = 0; n < 6; ++n) s.paths().edit([&](const RecordedPath&) { return path; });
        int back = 0;
        for (long long version = -1; version != s.paths().version(); back += version != s.paths().version()) {
            version = s.paths().version();
            s.paths().undo();
        }
        EXPECT_EQ(back, steps);
    }
}

// The scene's own path, changed and restored, is the scene's own again: it changes with the scene.
TEST_F(SessionDetours, AnOwnPathThatIsTakenBackIsTheScenesAgain) {
    for (const bool goes : {true, false}) {
        SCOPED_TRACE(goes);
        ViewSession s = sessionOf(mParts);
        s.paths().edit([](const RecordedPath&) { return lasting(7); });
        s.paths().edit([](const RecordedPath&) { return lasting(8); });
        s.paths().undo();
        if (goes) s.paths().undo();
        FakeParts other = mParts;
        other.path = lasting(3);
        s.replaceScene(opened(other));
        EXPECT_EQ(s.paths().path().duration(), goes ? 3 : 7);
        if (goes) continue;
        s.paths().undo();
        EXPECT_EQ(s.paths().path().duration(), 3) << "that of the scene that is shown now";
    }
    // A path that was given stays.
    ViewSession given(opened(mParts), {OutputMode::SideBySide, lasting(5), "."});
    given.paths().edit([](const RecordedPath&) { return lasting(7); });
    given.paths().undo();
    FakeParts other = mParts;
    other.path = lasting(3);
    given.replaceScene(opened(other));
    EXPECT_EQ(given.paths().path().duration(), 5);
}

// An edit that fails is no step: there is nothing more to undo, and the present path is not lost.
TEST_F(SessionDetours, AnEditThatFailsIsNoStep) {
    ViewSession s = sessionOf(mParts);
    s.paths().edit([](const RecordedPath&) { return lasting(7); });
    s.paths().edit([](const RecordedPath&) -> RecordedPath { throw Error("", "path", "is not so", "no"); });
    EXPECT_EQ(s.paths().path().duration(), 7);
    s.paths().undo();
    EXPECT_EQ(s.paths().path().duration(), 2);
    const long long version = s.paths().version();
    s.paths().undo();
    EXPECT_EQ(s.paths().version(), version) << "there is nothing before it";
}

TEST_F(SessionDetours, PlayingEndsWithEachChangeOfThePath) {
    for (int kind = 0; kind < 3; ++kind) {
        SCOPED_TRACE(kind);
        ViewSession s = sessionOf(mParts);
        s.paths().edit([](const RecordedPath&) { return lasting(9); });
        act(s, ViewCommand::Play);
        s.step({}, 0.5);
        ASSERT_TRUE(s.paths().playing());
        if (kind == 0) s.paths().undo();
        if (kind == 1) s.paths().set(lasting(4));
        if (kind == 2) s.paths().edit([](const RecordedPath&) { return lasting(5); });
        EXPECT_FALSE(s.paths().playing());
        EXPECT_NEAR(s.pose().position.x, 5, 1e-6) << "where it was";
        act(s, ViewCommand::Play);
        EXPECT_NEAR(s.pose().position.x, 0, 1e-6) << "from the start";
    }
}

// --- changes that are made beside the frames

// Asked for: A, B, A. Made: none, failed, or dropped. The scene that is shown counts, and none of the
// requests.
TEST_F(SessionDetours, AChangeThatDidNotComeAboutIsForgotten) {
    ViewSession s = sessionOf(mParts);
    const std::string before = told(s);
    const std::vector<ViewCommand> changes = {ViewCommand::HigherIsovalue, ViewCommand::ToggleTranslucent,
                                              ViewCommand::NextAmbient, ViewCommand::NextTransfer};
    for (const ViewCommand command : changes) {
        act(s, command);
        ASSERT_TRUE(s.surface().takeChange()) << static_cast<int>(command);
        EXPECT_NE(told(s), before);
        s.surface().forgetChange();
        EXPECT_EQ(told(s), before) << static_cast<int>(command);
    }
    // A later request stays.
    act(s, ViewCommand::HigherIsovalue);
    s.surface().takeChange();
    act(s, ViewCommand::HigherIsovalue);
    s.surface().forgetChange();
    const auto later = s.surface().takeChange();
    ASSERT_TRUE(later);
    EXPECT_EQ(later->surface.isovalue, 120);
}

// A scene that is loaded again (not made from the one before) says what it shows: earlier requests are
// dropped.
TEST_F(SessionDetours, AnotherSceneBeginsWithItsOwnSurface) {
    ViewSession s = sessionOf(mParts);
    act(s, ViewCommand::HigherIsovalue);
    s.surface().takeChange();
    FakeParts other = mParts;
    other.surface->isovalue = 333;
    s.replaceScene(opened(other));
    EXPECT_EQ(s.surface().now().isovalue, 333);
    EXPECT_FALSE(s.surface().takeChange());
    // A study for slices is asked for once, and a wish that is dropped is gone.
    other.readSlices = [](Progress&) { return std::make_shared<const SliceStudy>(); };
    s.replaceScene(opened(other));
    s.slices().wishStudy();
    s.slices().dropStudyWish();
    EXPECT_FALSE(s.slices().takeStudyWish());
    act(s, ViewCommand::Slices);
    EXPECT_TRUE(s.slices().wantsView());
    s.slices().dropStudyWish();
    EXPECT_FALSE(s.slices().wantsView());
    EXPECT_FALSE(s.slices().takeStudyWish());
    s.slices().wishStudy();
    EXPECT_TRUE(s.slices().takeStudyWish());
    EXPECT_FALSE(s.slices().wantsView()) << "a panel wishes it, not the slice view";
}

// --- flights to a goal

TEST_F(SessionDetours, AGoalIsLeftByWhateverComesAfterIt) {
    const Pose goal = poseFromAngles({0, 4000, 500}, 0, 0, 0), other = poseFromAngles({900, 0, 500}, 0, 0, 0);
    FlightInput forward;
    forward.forward = 1;
    const std::vector<std::pair<const char*, std::function<void(ViewSession&)>>> ends = {
        {"keys", [&](ViewSession& s) { s.step(forward, 1.0 / 60); }},
        {"a look", [](ViewSession& s) { s.look(0.1, 0); }},
        {"home", [](ViewSession& s) { s.act({ViewCommand::Home}); }},
        {"reset", [](ViewSession& s) { s.act({ViewCommand::Reset}); }},
        {"another place",
         [](ViewSession& s) {
             s.goTo(poseFromAngles({50, 0, 500}, 0, 0, 0));
         }},
        {"a flight that is played", [](ViewSession& s) { s.act({ViewCommand::Play}); }},
        {"another scene", [this](ViewSession& s) { s.replaceScene(opened(mParts)); }},
    };
    for (const auto& [name, end] : ends) {
        SCOPED_TRACE(name);
        ViewSession s = sessionOf(mParts);
        s.flyTo(goal);
        for (int n = 0; n < 10; ++n) s.step({}, 1.0 / 60);
        ASSERT_TRUE(s.moves().toGoal());
        end(s);
        EXPECT_FALSE(s.moves().toGoal());
    }
    // Another goal replaces the first: the flight ends there, not at the first one.
    ViewSession s = sessionOf(mParts);
    s.flyTo(goal);
    for (int n = 0; n < 10; ++n) s.step({}, 1.0 / 60);
    s.flyTo(other);
    for (int n = 0; n < 100'000 && s.moves().toGoal(); ++n) s.step({}, 0.05);
    EXPECT_FALSE(s.moves().toGoal());
    EXPECT_LT(glm::length(s.pose().position - other.position), 1);
}

}  // namespace
}  // namespace stereonav
