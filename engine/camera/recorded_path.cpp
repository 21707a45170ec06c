// Recorded paths: the checks, the playback clock, and the choice of file format.
#include "engine/camera/recorded_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/camera/path_formats.h"
#include "engine/camera/path_sample.h"
#include "engine/gltf/gltf_file.h"

namespace stereonav {
namespace {

constexpr double kMaxFrames = 1e7;  // four days at 30 frames a second: more is a slip of the keyboard

bool isFinite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Returns the length by components: overflow and underflow of the squares are treated as not finite and as
// zero.
double length(const glm::dquat& q) {
    return std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
}

[[noreturn]] void throwUnknownFormat(const std::filesystem::path& file) {
    throw Error(
        file.string(), "",
        fmt::format("expected a path named .gltf, .glb or .path, got \"{}\"", file.extension().string()),
        "give the file one of these extensions");
}

bool isOsg(const std::filesystem::path& file) {
    return file.extension() == ".path" || file.extension() == ".PATH";
}

}  // namespace

std::string sampleProblem(const PathSample* before, const PathSample& sample) {
    if (!std::isfinite(sample.time)) return fmt::format("expected a finite time, got {}", sample.time);
    if (before && !(sample.time > before->time))
        return fmt::format("expected a time after {} s, got {} s", before->time, sample.time);
    const glm::dvec3& p = sample.pose.position;
    if (!isFinite(p)) return fmt::format("expected a finite position, got {} {} {}", p.x, p.y, p.z);
    const glm::dquat& q = sample.pose.orientation;
    const double norm = length(q);
    if (!std::isfinite(norm))
        return fmt::format("expected a finite rotation, got {} {} {} {}", q.x, q.y, q.z, q.w);
    if (!(norm > 1e-9)) return "expected a quaternion x y z w that is not zero";
    return "";
}

RecordedPath::RecordedPath(std::vector<PathSample> samples, const std::string& source)
    : mSamples(std::move(samples)) {
    if (mSamples.size() < 2)
        throw Error(source, "", fmt::format("expected at least two poses, got {}", mSamples.size()),
                    "record or export a path that moves");
    for (std::size_t k = 0; k < mSamples.size(); ++k) {
        const std::string problem = sampleProblem(k > 0 ? &mSamples[k - 1] : nullptr, mSamples[k]);
        if (!problem.empty())
            throw Error(source, fmt::format("pose {} of {}", k + 1, mSamples.size()), problem, kSampleAdvice);
        mSamples[k].pose.orientation = mSamples[k].pose.orientation / length(mSamples[k].pose.orientation);
    }
}

Pose RecordedPath::at(double time) const {
    if (mSamples.empty()) return {};
    const auto after = std::upper_bound(mSamples.begin(), mSamples.end(), time,
                                        [](double t, const PathSample& s) { return t < s.time; });
    if (after == mSamples.begin()) return mSamples.front().pose;
    if (after == mSamples.end()) return mSamples.back().pose;
    const PathSample& a = *(after - 1);
    const PathSample& b = *after;
    const double share = (time - a.time) / (b.time - a.time);
    // glm::slerp takes the shorter of the two ways.
    return {glm::mix(a.pose.position, b.pose.position, share),
            glm::normalize(glm::slerp(a.pose.orientation, b.pose.orientation, share))};
}

std::vector<Pose> RecordedPath::frames(int count) const {
    std::vector<Pose> poses;
    if (mSamples.empty()) return poses;
    for (int n = 0; n < count; ++n) {
        const bool last = n > 0 && n == count - 1;
        poses.push_back(last ? mSamples.back().pose
                             : at(startTime() + duration() * n / std::max(1, count - 1)));
    }
    return poses;
}

std::vector<Pose> RecordedPath::framesAtRate(double framesPerSecond) const {
    if (!(framesPerSecond > 0 && std::isfinite(framesPerSecond)))
        throw Error("", "frame rate", fmt::format("expected a rate above 0, got {:g}", framesPerSecond),
                    "give another --fps");
    std::vector<Pose> poses;
    if (mSamples.empty()) return poses;
    // A frame that misses the end only by rounding belongs to the path (2 s at 25: 51 frames).
    const double last = std::floor(duration() * framesPerSecond * (1 + 1e-12) + 1e-9);
    if (!(last < kMaxFrames))
        throw Error("", "frame rate", fmt::format("a path of {:g} s has {:g} frames", duration(), last + 1),
                    fmt::format("expected at most {:g}: give a lower --fps", kMaxFrames));
    for (int n = 0; n <= static_cast<int>(last); ++n) poses.push_back(at(startTime() + n / framesPerSecond));
    return poses;
}

RecordedPath readPath(const std::filesystem::path& file) {
    if (isOsg(file)) return readOsgPath(file);
    if (hasGltfExtension(file)) return readGltfPath(file);
    throwUnknownFormat(file);
}

void writePath(const std::filesystem::path& file, const RecordedPath& path) {
    if (path.samples().size() < 2)
        throw Error(file.string(), "", "there is no path to write", "record at least two poses");
    if (isOsg(file)) return writeOsgPath(file, path);
    if (hasGltfExtension(file)) return writeGltfPath(file, path);
    throwUnknownFormat(file);
}

}  // namespace stereonav
