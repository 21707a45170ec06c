#include "app/view/flight_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/stop.h"

namespace stereonav {

FlightRecording::~FlightRecording() {
    if (!recording()) return;
    const FinishingWork finishing;
    try {
        keepRecorded(finish());
    } catch (const std::exception&) {
        // Nothing was flown, or it has been reported that it can not be kept.
    }
}

void FlightRecording::start(const Pose& pose) {
    settle();
    mFile.clear();
    mKept = 0;
    mProblem.clear();
    mProblemTold = false;
    mRecorder.start(pose);
}

void FlightRecording::step(double dt, const Pose& pose) {
    mRecorder.step(dt, pose);
    if (!recording() || duration() - mKept < std::max(kKeptEvery_s, kKeptShare * duration())) return;
    if (mWriting.valid() && mWriting.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    settle();
    if (mFile.empty()) mFile = newFile();
    mKept = duration();
    mWriting = std::async(std::launch::async, [file = mFile, samples = mRecorder.samples()] {
        writePath(file, RecordedPath(samples, "recording"));
    });
}

void FlightRecording::settle() {
    if (!mWriting.valid()) return;
    try {
        mWriting.get();
    } catch (const std::exception& error) {
        mProblem = error.what();
        std::error_code code;
        if (!std::filesystem::exists(mFile, code)) mFile.clear();  // others may make a file of this name
    }
}

RecordedPath FlightRecording::finish() {
    settle();
    return mRecorder.finish();
}

std::filesystem::path FlightRecording::keepRecorded(const RecordedPath& path) {
    settle();
    std::filesystem::path file = std::exchange(mFile, {});
    if (!file.empty()) try {
            writePath(file, path);
            return file;
        } catch (const Error&) {
            // A file that was opened meanwhile as a flight to play must not be overwritten.
        }
    return keep(path);
}

std::filesystem::path FlightRecording::keep(const RecordedPath& path) const {
    std::filesystem::path file = newFile();
    writePath(file, path);
    return file;
}

std::filesystem::path FlightRecording::newFile() const {
    std::filesystem::path file;
    int number = 1;
    do file = mFolder / fmt::format("flight_{:04}.gltf", number++);
    while (std::filesystem::exists(file));
    return file;
}

std::string FlightRecording::takeProblem() {
    if (mProblem.empty() || std::exchange(mProblemTold, true)) return "";
    return "the recording is not kept as it is made: " + mProblem;
}

}  // namespace stereonav
