// Which frames the window asks for, at rest and in flight, and which of those that come belong to it.
#include "app/view/asked_frames.h"

#include <gtest/gtest.h>

#include "tests/view/session_fixture.h"

namespace stereonav {
namespace {

class FramesThatAreAsked : public SessionFixture {
protected:
    std::optional<FrameRequest> next(ViewSession& session) {
        return mAsked.next(session, mShots, mOptions, {640, 200}, 1.0 / 60, mNow += 0.01);
    }
    static ViewFrame frameOf(const FrameRequest& request) {
        ViewFrame frame = frameWith(-0.01, 0.01);
        frame.request = request;
        frame.made_ms = 20;
        return frame;
    }
    // Flies forwards.
    static void fly(ViewSession& session) {
        FlightInput input;
        input.forward = 1;
        session.step(input, 0.1);
    }

    AskedFrames mAsked;
    Screenshots mShots{""};
    ViewOptions mOptions;
    double mNow = 1;
};

TEST_F(FramesThatAreAsked, WhatRestsIsAskedForOnceAndInFull) {
    ViewSession session = this->session();
    mAsked.begin(session);
    session.step({}, 0.01);
    const auto request = next(session);
    ASSERT_TRUE(request);
    EXPECT_FALSE(request->flying);
    EXPECT_EQ(request->scale, 1);
    EXPECT_EQ(request->guard, glm::ivec2(0));
    session.step({}, 0.01);
    EXPECT_FALSE(next(session));
    EXPECT_TRUE(mAsked.isNewest(frameOf(*request)));
}

TEST_F(FramesThatAreAsked, InFlightTheyAreOfLaterAndWarped) {
    ViewSession session = this->session();
    mAsked.begin(session);
    const auto first = next(session);
    ASSERT_TRUE(first);
    mAsked.came(frameOf(*first), mNow);
    fly(session);
    const auto second = next(session);
    ASSERT_TRUE(second && second->flying && second->late);
    EXPECT_EQ(mAsked.present().pose.position, session.pose().position);
    EXPECT_EQ(mAsked.present().ahead_s, 0);
    EXPECT_EQ(mAsked.present().scale, 1);
}

TEST_F(FramesThatAreAsked, WithoutLateWarpNothingIsWarped) {
    mOptions.lateWarp = false;
    ViewSession session = this->session();
    mAsked.begin(session);
    fly(session);
    const auto request = next(session);
    ASSERT_TRUE(request);
    EXPECT_FALSE(request->flying || request->late);
    const ViewFrame frame = frameOf(*request);
    EXPECT_FALSE(mAsked.warps(&frame, mOptions.lateWarp));
}

TEST_F(FramesThatAreAsked, AScreenshotIsWhole) {
    ViewSession session = this->session();
    mAsked.begin(session);
    fly(session);
    session.act({ViewCommand::Screenshot});
    const auto request = next(session);
    ASSERT_TRUE(request);
    EXPECT_FALSE(request->flying);
    EXPECT_EQ(request->scale, 1);
    EXPECT_TRUE(mShots.waiting());
}

TEST_F(FramesThatAreAsked, FramesOfTheSessionBeforeAreNotItsOwn) {
    ViewSession session = this->session();
    mAsked.begin(session);
    const auto request = next(session);
    ASSERT_TRUE(request);
    const ViewFrame frame = frameOf(*request);
    EXPECT_TRUE(mAsked.ofSession(frame));
    ViewSession another = this->session();
    mAsked.begin(another);
    EXPECT_FALSE(mAsked.ofSession(frame));
    EXPECT_FALSE(mAsked.warps(&frame, true));
    EXPECT_TRUE(next(another));
}

}  // namespace
}  // namespace stereonav
