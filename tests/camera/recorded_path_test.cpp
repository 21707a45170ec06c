// The playback clock, interpolation, the .path text, and every way a path can be bad.
#include "engine/camera/recorded_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "engine/base/error.h"
#include "engine/camera/timed_poses.h"
#include "tests/camera/temporary_folder.h"

namespace stereonav {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

template <typename Action>
std::string messageOf(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

std::string readMessage(const TemporaryFolder& folder, const std::string& text) {
    const auto file = folder / "flight.path";
    std::ofstream(file) << text;
    return messageOf([&] { readPath(file); });
}

std::string constructMessage(std::vector<PathSample> samples) {
    return messageOf([&] { RecordedPath(std::move(samples), "made"); });
}

RecordedPath someRecordedFlight(int count, double start = 0) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> metres(-20000, 20000), angle(-3, 3), step(0.01, 2);
    std::vector<PathSample> samples;
    for (double time = start; static_cast<int>(samples.size()) < count; time += step(random))
        samples.push_back({time, poseFromAngles({metres(random), metres(random), metres(random)},
                                                angle(random), angle(random) / 2, angle(random))});
    return RecordedPath(std::move(samples), "made");
}

TEST(RecordedPath, PositionIsLinearAndRotationTurnsEvenly) {
    const RecordedPath path(
        {{10, poseFromAngles({0, 0, 0}, 0, 0, 0)}, {14, poseFromAngles({8, 4, -4}, 1, 0, 0)}}, "made");
    for (int k = 0; k <= 8; ++k) {
        const double share = k / 8.0;
        const Pose pose = path.at(10 + 4 * share);
        ASSERT_LT(glm::distance(pose.position, glm::dvec3(8, 4, -4) * share), 1e-12);
        ASSERT_NEAR(anglesOf(pose).heading, share, 1e-9);
    }
    EXPECT_EQ(path.startTime(), 10);
    EXPECT_EQ(path.duration(), 4);
    EXPECT_LT(glm::distance(path.at(-1e9).position, glm::dvec3(0)), 1e-12);
    EXPECT_LT(glm::distance(path.at(1e9).position, glm::dvec3(8, 4, -4)), 1e-12);
}

TEST(RecordedPath, TurnsTheShortWayWhateverTheSign) {
    Pose a = poseFromAngles({}, 0.2, 0, 0), b = poseFromAngles({}, 0.6, 0, 0);
    b.orientation = -b.orientation;
    const RecordedPath path({{0, a}, {1, b}}, "made");
    EXPECT_NEAR(anglesOf(path.at(0.5)).heading, 0.4, 1e-9);
}

TEST(RecordedPath, FramesIncludeBothEnds) {
    const RecordedPath path = someRecordedFlight(7);
    const auto frames = path.frames(5);
    ASSERT_EQ(frames.size(), 5u);
    EXPECT_EQ(frames.front().position, path.samples().front().pose.position);
    EXPECT_EQ(frames.back().position, path.samples().back().pose.position);
    for (int n = 0; n < 4; ++n)
        EXPECT_EQ(frames[n].position, path.at(path.startTime() + path.duration() * n / 4).position);
    ASSERT_EQ(path.frames(1).size(), 1u);
    EXPECT_EQ(path.frames(1)[0].position, path.samples().front().pose.position);
    EXPECT_TRUE(path.frames(0).empty());
}

// A path whose x is its own clock: frame n must stand at start + n / fps, however many there are.
TEST(RecordedPath, FramesAtARateDoNotDrift) {
    const Pose begin{{1000, 0, 0}, glm::dquat(1, 0, 0, 0)}, end{{4600, 0, 0}, glm::dquat(1, 0, 0, 0)};
    const RecordedPath path({{1000, begin}, {4600, end}}, "made");
    const auto frames = path.framesAtRate(29.97);
    ASSERT_EQ(frames.size(), static_cast<std::size_t>(std::floor(3600 * 29.97)) + 1);
    for (std::size_t n = 0; n < frames.size(); ++n)
        ASSERT_NEAR(frames[n].position.x, 1000 + static_cast<double>(n) / 29.97, 1e-9) << n;
}

TEST(RecordedPath, TheLastFrameOfAWholeNumberOfFramesIsNotLost) {
    for (const double fps : {10.0, 24.0, 25.0, 30.0, 60.0})
        for (const double seconds : {0.1, 0.7, 1.1, 2.0, 3.3}) {
            const RecordedPath path({{0.3, {}}, {0.3 + seconds, {}}}, "made");
            const auto whole = static_cast<std::size_t>(std::floor(seconds * fps + 1e-6));
            EXPECT_EQ(path.framesAtRate(fps).size(), whole + 1) << fps << ' ' << seconds;
        }
}

TEST(RecordedPath, RefusesRatesThatAreNoRates) {
    const RecordedPath path = someRecordedFlight(3);
    for (const double fps : {0.0, -1.0, kNan, std::numeric_limits<double>::infinity(), 1e12})
        EXPECT_THAT(messageOf([&] { path.framesAtRate(fps); }), HasSubstr("--fps")) << fps;
}

TEST(RecordedPath, NormalisesQuaternions) {
    const RecordedPath path({{0, {{}, glm::dquat(2, 0, 0, 0)}}, {1, {{}, glm::dquat(0, 0, 0, 1e-3)}}},
                            "made");
    for (const auto& sample : path.samples()) EXPECT_NEAR(glm::length(sample.pose.orientation), 1, 1e-15);
}

TEST(RecordedPath, RefusesBadSamplesByPose) {
    const Pose good;
    EXPECT_THAT(constructMessage({}), AllOf(HasSubstr("made"), HasSubstr("at least two poses, got 0")));
    EXPECT_THAT(constructMessage({{0, good}}), HasSubstr("at least two poses, got 1"));
    EXPECT_THAT(constructMessage({{0, good}, {1, good}, {1, good}}),
                AllOf(HasSubstr("pose 3 of 3"), HasSubstr("expected a time after 1 s, got 1 s")));
    EXPECT_THAT(constructMessage({{0, good}, {-1, good}}), HasSubstr("expected a time after 0 s, got -1 s"));
    EXPECT_THAT(constructMessage({{kNan, good}, {1, good}}),
                AllOf(HasSubstr("pose 1 of 2"), HasSubstr("time")));
    EXPECT_THAT(constructMessage({{0, {{0, kNan, 0}, good.orientation}}, {1, good}}), HasSubstr("position"));
    EXPECT_THAT(constructMessage({{0, good}, {1, {{}, glm::dquat(0, 0, 0, 0)}}}), HasSubstr("not zero"));
    EXPECT_THAT(constructMessage({{0, good}, {1, {{}, glm::dquat(kNan, 0, 0, 0)}}}), HasSubstr("rotation"));
}

TEST(OsgPath, RoundTripIsExact) {
    const TemporaryFolder folder;
    const RecordedPath path = someRecordedFlight(200, -3.7);
    writePath(folder / "flight.path", path);
    const RecordedPath again = readPath(folder / "flight.path");
    ASSERT_EQ(again.samples().size(), 200u);
    for (std::size_t k = 0; k < 200; ++k) {
        const PathSample &a = path.samples()[k], &b = again.samples()[k];
        ASSERT_EQ(a.time, b.time);
        ASSERT_EQ(a.pose.position, b.pose.position);
        ASSERT_LT(glm::length(a.pose.orientation - b.pose.orientation), 1e-15);
    }
}

// The order of the columns, as osgviewer writes it.
TEST(OsgPath, ColumnsAreTimePositionQuaternionXyzw) {
    const TemporaryFolder folder;
    std::ofstream(folder / "a.path") << "0.5 1 2 3 0.6 0 0 0.8\n1.5\t4 5 6 0 0 0 1";
    const RecordedPath path = readPath(folder / "a.path");
    const PathSample& first = path.samples().front();
    EXPECT_EQ(first.time, 0.5);
    EXPECT_EQ(first.pose.position, glm::dvec3(1, 2, 3));
    EXPECT_NEAR(first.pose.orientation.x, 0.6, 1e-15);
    EXPECT_NEAR(first.pose.orientation.w, 0.8, 1e-15);
}

TEST(OsgPath, ToleratesTheAnimationPathBlockCommentsAndScales) {
    const TemporaryFolder folder;
    std::ofstream(folder / "a.path")
        << "# a comment\r\nAnimationPath {\r\n  LoopMode LOOP\r\n  ControlPoints {\r\n"
           "    +0 0 0 0 0 0 0 1 1 1 1\r\n\r\n    1e0 7 0 0 0 0 0 1 1 1 1\r\n  }\r\n}\r\n";
    const RecordedPath path = readPath(folder / "a.path");
    ASSERT_EQ(path.samples().size(), 2u);
    EXPECT_EQ(path.samples()[1].pose.position.x, 7);
}

TEST(OsgPath, BadLinesAreNamed) {
    const TemporaryFolder folder;
    const std::string good = "0 0 0 0 0 0 0 1\n";
    const std::string name = (folder / "flight.path").string();
    EXPECT_THAT(readMessage(folder, ""), AllOf(HasSubstr(name), HasSubstr("at least two poses, got 0")));
    EXPECT_THAT(readMessage(folder, good), HasSubstr("at least two poses, got 1"));
    EXPECT_THAT(readMessage(folder, good + "\n0 1 0 0 0 0 0 1\n"),
                AllOf(HasSubstr(name + ":3: "), HasSubstr("expected a time after 0 s, got 0 s")));
    EXPECT_THAT(readMessage(folder, good + "-1 1 0 0 0 0 0 1\n"),
                HasSubstr(":2: expected a time after 0 s, got -1"));
    EXPECT_THAT(readMessage(folder, good + "1 1 0 0 0 0 0 0\n"), HasSubstr(":2: expected a quaternion"));
    EXPECT_THAT(readMessage(folder, good + "1 nan 0 0 0 0 0 1\n"),
                HasSubstr(":2: expected a finite position"));
    EXPECT_THAT(readMessage(folder, good + "1 inf 0 0 0 0 0 1\n"),
                HasSubstr(":2: expected a finite position"));
    EXPECT_THAT(readMessage(folder, good + "1 0 0 0 0 0 0\n"), HasSubstr(":2: expected 8 numbers, got 7"));
    EXPECT_THAT(readMessage(folder, good + "1 0 0 zero 0 0 0 1\n"),
                HasSubstr(":2: expected a number, got \"zero\""));
    EXPECT_THAT(readMessage(folder, good + "1 0 0 1.5x 0 0 0 1\n"), HasSubstr("got \"1.5x\""));
    EXPECT_THAT(readMessage(folder, std::string("\0\1\2\3 garbage", 12)), HasSubstr(":1: expected a number"));
}

// From 5 s to 9 s along x, a metre a second.
TEST(TimedPoses, NeighboursAreLaterOnThePathAndEarlierAtItsEnd) {
    const RecordedPath path(
        {{5, poseFromAngles({0, 0, 0}, 0, 0, 0)}, {9, poseFromAngles({4, 0, 0}, 0, 0, 0)}}, "");
    const std::vector<TimedPose> frames = timedFrames(path, 3), beside = timedBeside(path, frames, 0.25);
    ASSERT_EQ(beside.size(), 3u);
    const double expected[] = {0.25, 2.25, 3.75};
    for (std::size_t n = 0; n < 3; ++n) {
        EXPECT_NEAR(beside[n].time, expected[n], 1e-12);
        EXPECT_NEAR(beside[n].pose.position.x, expected[n], 1e-12);
    }
    EXPECT_TRUE(timedBeside(path, frames, 4.5).empty()) << "longer than the flight";
}

TEST(OsgPath, BadFilesAreNamedOnOneLine) {
    const TemporaryFolder folder;
    const auto missing = messageOf([&] { readPath(folder / "none.path"); });
    EXPECT_THAT(missing, AllOf(HasSubstr("none.path"), HasSubstr("can not be opened"), Not(HasSubstr("\n"))));
    EXPECT_THAT(messageOf([&] { readPath(folder / "none.csv"); }), HasSubstr("expected a path named .gltf"));
    EXPECT_THAT(messageOf([&] { writePath(folder / "none.csv", someRecordedFlight(2)); }),
                HasSubstr("expected a path named"));
    EXPECT_THAT(messageOf([&] { writePath(folder / "none.path", RecordedPath()); }),
                HasSubstr("no path to write"));
    EXPECT_FALSE(std::filesystem::exists(folder / "none.path"));
}

}  // namespace
}  // namespace stereonav
