// A recorded flight: poses at times. Playback follows the path's own clock, so that it is even and the same
// every time, at any frame rate.
#pragma once

#include <filesystem>
#include <vector>

#include "engine/camera/pose.h"

namespace stereonav {

// A pose at a time of the path's clock.
struct PathSample {
    double time;  // seconds, strictly increasing along a path
    Pose pose;
};

// Poses over time, interpolated between samples.
class RecordedPath {
public:
    RecordedPath() = default;
    // Throws Error (named `source`) unless there are at least two samples, times are finite and
    // strictly increasing, positions finite and quaternions not zero; quaternions are normalised.
    RecordedPath(std::vector<PathSample> samples, const std::string& source);

    const std::vector<PathSample>& samples() const { return mSamples; }
    double startTime() const { return mSamples.front().time; }  // seconds
    // Seconds from the first sample to the last one.
    double duration() const { return mSamples.back().time - mSamples.front().time; }

    // Returns the pose at a time in seconds, clamped to the ends: position linear, orientation
    // spherical-linear between the two samples around it.
    Pose at(double time) const;

    // Returns the poses of `count` frames evenly spread over the whole path, including first and last (count
    // 1: the first).
    std::vector<Pose> frames(int count) const;
    // Returns the poses of frames at a fixed rate, from the start time to the end. Throws Error unless the
    // rate is above 0, and for more frames than an int can count.
    std::vector<Pose> framesAtRate(double framesPerSecond) const;

private:
    std::vector<PathSample> mSamples;
};

// Reads or writes a path by its extension: .gltf and .glb (an animated camera node; y up is turned to z up),
// .path (OpenSceneGraph text: t x y z qx qy qz qw a line). Throws Error with file and place.
RecordedPath readPath(const std::filesystem::path& file);
void writePath(const std::filesystem::path& file, const RecordedPath& path);

}  // namespace stereonav
