#include "terrain/scene/followed_track.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/base/error.h"
#include "engine/camera/default_eyes.h"

namespace stereonav {
namespace {

constexpr double kFollowStep = 0.1;  // seconds between samples
constexpr int kTurnSamples = 20;     // either side, that a heading is averaged over
constexpr int kClimbSamples = 10;    // ... that heights are

// A line by its length.
class Measured {
public:
    Measured(const std::vector<glm::dvec2>& places, const std::string& source) : mPlaces(places) {
        mAlong.push_back(0);
        for (std::size_t n = 1; n < places.size(); ++n)
            mAlong.push_back(mAlong.back() + glm::length(places[n] - places[n - 1]));
        if (!(length() > 0) || !std::isfinite(length()))
            throw Error(source, "", "expected a track with a length", "give one of two places or more");
    }
    double length() const { return mAlong.back(); }
    glm::dvec2 at(double along) const {
        const auto after = std::upper_bound(mAlong.begin(), mAlong.end(), along);
        if (after == mAlong.begin()) return mPlaces.front();
        if (after == mAlong.end()) return mPlaces.back();
        const auto n = static_cast<std::size_t>(after - mAlong.begin());
        const double span = mAlong[n] - mAlong[n - 1];
        return glm::mix(mPlaces[n - 1], mPlaces[n], (along - mAlong[n - 1]) / span);
    }

private:
    const std::vector<glm::dvec2>& mPlaces;
    std::vector<double> mAlong;
};

// Returns the means over `reach` neighbours on either side, fewer at the ends.
template <typename Value>
std::vector<Value> averaged(const std::vector<Value>& values, int reach) {
    const int count = static_cast<int>(values.size());
    std::vector<Value> means;
    for (int n = 0; n < count; ++n) {
        const int first = std::max(0, n - reach), last = std::min(count - 1, n + reach);
        Value sum = values[static_cast<std::size_t>(first)];
        for (int k = first + 1; k <= last; ++k) sum += values[static_cast<std::size_t>(k)];
        means.push_back(sum / double(last - first + 1));
    }
    return means;
}

// Returns the highest ground within `reach` samples on either side.
std::vector<double> highestAround(const std::vector<double>& heights, int reach) {
    const int count = static_cast<int>(heights.size());
    std::vector<double> highest;
    highest.reserve(heights.size());
    for (int n = 0; n < count; ++n)
        highest.push_back(*std::max_element(heights.begin() + std::max(0, n - reach),
                                            heights.begin() + std::min(count, n + reach + 1)));
    return highest;
}

// Returns the greatest height of the ground along a straight way. Between the edges of cells the ground is a
// parabola. None where all of the way is a hole.
double highestAlong(const Heightfield& ground, const glm::dvec2& from, const glm::dvec2& to) {
    const glm::dvec2 a = ground.gridFromWorld(from), b = ground.gridFromWorld(to);
    std::vector<double> cuts{0, 1};
    for (int axis = 0; axis < 2; ++axis)
        for (double k = std::ceil(std::min(a[axis], b[axis])); k <= std::max(a[axis], b[axis]); ++k)
            if (a[axis] != b[axis]) cuts.push_back(std::clamp((k - a[axis]) / (b[axis] - a[axis]), 0.0, 1.0));
    std::sort(cuts.begin(), cuts.end());
    double high = -HUGE_VAL;
    const auto look = [&](double t) {
        const double height = ground.heightAt(glm::mix(from, to, t));
        if (std::isfinite(height)) high = std::max(high, height);
        return height;
    };
    for (std::size_t n = 0; n + 1 < cuts.size(); ++n) {
        const double h0 = look(cuts[n]), h1 = look(0.5 * (cuts[n] + cuts[n + 1])), h2 = look(cuts[n + 1]);
        const double bend = 2 * (h0 - 2 * h1 + h2), rise = h2 - h0 - bend;
        if (bend < 0 && rise > 0 && rise < -2 * bend)
            look(glm::mix(cuts[n], cuts[n + 1], -0.5 * rise / bend));
    }
    return high;
}

// Heights of the highest ground from one sample to those beside it; holes count as what came before.
std::vector<double> groundUnder(const Heightfield& ground, const std::vector<glm::dvec2>& places,
                                const GroundRises& rises) {
    std::vector<double> heights(places.size(), double(ground.minHeight()));
    double known = ground.maxHeight();
    for (std::size_t n = 0; n + 1 < places.size(); ++n) {
        const double rise = rises ? std::max(rises(places[n]), rises(places[n + 1])) : 0;
        if (const double high = highestAlong(ground, places[n], places[n + 1]); std::isfinite(high))
            known = high + rise;
        heights[n] = std::max(heights[n], known);
        heights[n + 1] = std::max(heights[n + 1], known);
    }
    return heights;
}

}  // namespace

RecordedPath followTrack(const Heightfield& ground, const std::vector<glm::dvec2>& places, double height,
                         const std::string& source, const GroundRises& rises) {
    const Measured line(places, source);
    const double seconds = std::clamp(line.length() / height, 2 * kFollowStep, kLongestFollow);
    const int count = static_cast<int>(std::ceil(seconds / kFollowStep)) + 1;
    std::vector<glm::dvec2> at;
    at.reserve(static_cast<std::size_t>(count));
    for (int n = 0; n < count; ++n) at.push_back(line.at(line.length() * n / (count - 1)));
    std::vector<glm::dvec2> ways;
    ways.reserve(at.size());
    for (int n = 0; n < count; ++n)
        ways.push_back(at[static_cast<std::size_t>(std::min(count - 1, n + 1))] -
                       at[static_cast<std::size_t>(std::max(0, n - 1))]);
    ways = averaged(averaged(ways, kTurnSamples), kTurnSamples);
    const std::vector<double> heights =
        averaged(highestAround(groundUnder(ground, at, rises), kClimbSamples), kClimbSamples);
    std::vector<PathSample> samples;
    double heading = std::atan2(at.back().x - at.front().x, at.back().y - at.front().y);
    for (std::size_t n = 0; n < at.size(); ++n) {
        // Where the track turns back on itself its mean direction is 0: the heading stays as before.
        if (glm::length(ways[n]) > 1e-6 * line.length() / count) heading = std::atan2(ways[n].x, ways[n].y);
        samples.push_back({seconds * double(n) / (count - 1),
                           poseFromAngles({at[n], heights[n] + height}, heading, kFollowPitch, 0)});
    }
    return RecordedPath(std::move(samples), source);
}

StereoSetting followedEyes(double height) {
    return defaultEyes(SeenAs::Track, height / std::sin(-kFollowPitch));
}

}  // namespace stereonav
