// Keeps samples at least an interval apart, and always the first and the last.
#include "engine/nav/path_recorder.h"

#include <utility>

#include "engine/base/error.h"

namespace stereonav {

void PathRecorder::start(const Pose& pose) {
    mRecording = true;
    mTime = mLastKept = 0;
    mSamples.assign(1, {0.0, pose});
}

void PathRecorder::step(double dt, const Pose& pose) {
    if (!mRecording || !(dt > 0)) return;
    mTime += dt;
    // The newest sample is replaced until it is an interval away from the one before.
    const bool newestStays = mSamples.size() == 1 || mSamples.back().time - mLastKept >= mInterval;
    if (newestStays) {
        mLastKept = mSamples.back().time;
        mSamples.push_back({mTime, pose});
    } else {
        mSamples.back() = {mTime, pose};
    }
}

RecordedPath PathRecorder::finish() {
    mRecording = false;
    if (mSamples.size() < 2)
        throw Error("recording", "", "nothing was flown while recording", "fly before ending the recording");
    return RecordedPath(std::exchange(mSamples, {}), "recording");
}

}  // namespace stereonav
