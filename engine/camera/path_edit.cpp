#include "engine/camera/path_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr double kLongestCut = 0.001;      // seconds
constexpr double kCutSpeed = 20;           // times the mean speed without cuts
constexpr double kStanding = 1e-3;         // share of the mean speed: slower is standing
constexpr double kTurns = 1e-4;            // radians a second: slower is no turning
constexpr double kFastestPacedTurn = 1;    // radians a second
constexpr double kSmoothRate = 60;         // samples a second, and
constexpr double kSmoothFineness = 8;      // samples a standard deviation
constexpr double kMostSmoothed = 100'000;  // samples of a stretch
constexpr double kMostOfStretch = 0.25;    // standard deviation at most, as a share of the stretch's time
constexpr int kBoxes = 4;

using Samples = std::vector<PathSample>;

const Samples& samplesOf(const RecordedPath& path) {
    if (path.samples().size() < 2)
        throw Error("", "path", "expected one with at least two poses, got none", "record a flight first");
    return path.samples();
}

double angleOfTurn(const Pose& a, const Pose& b) {
    const glm::dquat turn = glm::conjugate(a.orientation) * b.orientation;
    return 2 * std::asin(std::min(1.0, glm::length(glm::dvec3(turn.x, turn.y, turn.z))));
}

double stepSeconds(const Samples& samples, std::size_t k) {
    return samples[k + 1].time - samples[k].time;
}

double stepLength(const Samples& samples, std::size_t k) {
    return glm::distance(samples[k].pose.position, samples[k + 1].pose.position);
}

// Metres a second, on average, of the steps that are too long to be cuts; of all where there is none.
double meanSpeed(const Samples& samples) {
    double length = 0, seconds = 0, all = 0;
    for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
        all += stepLength(samples, k);
        if (stepSeconds(samples, k) <= kLongestCut) continue;
        length += stepLength(samples, k);
        seconds += stepSeconds(samples, k);
    }
    return seconds > 0 ? length / seconds : all / (samples.back().time - samples.front().time);
}

bool isCut(const Samples& samples, std::size_t k, double mean) {
    const double seconds = stepSeconds(samples, k);
    return seconds <= kLongestCut && stepLength(samples, k) > kCutSpeed * mean * seconds;
}

// The index of the sample before each cut.
std::vector<std::size_t> cutsOf(const Samples& samples) {
    std::vector<std::size_t> cuts;
    // A recording that is faster than a sample a millisecond has steps as short as cuts, and none of them.
    const double mean = meanSpeed(samples);
    for (std::size_t k = 0; k + 1 < samples.size(); ++k)
        if (isCut(samples, k, mean)) cuts.push_back(k);
    return cuts;
}

// --- smoothing

// One coordinate or another of a stretch, odd about both ends: so they stay.
template <typename T>
T extended(const std::vector<T>& values, std::ptrdiff_t k) {
    const auto last = static_cast<std::ptrdiff_t>(values.size()) - 1;
    if (k < 0) return 2.0 * values.front() - values[std::min(-k, last)];
    if (k > last) return 2.0 * values.back() - values[std::max<std::ptrdiff_t>(2 * last - k, 0)];
    return values[k];
}

struct Box {
    std::ptrdiff_t reach = 0;  // samples to each side with full weight
    double edge = 0;           // weight of the next ones
};

// The box filter of this variance, in samples squared (Gwosdek et al. 2011, equations 10 and 11).
Box boxOf(double variance) {
    const double l = std::floor(0.5 * std::sqrt(12 * variance + 1) - 0.5);
    const double edge = (2 * l + 1) * (l * (l + 1) - 3 * variance) / (6 * (variance - (l + 1) * (l + 1)));
    return {static_cast<std::ptrdiff_t>(l), edge};
}

// A running sum that is begun anew now and then, so that rounding does not add up.
template <typename T>
std::vector<T> boxed(const std::vector<T>& values, const Box& box) {
    constexpr std::ptrdiff_t kAnew = 512;
    const double weight = 1 / (2.0 * static_cast<double>(box.reach) + 1 + 2 * box.edge);
    std::vector<T> means(values.size());
    T sum = values.front();
    for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(values.size()); ++k) {
        if (k % kAnew == 0) {
            sum = extended(values, k);
            for (std::ptrdiff_t j = 1; j <= box.reach; ++j)
                sum += extended(values, k - j) + extended(values, k + j);
        } else {
            sum += extended(values, k + box.reach) - extended(values, k - box.reach - 1);
        }
        means[k] =
            weight *
            (sum + box.edge * (extended(values, k - box.reach - 1) + extended(values, k + box.reach + 1)));
    }
    return means;
}

glm::dvec4 vectorOf(const glm::dquat& q) {
    return {q.x, q.y, q.z, q.w};
}

glm::dquat unitOf(const glm::dvec4& v, const glm::dquat& otherwise) {
    const double size = glm::length(v);
    return size > 1e-6 ? glm::dquat(v.w / size, v.x / size, v.y / size, v.z / size) : otherwise;
}

// A stretch without cuts, sampled evenly.
Samples smoothedStretch(const RecordedPath& path, double begin, double end, double seconds) {
    const double duration = end - begin, deviation = std::min(seconds, kMostOfStretch * duration);
    const double wanted = std::min(1 / kSmoothRate, deviation / kSmoothFineness);
    const auto pieces =
        static_cast<std::size_t>(std::clamp(std::ceil(duration / wanted), 1.0, kMostSmoothed - 1));
    std::vector<glm::dvec3> places;
    std::vector<glm::dvec4> turns;
    Samples samples;
    for (std::size_t k = 0; k <= pieces; ++k) {
        const double time = k == pieces ? end : begin + duration * static_cast<double>(k) / double(pieces);
        samples.push_back({time, path.at(time)});
        places.push_back(samples.back().pose.position);
        const glm::dvec4 turn = vectorOf(samples.back().pose.orientation);
        turns.push_back(!turns.empty() && glm::dot(turns.back(), turn) < 0 ? -turn : turn);
    }
    const double step = duration / double(pieces);
    const Box box = boxOf(deviation * deviation / (step * step) / kBoxes);
    for (int pass = 0; pass < kBoxes; ++pass) {
        places = boxed(places, box);
        turns = boxed(turns, box);
        for (std::size_t k = 0; k <= pieces; ++k)
            turns[k] = vectorOf(unitOf(turns[k], samples[k].pose.orientation));
    }
    for (std::size_t k = 1; k < pieces; ++k)  // the ends are there already, exactly
        samples[k].pose = {places[k], unitOf(turns[k], samples[k].pose.orientation)};
    return samples;
}

// --- pace

// A step of the path as its new time is found.
struct Step {
    double seconds, length, atLeast;  // atLeast: seconds
    bool cut;
};

std::vector<Step> stepsOf(const Samples& samples) {
    const double mean = meanSpeed(samples);
    std::vector<Step> steps;
    for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
        const double seconds = stepSeconds(samples, k), length = stepLength(samples, k),
                     angle = angleOfTurn(samples[k].pose, samples[k + 1].pose);
        const bool cut = isCut(samples, k, mean), turns = angle > kTurns * seconds,
                   stands = length <= kStanding * mean * seconds;
        double atLeast = 0;
        if (cut || (stands && turns))
            atLeast = seconds;
        else if (turns)
            atLeast = std::min(seconds, angle / kFastestPacedTurn);
        steps.push_back({seconds, cut || stands ? 0.0 : length, atLeast, cut});
    }
    return steps;
}

double secondsAt(const Step& step, double speed) {
    return std::max(step.atLeast, step.length / speed);
}

double durationAt(const std::vector<Step>& steps, double speed) {
    double sum = 0;
    for (const Step& step : steps) sum += secondsAt(step, speed);
    return sum;
}

// Returns the speed at which the whole takes so long: the faster, the less time.
double speedForDuration(const std::vector<Step>& steps, double length, double duration) {
    double slow = length / duration, fast = slow;
    while (durationAt(steps, fast) > duration && fast < 1e9 * slow) fast *= 2;
    for (int k = 0; k < 80; ++k) {
        const double middle = std::sqrt(slow * fast);
        (durationAt(steps, middle) > duration ? slow : fast) = middle;
    }
    return fast;
}

}  // namespace

RecordedPath trimmed(const RecordedPath& path, double from, double to) {
    const Samples& all = samplesOf(path);
    const double begin = path.startTime() + std::max(from, 0.0),
                 end = path.startTime() + std::min(to, path.duration());
    if (!std::isfinite(from) || !std::isfinite(to) || !(begin < end))
        throw Error(
            "", "path",
            fmt::format("expected a part of its 0 to {:g} s, got {:g} to {:g} s", path.duration(), from, to),
            "give a start before the end");
    Samples part{{0, path.at(begin)}};
    for (const PathSample& sample : all)
        if (sample.time > begin && sample.time < end && sample.time - begin > part.back().time)
            part.push_back({sample.time - begin, sample.pose});
    if (end - begin > part.back().time)
        part.push_back({end - begin, path.at(end)});
    else
        part.back().pose = path.at(end);
    return RecordedPath(std::move(part), "path");
}

RecordedPath smoothed(const RecordedPath& path, double seconds) {
    const Samples& all = samplesOf(path);
    if (!(seconds >= 0 && std::isfinite(seconds)))
        throw Error("", "smoothing", fmt::format("expected seconds from 0, got {:g}", seconds),
                    "give another time");
    if (seconds == 0) return trimmed(path, 0, path.duration());
    std::vector<std::size_t> ends = cutsOf(all);
    ends.push_back(all.size() - 1);
    Samples result;
    std::size_t first = 0;
    for (const std::size_t last : ends) {
        Samples stretch{all[first]};
        if (last > first) stretch = smoothedStretch(path, all[first].time, all[last].time, seconds);
        for (PathSample& sample : stretch) {
            sample.time -= path.startTime();
            if (result.empty() || sample.time > result.back().time) result.push_back(sample);
        }
        result.back().pose = all[last].pose;
        first = last + 1;
    }
    return RecordedPath(std::move(result), "path");
}

RecordedPath evenlyPaced(const RecordedPath& path, std::optional<double> metresPerSecond) {
    const Samples& all = samplesOf(path);
    if (metresPerSecond && !(*metresPerSecond > 0 && std::isfinite(*metresPerSecond)))
        throw Error("", "speed", fmt::format("expected metres a second above 0, got {:g}", *metresPerSecond),
                    "give another speed");
    const std::vector<Step> steps = stepsOf(all);
    double length = 0;
    for (const Step& step : steps) length += step.length;
    if (!(length > 0)) return trimmed(path, 0, path.duration());
    const double speed = metresPerSecond.value_or(speedForDuration(steps, length, path.duration()));
    Samples paced{{0, all.front().pose}};
    double time = 0;
    for (std::size_t k = 0; k < steps.size(); ++k) {
        time += secondsAt(steps[k], speed);
        // A step without duration replaces the pose of the one before.
        if (time > paced.back().time * (1 + 1e-12))
            paced.push_back({time, all[k + 1].pose});
        else if (paced.size() > 1)
            paced.back().pose = all[k + 1].pose;
    }
    return RecordedPath(std::move(paced), "path");
}

}  // namespace stereonav
