// Media in the viewer without a window: both eyes come from one place, models and light change between
// frames, and moving parts follow the clock.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "app/view/session.h"
#include "app/view/status.h"
#include "engine/medium/sweep/swept_frames.h"
#include "engine/nav/navigator.h"
#include "tests/support/wait_for.h"
#include "tests/view/fake_scene.h"

namespace stereonav {
namespace {

// Both eyes have the colour of the method and the model, with the time as depth.
class Fog : public FrameMaker {
public:
    std::span<const std::string_view> methods() const override { return kSweepMethods; }
    std::string_view defaultMethod() const override { return kSweepMethod; }
    std::string_view exactMethod() const override { return kTwoSweepsMethod; }
    std::string_view whatMethodsMake() const override { return "both eyes"; }
    void make(const StereoViews& views, double time, const FrameWay& way, EyePair& frame) override {
        paint(views.left, time, colorOf(way.method), frame.left);
        paint(views.right, time, static_cast<PackedColor>(10 * model + 100), frame.right);
        frame.timings = {};
        frame.timings.both_ms = 12.5;
        if (way.method == kDepthSplatMethod) frame.timings.left_ms = 8, frame.timings.right_ms = 4.5;
    }
    void makeOne(const EyeView& view, double time, EyePair& frame) override {
        paint(view, time, 1000, frame.left);
        frame.right = {};
        frame.timings = {};
        frame.timings.both_ms = frame.timings.left_ms = 6.25;
    }
    static PackedColor colorOf(std::string_view method) {
        return static_cast<PackedColor>(std::find(kSweepMethods.begin(), kSweepMethods.end(), method) -
                                        kSweepMethods.begin());
    }
    int model = -1;

private:
    static void paint(const EyeView& view, double time, PackedColor color, EyeImage& image) {
        image.resize(view.width, view.height);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                image.color.at(x, y) = color;
                image.viewDepth.at(x, y) = static_cast<float>(10 + time);
            }
    }
};

FakeParts fogScene() {
    auto fog = std::make_shared<Fog>();
    FakeParts scene;
    scene.frames = fog.get();
    scene.way.method = kSweepMethod;
    scene.models = {"emission", "surface", "direct"};
    scene.model = 1;
    scene.setModel = [fog = fog.get()](int model) { fog->model = model; };
    scene.sun = {1.0, 0.5};
    scene.moveSun = [](const SunPlace&) {};
    scene.owner = std::move(fog);
    scene.makeFlight = []() -> std::unique_ptr<Flight> {
        return std::make_unique<Navigator>([](const glm::dvec2&) { return std::nan(""); },
                                           poseFromAngles({0, 0, 5}, 0, 0, 0), FlightSetting{});
    };
    scene.path = RecordedPath(
        {{2.0, poseFromAngles({0, 0, 5}, 0, 0, 0)}, {4.0, poseFromAngles({10, 0, 5}, 0, 0, 0)}}, "test");
    scene.stereo = {1.0, 30.0};
    return scene;
}

ViewSession sessionOf(const FakeParts& scene) {
    return ViewSession(opened(scene), {OutputMode::SideBySide, std::nullopt, "."});
}

std::shared_ptr<const ViewFrame> frameOf(ViewWorker& worker, const FrameRequest& request) {
    worker.request(request);
    return test::waitFor([&] { return worker.takeFrame(); });
}

TEST(ViewMedium, ModelsAndMethodsAreSteppedThroughAndReset) {
    ViewSession s = sessionOf(fogScene());
    std::vector<int> models;
    std::vector<std::string_view> methods;
    for (int n = 0; n < 5; ++n) {
        models.push_back(s.requestFor(80, 40).model);
        methods.push_back(s.requestFor(80, 40).way.method);
        const long long before = s.requestFor(80, 40).version;
        s.act({ViewCommand::NextModel});
        s.act({ViewCommand::NextMethod});
        EXPECT_GT(s.requestFor(80, 40).version, before) << "a new frame is asked for";
    }
    EXPECT_THAT(models, testing::ElementsAre(1, 2, 0, 1, 2));
    EXPECT_THAT(methods, testing::ElementsAre(kSweepMethod, kOwnSamplesMethod, kTwoSweepsMethod,
                                              kDepthSplatMethod, kSweepMethod));
    s.act({ViewCommand::Reset});
    EXPECT_EQ(s.requestFor(80, 40).model, 1);
    EXPECT_EQ(s.requestFor(80, 40).way.method, kSweepMethod);
    s.act({ViewCommand::HigherSun});
    EXPECT_GT(s.requestFor(80, 40).sun.elevation, 0.5);
}

TEST(ViewMedium, OtherScenesHaveNoModels) {
    FakeParts scene = fogScene();
    scene.models.clear();
    ViewSession s = sessionOf(scene);
    const long long before = s.requestFor(80, 40).version;
    s.act({ViewCommand::NextModel});
    EXPECT_EQ(s.requestFor(80, 40).version, before);
    EXPECT_NE(s.notice().find("media"), std::string::npos);
}

TEST(ViewMedium, OnlyWhatMovesByItselfHasAClock) {
    ViewSession still = sessionOf(fogScene());
    still.step({}, 0.1);
    still.step({}, 0.1);
    EXPECT_EQ(still.requestFor(80, 40).time, 0.0);
    EXPECT_FALSE(still.moving());

    FakeParts scene = fogScene();
    scene.animated = true;
    ViewSession s = sessionOf(scene);
    for (int n = 1; n <= 20; ++n) {
        s.step({}, 0.1);
        EXPECT_NEAR(s.requestFor(80, 40).time, 0.1 * n, 1e-12);
        EXPECT_TRUE(s.moving());
    }
    // A flight has a clock of its own, so that it looks the same each time.
    s.act({ViewCommand::Play});
    s.step({}, 0.25);
    EXPECT_NEAR(s.requestFor(80, 40).time, 0.25, 1e-12);
}

// The parts stop so that the picture can become the truth.
TEST(ViewMedium, WhatMovesByItselfMayStandStillAtRest) {
    FakeParts scene = fogScene();
    scene.animated = true;
    ViewSession s = sessionOf(scene);
    s.driftAtRest(false);
    for (int n = 0; n < 5; ++n) s.step({}, 0.1);
    EXPECT_EQ(s.requestFor(80, 40).time, 0.0);
    EXPECT_FALSE(s.moving());
    FlightInput forward;
    forward.forward = 1;
    for (int n = 0; n < 5; ++n) s.step(forward, 0.1);
    EXPECT_TRUE(s.moving());
    const double flown = s.requestFor(80, 40).time;
    EXPECT_GT(flown, 0.3);
    for (int n = 0; n < 200 && s.moving(); ++n) s.step({}, 0.1);
    EXPECT_FALSE(s.moving());
    const double stopped = s.requestFor(80, 40).time;
    s.step({}, 0.1);
    EXPECT_EQ(s.requestFor(80, 40).time, stopped);
    s.driftAtRest(true);
    s.step({}, 0.1);
    EXPECT_NEAR(s.requestFor(80, 40).time, stopped + 0.1, 1e-12);
}

TEST(ViewMedium, TheWorkerMakesBothEyesTogether) {
    ViewWorker worker([](Progress&) { return openOf(fogScene()); }, [] {});
    ViewSession s = sessionOf(fogScene());
    FrameRequest request = s.requestFor(80, 40);
    request.time = 3;
    request.model = 2;
    request.way.method = kDepthSplatMethod;
    const auto frame = frameOf(worker, request);
    ASSERT_NE(frame, nullptr);
    EXPECT_EQ(frame->left.color.at(3, 4), Fog::colorOf(kDepthSplatMethod));
    EXPECT_EQ(frame->right.color.at(3, 4), 120u);
    EXPECT_EQ(frame->depthAhead, 13.0);
    EXPECT_LT(frame->nearParallax, 0) << "13 m away, before the screen";
    EXPECT_NE(frameText(*frame, 10).find("left 8.0 ms  right 4.5 ms  depthsplat"), std::string::npos)
        << frameText(*frame, 10);
    request.way.method = kSweepMethod;
    EXPECT_NE(frameText(*frameOf(worker, request), 10).find("both eyes 12.5 ms  sweep"), std::string::npos);
    request.twoEyes = false;
    const auto one = frameOf(worker, request);
    ASSERT_NE(one, nullptr);
    EXPECT_EQ(one->left.color.at(0, 0), 1000u);
    EXPECT_TRUE(one->right.color.empty());
    EXPECT_NE(frameText(*one, 10).find("one eye"), std::string::npos);
}

}  // namespace
}  // namespace stereonav
