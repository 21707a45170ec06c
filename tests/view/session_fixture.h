// A session over level ground, for tests of the viewer's logic.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>

#include "app/view/session.h"
#include "engine/nav/navigator.h"
#include "tests/view/fake_frames.h"
#include "tests/view/fake_scene.h"

namespace stereonav {

inline const Pose kStart = poseFromAngles({0, 0, 500}, 0, -0.1, 0);

inline FakeParts flatScene() {
    FakeParts scene;
    scene.makeFlight = []() -> std::unique_ptr<Flight> {
        FlightSetting setting;
        setting.speed = 200;
        return std::make_unique<Navigator>([](const glm::dvec2&) { return 0.0; }, kStart, setting);
    };
    scene.path = RecordedPath(
        {{2.0, poseFromAngles({0, 0, 500}, 0, 0, 0)}, {4.0, poseFromAngles({100, 0, 500}, 0, 0, 0)}}, "test");
    scene.stereo = {20.0, 600.0};
    static FakeFrames frames;
    scene.frames = &frames;
    scene.way.method = frames.defaultMethod();
    return scene;
}

class SessionFixture : public testing::Test {
protected:
    void SetUp() override {
        mFolder =
            std::filesystem::path(testing::TempDir()) / ("stereonav_session_" + std::to_string(getpid()));
        std::filesystem::create_directories(mFolder);
    }
    void TearDown() override { std::filesystem::remove_all(mFolder); }
    ViewSession session() {
        return ViewSession(opened(*mScene), {OutputMode::SideBySide, std::nullopt, mFolder});
    }

    // Returns a frame with this range of parallax.
    static ViewFrame frameWith(double nearest, double farthest) {
        ViewFrame frame;
        frame.left.resize(10, 10);
        frame.request.stereo = {20.0, 600.0};
        frame.timings.warped = {0.4, 0.3, 7};
        frame.nearParallax = nearest;
        frame.farParallax = farthest;
        return frame;
    }

    std::shared_ptr<FakeParts> mScene = std::make_shared<FakeParts>(flatScene());
    std::filesystem::path mFolder;
};

}  // namespace stereonav
