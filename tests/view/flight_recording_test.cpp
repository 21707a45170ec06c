// A recording is in a file of its own from its first second on, however it ends.
#include "app/view/flight_recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <memory>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/wait_for.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

constexpr double kTurn = 1.0 / 32;  // seconds, whose sums are exact

Pose poseAt(double seconds) {
    return poseFromAngles({10 * seconds, 0, 5}, 0, 0, 0);
}

class FlightRecordingTest : public testing::Test {
protected:
    // Flies for another `seconds`, at 10 m/s along x.
    void fly(FlightRecording& recording, double seconds) {
        for (double flown = 0; flown < seconds; flown += kTurn) {
            mNow += kTurn;
            recording.step(kTurn, poseAt(mNow));
        }
    }
    void begin(FlightRecording& recording) {
        mNow = 0;
        recording.start(poseAt(0));
    }
    fs::path file(int number) const { return mFolder / ("flight_000" + std::to_string(number) + ".gltf"); }
    // Returns the duration in the file, and checks that it is that flight.
    static double flownIn(const fs::path& file) {
        const RecordedPath path = readPath(file);
        EXPECT_NEAR(path.at(path.startTime() + path.duration()).position.x, 10 * path.duration(), 1e-4);
        return path.duration();
    }

    TemporaryFolder mFolder;
    double mNow = 0;
};

TEST_F(FlightRecordingTest, IsInItsFileWhileItGoesOn) {
    FlightRecording recording(mFolder / "");
    begin(recording);
    fly(recording, 0.5);
    EXPECT_FALSE(fs::exists(file(1)));
    fly(recording, 0.5);
    ASSERT_TRUE(test::waitFor([&] { return fs::exists(file(1)); }));
    EXPECT_NEAR(flownIn(file(1)), 1, kTurn);
    // The file then has the later part, too, after at most a second of flight.
    for (int more = 0; more < 3; ++more) {
        const double before = flownIn(file(1));
        ASSERT_TRUE(test::waitFor([&] {
            fly(recording, 1);
            return flownIn(file(1)) > before;
        }));
    }
    const double flown = mNow;
    EXPECT_EQ(recording.keepRecorded(recording.finish()), file(1));
    EXPECT_NEAR(flownIn(file(1)), flown, 1e-4);
    EXPECT_FALSE(fs::exists(file(2)));
}

TEST_F(FlightRecordingTest, IsKeptWhereItsOwnerEnds) {
    for (const double seconds : {0.25, 2.25}) {
        auto recording = std::make_unique<FlightRecording>(mFolder / "");
        begin(*recording);
        fly(*recording, seconds);
        recording.reset();
        const fs::path kept = file(seconds < 1 ? 1 : 2);
        ASSERT_TRUE(fs::exists(kept)) << seconds;
        EXPECT_NEAR(flownIn(kept), seconds, 1e-4);
    }
    FlightRecording idle(mFolder / "");
    begin(idle);
    EXPECT_THROW(idle.finish(), Error) << "nothing was flown";
}

TEST_F(FlightRecordingTest, NeverTakesThePlaceOfAFile) {
    std::ofstream(file(1)) << "of yesterday";
    std::ofstream(file(3)) << "of yesterday, too";
    FlightRecording recording(mFolder / "");
    for (const int number : {2, 4}) {
        begin(recording);
        fly(recording, 1.5);
        EXPECT_EQ(recording.keepRecorded(recording.finish()), file(number));
    }
    EXPECT_EQ(recording.keep(readPath(file(2))), file(5)) << "saved once more";
    // Two windows record in one folder.
    FlightRecording other(mFolder / "");
    begin(recording);
    fly(recording, 1.5);
    ASSERT_TRUE(test::waitFor([&] { return fs::exists(file(6)); }));
    begin(other);
    fly(other, 1.5);
    EXPECT_EQ(other.keepRecorded(other.finish()), file(7));
    EXPECT_EQ(recording.keepRecorded(recording.finish()), file(6));
    EXPECT_EQ(readTextFile(file(1)), "of yesterday");
    EXPECT_EQ(readTextFile(file(3)), "of yesterday, too");
}

// A recording's file that is opened meanwhile is an input, and can not be written. Here a folder takes its
// place.
TEST_F(FlightRecordingTest, GoesIntoAnotherFileWhereItsOwnCanNotBeWritten) {
    FlightRecording recording(mFolder / "");
    begin(recording);
    fly(recording, 1);
    ASSERT_TRUE(test::waitFor([&] { return fs::exists(file(1)); }));
    fs::remove(file(1));
    fs::create_directory(file(1));
    fly(recording, 0.25);
    EXPECT_EQ(recording.keepRecorded(recording.finish()), file(2));
    EXPECT_NEAR(flownIn(file(2)), 1.25, 1e-4);
}

TEST_F(FlightRecordingTest, WhatCanNotBeKeptIsToldOnce) {
    FlightRecording recording(mFolder / "none");
    begin(recording);
    std::string problem;
    ASSERT_TRUE(test::waitFor([&] {
        fly(recording, 1);
        problem = recording.takeProblem();
        return !problem.empty();
    }));
    EXPECT_THAT(problem, testing::HasSubstr("there is no folder"));
    fly(recording, 3);
    EXPECT_EQ(recording.takeProblem(), "");
    const RecordedPath path = recording.finish();
    EXPECT_NEAR(path.duration(), mNow, 1e-9) << "it is there all the same";
    EXPECT_THROW(recording.keepRecorded(path), Error);
}

}  // namespace
}  // namespace stereonav
