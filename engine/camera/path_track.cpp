// Keyframes of one glTF animation channel; formulas from the glTF 2.0 specification, appendix C.
#include "engine/camera/path_track.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr const char* kAdvice = "export the animation again";

glm::dvec4 slerpVector(const glm::dvec4& a, const glm::dvec4& b, double share) {
    const glm::dquat q = glm::slerp(glm::normalize(glm::dquat(a.w, a.x, a.y, a.z)),
                                    glm::normalize(glm::dquat(b.w, b.x, b.y, b.z)), share);
    return {q.x, q.y, q.z, q.w};
}

Interpolation interpolationOf(const GltfFile& file, const std::string& name, const std::string& place) {
    if (name == "LINEAR" || name.empty()) return Interpolation::Linear;
    if (name == "STEP") return Interpolation::Step;
    if (name == "CUBICSPLINE") return Interpolation::CubicSpline;
    throw Error(file.name, place, "expected LINEAR, STEP or CUBICSPLINE, got \"" + name + "\"", kAdvice);
}

void checkTimes(const GltfFile& file, const std::vector<double>& times, const std::string& place) {
    if (times.empty()) throw Error(file.name, place, "expected keyframes, found none", kAdvice);
    for (std::size_t k = 1; k < times.size(); ++k)
        if (!(times[k] > times[k - 1]))
            throw Error(file.name, fmt::format("{}, keyframe {}", place, k),
                        fmt::format("expected a time after {} s, got {} s", times[k - 1], times[k]), kAdvice);
}

void checkRotations(const GltfFile& file, const PathTrack& track, const std::string& place) {
    const bool cubic = track.interpolation == Interpolation::CubicSpline;
    for (std::size_t k = 0; k < track.times.size(); ++k)
        if (!(glm::length(track.values[cubic ? 3 * k + 1 : k]) > 1e-9))
            throw Error(file.name, fmt::format("{}, keyframe {}", place, k),
                        "expected a quaternion that is not zero", kAdvice);
}

}  // namespace

PathTrack readPathTrack(const GltfFile& file, int animationIndex, int channelIndex) {
    const tinygltf::Animation& animation = file.model.animations[animationIndex];
    const tinygltf::AnimationChannel& channel = animation.channels[channelIndex];
    const std::string place = fmt::format("animation {}, channel {}", animationIndex, channelIndex);
    if (channel.sampler < 0 || static_cast<std::size_t>(channel.sampler) >= animation.samplers.size())
        throw Error(file.name, place,
                    fmt::format("refers to sampler {} of {}", channel.sampler, animation.samplers.size()),
                    kAdvice);
    const std::string& target = channel.target_path;
    if (target != "translation" && target != "rotation" && target != "scale")
        throw Error(file.name, place, "expected translation, rotation or scale, got \"" + target + "\"",
                    kAdvice);
    const tinygltf::AnimationSampler& sampler = animation.samplers[channel.sampler];
    PathTrack track;
    track.interpolation = interpolationOf(file, sampler.interpolation, place);
    track.isRotation = target == "rotation";
    track.times = accessorValues(file, sampler.input, 1, place);
    checkTimes(file, track.times, place);
    const int components = track.isRotation ? 4 : 3;
    const std::vector<double> numbers = accessorValues(file, sampler.output, components, place);
    const std::size_t expected =
        track.times.size() * (track.interpolation == Interpolation::CubicSpline ? 3 : 1);
    if (numbers.size() != expected * components)
        throw Error(file.name, place,
                    fmt::format("expected {} values for {} times, got {}", expected, track.times.size(),
                                numbers.size() / components),
                    kAdvice);
    for (std::size_t k = 0; k < numbers.size(); k += components)
        track.values.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2],
                                  components == 4 ? numbers[k + 3] : 0);
    if (track.isRotation) checkRotations(file, track, place);
    return track;
}

glm::dvec4 PathTrack::at(double time, bool left) const {
    const bool cubic = interpolation == Interpolation::CubicSpline;
    const auto value = [&](std::size_t k) { return values[cubic ? 3 * k + 1 : k]; };
    const auto after = left ? std::lower_bound(times.begin(), times.end(), time)
                            : std::upper_bound(times.begin(), times.end(), time);
    if (after == times.begin()) return value(0);
    if (after == times.end()) return value(times.size() - 1);
    const std::size_t k = static_cast<std::size_t>(after - times.begin()) - 1;
    const double span = times[k + 1] - times[k], s = (time - times[k]) / span;
    if (interpolation == Interpolation::Step) return value(k);
    if (!cubic)
        return isRotation ? slerpVector(value(k), value(k + 1), s) : glm::mix(value(k), value(k + 1), s);
    const double s2 = s * s, s3 = s2 * s;
    const glm::dvec4 outTangent = values[3 * k + 2], inTangent = values[3 * k + 3];
    const glm::dvec4 result = (2 * s3 - 3 * s2 + 1) * value(k) + span * (s3 - 2 * s2 + s) * outTangent +
                              (3 * s2 - 2 * s3) * value(k + 1) + span * (s3 - s2) * inTangent;
    return isRotation && glm::length(result) > 1e-12 ? glm::normalize(result) : result;
}

}  // namespace stereonav
