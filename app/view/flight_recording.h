// Recording of a flight, saved during the flight: when the program is ended, or killed, the part flown so far
// is in the file. The file is a new one, flight_0001.gltf and so on.
#pragma once

#include <filesystem>
#include <future>
#include <string>

#include "engine/nav/path_recorder.h"

namespace stereonav {

class FlightRecording {
public:
    // Most of a flight that is lost when the program is killed: seconds, and for long flights a share.
    static constexpr double kKeptEvery_s = 1, kKeptShare = 1.0 / 60;

    explicit FlightRecording(std::filesystem::path folder) : mFolder(std::move(folder)) {}
    ~FlightRecording();  // ends the recording and saves it
    FlightRecording(const FlightRecording&) = delete;
    FlightRecording& operator=(const FlightRecording&) = delete;

    void start(const Pose& pose);
    // Adds a pose dt seconds later. Does nothing unless recording().
    void step(double dt, const Pose& pose);
    // Ends the recording. Throws Error where nothing was flown.
    RecordedPath finish();
    // Writes the flight into the file of its recording, or else a new one. Returns the file. Throws Error.
    std::filesystem::path keepRecorded(const RecordedPath& path);
    // Writes any flight into a new file. Returns the file. Throws Error.
    std::filesystem::path keep(const RecordedPath& path) const;

    bool recording() const { return mRecorder.recording(); }
    double duration() const { return mRecorder.duration(); }  // seconds
    // Returns once why the flight can not be saved; "": it can.
    std::string takeProblem();

private:
    std::filesystem::path newFile() const;
    void settle();  // waits for a file that is being written

    std::filesystem::path mFolder, mFile;  // mFile: "" until something was written
    PathRecorder mRecorder;
    double mKept = 0;  // seconds of flight in the file, or being written
    std::string mProblem;
    bool mProblemTold = false;
    std::future<void> mWriting;
};

}  // namespace stereonav
