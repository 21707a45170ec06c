// Recording a flight and getting it back.
#include "engine/nav/path_recorder.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "engine/base/error.h"
#include "engine/nav/navigator.h"

namespace stereonav {
namespace {

Pose poseAt(double t) {
    return poseFromAngles({10 * t, -3 * t, 100 + t}, 0.1 * t, -0.2, 0.05 * t);
}

TEST(PathRecorder, GivesBackWhatWasFlown) {
    PathRecorder recorder(0.05);
    recorder.start(poseAt(0));
    double t = 0;
    for (int k = 0; k < 1000; ++k) {
        const double dt = 0.001 * (1 + k % 30);
        t += dt;
        recorder.step(dt, poseAt(t));
    }
    EXPECT_NEAR(recorder.duration(), t, 1e-9);
    const RecordedPath path = recorder.finish();
    EXPECT_FALSE(recorder.recording());
    EXPECT_NEAR(path.duration(), t, 1e-9);
    EXPECT_LT(path.samples().size(), t / 0.05 + 3) << "samples closer than the interval";
    EXPECT_GT(path.samples().size(), t / 0.08);
    // Steady motion: lines between the samples are the flight itself.
    for (double s = 0; s <= t; s += 0.013) {
        ASSERT_LT(glm::length(path.at(s).position - poseAt(s).position), 1e-9) << s;
        ASSERT_LT(std::abs(anglesOf(path.at(s)).heading - anglesOf(poseAt(s)).heading), 1e-4) << s;
    }
}

TEST(PathRecorder, KeepsTheLastPose) {
    PathRecorder recorder(1.0);
    recorder.start(poseAt(0));
    recorder.step(1.0, poseAt(1));
    recorder.step(0.25, poseAt(1.25));
    const RecordedPath path = recorder.finish();
    ASSERT_EQ(path.samples().size(), 3u);
    EXPECT_DOUBLE_EQ(path.duration(), 1.25);
    EXPECT_LT(glm::length(path.at(1.25).position - poseAt(1.25).position), 1e-12);
}

TEST(PathRecorder, IsStartedAndEnded) {
    PathRecorder recorder;
    recorder.step(1, poseAt(1));
    EXPECT_FALSE(recorder.recording());
    EXPECT_THROW(recorder.finish(), Error);
    recorder.start(poseAt(0));
    EXPECT_TRUE(recorder.recording());
    recorder.step(0, poseAt(1));
    recorder.step(-1, poseAt(1));
    EXPECT_THROW(recorder.finish(), Error) << "no time has passed";
    recorder.start(poseAt(0));
    recorder.step(2, poseAt(2));
    recorder.start(poseAt(5));
    recorder.step(1, poseAt(6));
    EXPECT_EQ(recorder.finish().at(0).position, poseAt(5).position) << "a new start forgets the old one";
}

}  // namespace
}  // namespace stereonav
