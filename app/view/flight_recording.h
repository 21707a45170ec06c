// A flight that is recorded, and kept in a file as it is made: what was flown so far is there when the
// program is ended, or killed. The file is a new one, flight_0001.gltf and so on.
#pragma once

#include <filesystem>
#include <future>
#include <string>

#include "engine/nav/path_recorder.h"

namespace stereonav {

class FlightRecording {
public:
    // What is lost at most when the program is killed: seconds of flight, and of long ones such a share.
    static constexpr double kKeptEvery_s = 1, kKeptShare = 1.0 / 60;

    explicit FlightRecording(std::filesystem::path folder) : mFolder(std::move(folder)) {}
    ~FlightRecording();  // ends the recording, and keeps it
    FlightRecording(const FlightRecording&) = delete;
    FlightRecording& operator=(const FlightRecording&) = delete;

    void start(const Pose& pose);
    // dt seconds later the viewer is here. Nothing happens unless recording().
    void step(double dt, const Pose& pose);
    // Ends it. Throws Error where nothing was flown.
    RecordedPath finish();
    // Writes it into the file that it has so far, else into a new one. Returns the file. Throws Error.
    std::filesystem::path keepRecorded(const RecordedPath& path);
    // Writes any path into a new file. The same.
    std::filesystem::path keep(const RecordedPath& path) const;

    bool recording() const { return mRecorder.recording(); }
    double duration() const { return mRecorder.duration(); }  // seconds
    // Why it can not be kept as it is made, told once; "": it can.
    std::string takeProblem();

private:
    std::filesystem::path newFile() const;
    void settle();  // waits for what is on its way

    std::filesystem::path mFolder, mFile;  // mFile: "" until something was written
    PathRecorder mRecorder;
    double mKept = 0;  // seconds of flight that are in the file, or on their way
    std::string mProblem;
    bool mProblemTold = false;
    std::future<void> mWriting;
};

}  // namespace stereonav
