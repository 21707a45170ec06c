#include "engine/camera/timed_poses.h"

namespace stereonav {
namespace {

std::vector<TimedPose> timed(const std::vector<Pose>& poses, double between) {
    std::vector<TimedPose> result;
    result.reserve(poses.size());
    for (const Pose& pose : poses) result.push_back({pose, between * static_cast<double>(result.size())});
    return result;
}

}  // namespace

std::vector<TimedPose> timedFrames(const RecordedPath& path, int count) {
    return timed(path.frames(count), count > 1 ? path.duration() / (count - 1) : 0.0);
}

std::vector<TimedPose> timedBeside(const RecordedPath& path, const std::vector<TimedPose>& frames,
                                   double seconds) {
    std::vector<TimedPose> beside;
    if (path.duration() < seconds) return beside;
    for (const TimedPose& frame : frames) {
        const bool atItsEnd = frame.time + seconds > path.duration();
        const double time = atItsEnd ? frame.time - seconds : frame.time + seconds;
        beside.push_back({path.at(path.startTime() + time), time});
    }
    return beside;
}

std::vector<TimedPose> timedFramesAtRate(const RecordedPath& path, double framesPerSecond) {
    return timed(path.framesAtRate(framesPerSecond), 1 / framesPerSecond);
}

}  // namespace stereonav
