// Flights that are recorded in the viewer: saved, played again, and kept however they end.
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

namespace fs = std::filesystem;

class ViewRecording : public SessionFixture {};

constexpr double kRecordedFrame = 1.0 / 60;

TEST_F(ViewRecording, RecordsAFlightSavesItAndPlaysItAgain) {
    ViewSession s = session();
    s.act({ViewCommand::Record});
    EXPECT_TRUE(s.paths().recording());
    FlightInput forward;
    forward.forward = 1;
    for (int i = 0; i < 60; ++i) s.step(forward, kRecordedFrame);
    const Pose end = s.pose();
    s.act({ViewCommand::Record});
    EXPECT_FALSE(s.paths().recording());
    ASSERT_TRUE(fs::exists(mFolder / "flight_0001.gltf")) << s.notice();
    EXPECT_NEAR(readPath(mFolder / "flight_0001.gltf").duration(), 1.0, 1e-3);

    s.act({ViewCommand::Home});
    s.act({ViewCommand::Play});
    EXPECT_TRUE(s.paths().playing());
    EXPECT_NEAR(glm::length(s.pose().position - kStart.position), 0, 1e-9);
    for (int i = 0; i < 30; ++i) s.step(forward, kRecordedFrame);
    EXPECT_TRUE(s.paths().playing()) << "keys do not disturb it";
    for (int i = 0; i < 40; ++i) s.step({}, kRecordedFrame);
    EXPECT_FALSE(s.paths().playing());
    EXPECT_NEAR(glm::length(s.pose().position - end.position), 0, 1e-3);
}

// The end comes when another scene's session begins, or the window closes.
TEST_F(ViewRecording, WhatWasRecordedOrChangedIsKeptAtItsEnd) {
    const fs::path file = mFolder / "flight_0001.gltf";
    FlightInput forward;
    forward.forward = 1;
    const auto lasting = [](double seconds) {
        return RecordedPath({{0, kStart}, {seconds, poseFromAngles({9, 9, 600}, 0, 0, 0)}}, "test");
    };
    {
        ViewSession s = session();
        EXPECT_EQ(s.paths().keepWork(), "") << "the scene's own path needs no file";
        s.paths().open(lasting(5));
        EXPECT_EQ(s.paths().path().duration(), 5);
        EXPECT_EQ(s.paths().keepWork(), "") << "nor does one that was opened";
        s.paths().undo();
        EXPECT_EQ(s.paths().path().duration(), 2);
        EXPECT_EQ(s.paths().keepWork(), "");
    }
    EXPECT_TRUE(fs::is_empty(mFolder));
    {
        ViewSession s = session();
        s.act({ViewCommand::Record});
        for (int i = 0; i < 60; ++i) s.step(forward, kRecordedFrame);
        EXPECT_THAT(s.paths().keepWork(), testing::HasSubstr(file.string()));
        EXPECT_FALSE(s.paths().recording());
        EXPECT_NEAR(readPath(file).duration(), 1, 1e-3);
        EXPECT_EQ(s.paths().keepWork(), "");
        s.paths().edit([&](const RecordedPath&) { return lasting(7); });
        EXPECT_THAT(s.paths().keepWork(), testing::HasSubstr("flight_0002"));
        EXPECT_EQ(s.paths().keepWork(), "");
        s.paths().set(lasting(8));
        s.paths().save();
        EXPECT_EQ(s.paths().keepWork(), "") << "it was saved";
        s.paths().set(lasting(6));
        s.paths().open(lasting(5));
        EXPECT_NEAR(readPath(mFolder / "flight_0004.gltf").duration(), 6, 1e-3) << "it is lost by no other";
        EXPECT_EQ(s.paths().path().duration(), 5);
        s.paths().set(lasting(9));
        s.act({ViewCommand::Record});  // replaces a path that is in no file
        for (int i = 0; i < 120; ++i) s.step(forward, kRecordedFrame);
        s.act({ViewCommand::Record});
        EXPECT_NEAR(s.paths().path().duration(), 2, 1e-3);
    }
    double seconds[] = {1, 7, 8, 6, 2, 9}, found = 0;
    for (const auto& entry : fs::directory_iterator(mFolder)) {
        const double duration = readPath(entry.path()).duration();
        EXPECT_NE(std::find_if(std::begin(seconds), std::end(seconds),
                               [&](double one) { return std::abs(one - duration) < 1e-3; }),
                  std::end(seconds))
            << entry.path();
        ++found;
    }
    EXPECT_EQ(found, 6);
    EXPECT_NEAR(readPath(file).duration(), 1, 1e-3) << "none was written over";
}

// The session may end in any way: the program is told to stop, or fails.
TEST_F(ViewRecording, ARecordingOutlivesItsSession) {
    {
        ViewSession s = session();
        s.act({ViewCommand::Record});
        FlightInput forward;
        forward.forward = 1;
        for (int i = 0; i < 30; ++i) s.step(forward, kRecordedFrame);
    }
    ASSERT_TRUE(fs::exists(mFolder / "flight_0001.gltf"));
    EXPECT_NEAR(readPath(mFolder / "flight_0001.gltf").duration(), 0.5, 1e-3);
}

}  // namespace
}  // namespace stereonav
