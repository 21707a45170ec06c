#include "engine/camera/keyframes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "engine/base/error.h"
#include "engine/camera/path_sample.h"

namespace stereonav {
namespace {

constexpr double kKeyframeRate = 60;  // samples a second
constexpr double kMostKeyframeSamples = 1e6;
constexpr double kKeyframeTurn = 0.5;      // radians a second
constexpr double kShortestKeyframe = 0.1;  // seconds

void checkPlace(const Keyframes& keyframes, std::size_t place) {
    if (place >= keyframes.size())
        throw Error("", "keyframe",
                    fmt::format("expected one of {}, got number {}", keyframes.size(), place + 1),
                    "choose one that is there");
}

void checkPositive(const char* what, double value) {
    if (!(value > 0 && std::isfinite(value)))
        throw Error("", what, fmt::format("expected a number above 0, got {:g}", value), "give another one");
}

double turnBetween(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat turn = glm::conjugate(a) * b;
    return 2 * std::asin(std::min(1.0, glm::length(glm::dvec3(turn.x, turn.y, turn.z))));
}

// Returns the indices of the samples that are furthest from the curve: one for each two keyframes between
// which a sample is too far.
std::vector<std::size_t> furthestOff(const std::vector<PathSample>& samples,
                                     const std::vector<std::size_t>& keys, double metres, double radians) {
    Keyframes keyframes;
    for (const std::size_t key : keys) keyframes.push_back(samples[key]);
    const KeyframeCurve curve(keyframes, false);
    std::vector<std::size_t> furthest;
    for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
        double most = 1;
        std::size_t worst = 0;
        for (std::size_t n = keys[k] + 1; n < keys[k + 1]; ++n) {
            const Pose there = curve.at(samples[n].time), &pose = samples[n].pose;
            const double off = std::max(glm::distance(there.position, pose.position) / metres,
                                        turnBetween(there.orientation, pose.orientation) / radians);
            if (off <= most) continue;
            most = off;
            worst = n;
        }
        if (worst > 0) furthest.push_back(worst);
    }
    return furthest;
}

}  // namespace

std::size_t insertKeyframe(Keyframes& keyframes, const PathSample& keyframe) {
    if (const std::string problem = sampleProblem(nullptr, keyframe); !problem.empty())
        throw Error("", "keyframe", problem, kSampleAdvice);
    const auto after = std::lower_bound(keyframes.begin(), keyframes.end(), keyframe.time,
                                        [](const PathSample& key, double time) { return key.time < time; });
    if (after != keyframes.end() && after->time == keyframe.time)
        throw Error("", "keyframe", fmt::format("there is one at {:g} s already", keyframe.time),
                    "move or remove that one");
    const std::ptrdiff_t place = after - keyframes.begin();
    keyframes.insert(after, keyframe);
    return static_cast<std::size_t>(place);
}

void removeKeyframe(Keyframes& keyframes, std::size_t place) {
    checkPlace(keyframes, place);
    keyframes.erase(keyframes.begin() + static_cast<std::ptrdiff_t>(place));
}

Keyframes timedKeyframes(const std::vector<Pose>& poses, double metresPerSecond) {
    checkPositive("speed", metresPerSecond);
    Keyframes keyframes;
    double time = 0;
    for (const Pose& pose : poses) {
        if (!keyframes.empty()) {
            const Pose& before = keyframes.back().pose;
            time += std::max({glm::distance(before.position, pose.position) / metresPerSecond,
                              turnBetween(before.orientation, pose.orientation) / kKeyframeTurn,
                              kShortestKeyframe});
        }
        insertKeyframe(keyframes, {time, pose});
    }
    return keyframes;
}

RecordedPath pathThrough(const Keyframes& keyframes, bool easeEnds) {
    const KeyframeCurve curve(keyframes, easeEnds);
    const double duration = curve.endTime() - curve.startTime();
    const double pieces = std::clamp(std::ceil(duration * kKeyframeRate), 1.0, kMostKeyframeSamples);
    std::vector<double> times;
    for (const PathSample& key : keyframes) times.push_back(key.time);
    for (double k = 1; k < pieces; ++k) times.push_back(curve.startTime() + duration * k / pieces);
    std::sort(times.begin(), times.end());
    std::vector<PathSample> samples;
    for (const double time : times)
        if (samples.empty() || time > samples.back().time) samples.push_back({time, curve.at(time)});
    return RecordedPath(std::move(samples), "keyframes");
}

// Returns the first and the last pose, and as many poses between them as keep the curve close enough to the
// flight everywhere. metres, radians: largest deviations.
Keyframes keyframesOf(const RecordedPath& path, double metres, double radians) {
    checkPositive("distance", metres);
    checkPositive("angle", radians);
    const std::vector<PathSample>& samples = path.samples();
    if (samples.size() < 2)
        throw Error("", "path", "expected one with at least two poses, got none", "record a flight first");
    std::vector<std::size_t> keys{0, samples.size() - 1};
    for (;;) {
        const std::vector<std::size_t> more = furthestOff(samples, keys, metres, radians);
        if (more.empty()) break;
        keys.insert(keys.end(), more.begin(), more.end());
        std::sort(keys.begin(), keys.end());
    }
    Keyframes keyframes;
    for (const std::size_t key : keys) keyframes.push_back(samples[key]);
    return keyframes;
}

}  // namespace stereonav
