// Editing keyframes of a map, without one: a dragged one keeps its height over the ground and its pace, undo
// and redo work, and the flight through them is never below the lowest permitted height.
#include "app/view/keyframe_edit.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "engine/base/error.h"
#include "engine/nav/navigator.h"

namespace stereonav {
namespace {

// Returns the height of a ridge across the way, 300 m high, from x = 900 to 1100, without ground west of x =
// 0.
double ridge(const glm::dvec2& at) {
    if (at.x < 0) return std::nan("");
    return 300 * std::max(0.0, 1 - std::abs(at.x - 1000) / 100);
}

Pose eyeAt(double x, double y, double z) {
    return poseFromAngles({x, y, z}, 1.5, 0, 0);
}

std::unique_ptr<Flight> overRidge() {
    return std::make_unique<Navigator>(ridge, eyeAt(100, 0, 50), FlightSetting{});
}

Keyframes three() {
    return timedKeyframes({eyeAt(100, 0, 50), eyeAt(700, 0, 50), eyeAt(1900, 0, 50)}, 100);
}

class KeyframeEditTest : public testing::Test {
protected:
    std::vector<double> times() const {
        std::vector<double> all;
        for (const PathSample& key : mEdit.keys()) all.push_back(key.time);
        return all;
    }

    std::unique_ptr<Flight> mFlight = overRidge();
    KeyframeEdit mEdit;
};

TEST_F(KeyframeEditTest, AddsTheEyeAfterTheChosenOne) {
    EXPECT_FALSE(mEdit.any());
    mEdit.add(eyeAt(0, 0, 10), 100);
    mEdit.add(eyeAt(1000, 0, 10), 100);
    EXPECT_THAT(times(), testing::ElementsAre(0, testing::DoubleNear(10, 1e-9)));
    EXPECT_EQ(mEdit.chosen(), 1u);
    mEdit.choose(0);
    mEdit.add(eyeAt(0, 500, 10), 100);
    ASSERT_EQ(mEdit.keys().size(), 3u);
    EXPECT_EQ(mEdit.keys()[1].pose.position.y, 500);
    EXPECT_EQ(mEdit.chosen(), 1u);
    EXPECT_NEAR(times()[1], 5, 1e-9);
    EXPECT_NEAR(times()[2], 5 + std::hypot(1000, 500) / 100, 1e-9);
    mEdit.add(mEdit.keys()[1].pose, 100);  // the same place again
    EXPECT_EQ(mEdit.keys().size(), 4u);
    EXPECT_GT(times()[2], times()[1]);
    Pose nowhere = eyeAt(0, 0, 0);
    nowhere.position.x = std::nan("");
    EXPECT_THROW(mEdit.add(nowhere, 100), Error);
    EXPECT_THROW(mEdit.add(eyeAt(0, 0, 0), 0), Error);
    EXPECT_EQ(mEdit.keys().size(), 4u);
}

TEST_F(KeyframeEditTest, StepsGoBackAndForth) {
    mEdit.start(three());
    EXPECT_FALSE(mEdit.canUndo());
    mEdit.choose(1);
    mEdit.removeChosen();
    EXPECT_EQ(mEdit.keys().size(), 2u);
    EXPECT_EQ(mEdit.chosen(), 0u);
    mEdit.removeChosen();
    EXPECT_EQ(mEdit.chosen(), std::nullopt);
    mEdit.removeChosen();
    EXPECT_EQ(mEdit.keys().size(), 1u) << "none is chosen";
    mEdit.undo();
    mEdit.undo();
    EXPECT_EQ(mEdit.keys().size(), 3u);
    EXPECT_FALSE(mEdit.canUndo());
    mEdit.undo();
    mEdit.redo();
    EXPECT_EQ(mEdit.keys().size(), 2u);
    mEdit.choose(7);
    EXPECT_EQ(mEdit.chosen(), std::nullopt);
    mEdit.choose(1);
    mEdit.add(eyeAt(3000, 0, 50), 100);
    EXPECT_FALSE(mEdit.canRedo()) << "another way was taken";
}

TEST_F(KeyframeEditTest, ADragIsOneStepAndKeepsThePace) {
    mEdit.start(three());
    mEdit.beginDrag(5);
    EXPECT_FALSE(mEdit.dragging());
    mEdit.beginDrag(1);
    EXPECT_EQ(mEdit.chosen(), 1u);
    mEdit.endDrag();
    EXPECT_FALSE(mEdit.canUndo()) << "it was only chosen";
    mEdit.beginDrag(1);
    for (const double y : {10.0, 300.0, 800.0}) mEdit.dragTo({700, y, 50});
    mEdit.dragTo({std::nan(""), 0, 0});
    EXPECT_TRUE(mEdit.dragging());
    mEdit.endDrag();
    EXPECT_EQ(mEdit.keys()[1].pose.position, glm::dvec3(700, 800, 50));
    EXPECT_NEAR(times()[1], std::hypot(600, 800) / 100, 1e-9);
    EXPECT_NEAR(times()[2] - times()[1], std::hypot(1200, 800) / 100, 1e-9);
    EXPECT_TRUE(mEdit.canUndo());
    mEdit.undo();
    EXPECT_EQ(mEdit.keys()[1].pose.position, glm::dvec3(700, 0, 50));
    EXPECT_FALSE(mEdit.canUndo());
    mEdit.redo();
    EXPECT_EQ(mEdit.keys()[1].pose.position.y, 800);
    // Dragged onto its neighbour: times stay in order.
    mEdit.beginDrag(1);
    mEdit.dragTo(mEdit.keys()[0].pose.position);
    mEdit.endDrag();
    EXPECT_GT(times()[1], times()[0]);
    EXPECT_GT(times()[2], times()[1]);
}

TEST_F(KeyframeEditTest, HeightOverTheGroundIsKept) {
    const glm::dvec3 from(700, 0, 50);
    const double height = *heightOverGround(*mFlight, from);
    for (const double x : {500.0, 950.0, 1000.0, 1e6}) {
        const glm::dvec3 place = overGround(*mFlight, from, {x, 40});
        EXPECT_NEAR(*heightOverGround(*mFlight, place), height, 1e-9) << x;
        EXPECT_EQ(glm::dvec2(place), glm::dvec2(x, 40));
    }
    EXPECT_EQ(overGround(*mFlight, {700, 0, -80}, {1000, 0}).z, mFlight->lowestAt({1000, 0, 0})) << "lifted";
    EXPECT_EQ(heightOverGround(*mFlight, {-5, 0, 70}), std::nullopt);
    EXPECT_EQ(overGround(*mFlight, from, {-5, 0}).z, 50) << "where there is no ground";
    EXPECT_EQ(overGround(*mFlight, {-5, 0, 70}, {-9, 3}).z, 70);
    EXPECT_EQ(overGround(*mFlight, {-5, 0, 70}, {500, 0}).z, 70) << "high enough there";
    EXPECT_EQ(overGround(*mFlight, {-5, 0, 70}, {1000, 0}).z, mFlight->lowestAt({1000, 0, 0}));
}

TEST_F(KeyframeEditTest, TheFlightPassesOverTheGround) {
    EXPECT_TRUE(flownThrough({}, *mFlight).path.samples().empty());
    mEdit.add(eyeAt(0, 0, 10), 100);
    EXPECT_TRUE(flownThrough(mEdit.keys(), *mFlight).path.samples().empty());
    const FlownPath flown = flownThrough(three(), *mFlight);
    ASSERT_GT(flown.path.samples().size(), 100u);
    ASSERT_EQ(flown.blocked.size() + 1, flown.path.samples().size());
    EXPECT_FALSE(flown.anyBlocked);
    double highest = 0, steepest = 0;
    const auto& samples = flown.path.samples();
    for (std::size_t n = 0; n < samples.size(); ++n) {
        EXPECT_GE(samples[n].pose.position.z, mFlight->lowestAt(samples[n].pose.position) - 1e-9);
        highest = std::max(highest, samples[n].pose.position.z);
        if (n > 0)
            steepest =
                std::max(steepest, std::abs(samples[n].pose.position.z - samples[n - 1].pose.position.z));
    }
    EXPECT_LT(highest, 310) << "no higher than it must be";
    EXPECT_LT(steepest, 10) << "no step upwards";
    EXPECT_EQ(samples.front().pose.position, three().front().pose.position);
    EXPECT_EQ(samples.back().pose.position, three().back().pose.position);
}

// A flight with a wall: everything beyond x = 1000.
class Walled final : public Flight {
public:
    void step(const FlightInput&, double) override {}
    void turnBy(double, double) override {}
    Pose pose() const override { return {}; }
    void setPose(const Pose&) override {}
    void goHome() override {}
    int modeCount() const override { return 1; }
    int mode() const override { return 0; }
    void setMode(int) override {}
    std::string_view modeName(int) const override { return "free"; }
    double speed() const override { return 1; }
    double clearanceNow() const override { return 1; }
    bool wayIsClear(const glm::dvec3& from, const glm::dvec3& to) const override {
        return from.x < 1000 && to.x < 1000;
    }
};

TEST_F(KeyframeEditTest, WhatGoesThroughAWallIsSaid) {
    const FlownPath flown = flownThrough(three(), Walled());
    EXPECT_TRUE(flown.anyBlocked);
    EXPECT_EQ(flown.blocked.front(), 0);
    EXPECT_EQ(flown.blocked.back(), 1);
}

TEST_F(KeyframeEditTest, AFlightHasAsManyAsThereAreHandlesFor) {
    std::vector<PathSample> samples;
    for (int n = 0; n < 2000; ++n)  // the flight shakes all the time
        samples.push_back({n / 60.0, eyeAt(n, 300 * std::sin(n * 0.7), 100)});
    const RecordedPath path(samples, "test");
    const Keyframes keys = keyframesToEdit(path);
    EXPECT_GE(keys.size(), 2u);
    EXPECT_LE(keys.size(), 60u);
    EXPECT_EQ(keyframesToEdit(RecordedPath({{0, eyeAt(0, 0, 0)}, {1, eyeAt(0, 0, 0)}}, "still")).size(), 2u);
    EXPECT_THROW(keyframesToEdit(RecordedPath()), Error);
    // A smooth flight needs few keyframes.
    const RecordedPath smooth = pathThrough(three(), true);
    const RecordedPath again = pathThrough(keyframesToEdit(smooth), true);
    for (const double share : {0.25, 0.5, 0.75})
        EXPECT_LT(glm::length(again.at(share * smooth.duration()).position -
                              smooth.at(share * smooth.duration()).position),
                  60);
}

}  // namespace
}  // namespace stereonav
