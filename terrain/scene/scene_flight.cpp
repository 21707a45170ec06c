// The computed viewpoint and flight. The plan of the flight is a closed form; its height is the ground
// below, first widened to the highest within a window and then smoothed within the same window, so
// that it is smooth and still above every place it passes (a closing, as in mathematical morphology).
#include "terrain/scene/scene_flight.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace stereonav {
namespace {

using std::numbers::pi;

constexpr int kSegments = 1440;  // segments of the flight: 60 a second
constexpr int kWindow = 75;      // segments to each side over which the height is smoothed

// The spiral, in shares of the ground's half extents: from near the border inwards, counter-clockwise
// by a good half turn.
constexpr double kOuterRadius = 0.74, kInnerRadius = 0.32, kFlightTurn = 1.25 * pi;
// The view: inwards of the direction of flight, below the horizon, banked for an even turn; radians.
constexpr double kLookInwards = 0.55, kLookDown = 0.10, kBank = 0.12;
// From high above the mean ground the view looks further down: by this share of the angle below the horizon
// at which ground half an extent away is seen.
constexpr double kLookAtGround = 0.8;
// Share of the climb angle that the view follows.
constexpr double kFollowClimb = 0.12;

glm::dvec2 halfExtents(const Heightfield& ground) {
    return 0.5 * glm::dvec2(ground.width() - 1, ground.height() - 1) * ground.spacing();
}

// Metres: the side of a square as large as the ground.
double extentOf(const Heightfield& ground) {
    const glm::dvec2 half = halfExtents(ground);
    return 2 * std::sqrt(half.x * half.y);
}

// Metres; from a lattice of places, as precise as a view needs.
double meanHeight(const Heightfield& ground) {
    constexpr int kPlaces = 64;
    double sum = 0;
    int count = 0;
    for (int k = 0; k < kPlaces * kPlaces; ++k) {
        const glm::dvec2 share = glm::dvec2(k % kPlaces, k / kPlaces) / (kPlaces - 1.0);
        const double height = ground.heightAt((2.0 * share - 1.0) * halfExtents(ground));
        if (!std::isfinite(height)) continue;
        sum += height;
        ++count;
    }
    return count > 0 ? sum / count : ground.minHeight();
}

// Metres above the ground from which it can be overlooked: 5 % of its extent.
double comfortableHeight(const Heightfield& ground, double clearance) {
    return std::max(clearance, 0.05 * extentOf(ground));
}

// Upper bound of the ground in the box around two places: the highest corner of the cells it touches.
// The lowest ground of all where there is none.
double highestBetween(const Heightfield& ground, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 ga = ground.gridFromWorld(a), gb = ground.gridFromWorld(b);
    const auto first = [](double p, double q, int count) {
        return std::clamp(static_cast<int>(std::floor(std::min(p, q))), 0, count - 2);
    };
    const auto last = [](double p, double q, int count) {
        return std::clamp(static_cast<int>(std::floor(std::max(p, q))) + 1, 1, count - 1);
    };
    double highest = ground.minHeight();
    for (int j = first(ga.y, gb.y, ground.height()); j <= last(ga.y, gb.y, ground.height()); ++j)
        for (int i = first(ga.x, gb.x, ground.width()); i <= last(ga.x, gb.x, ground.width()); ++i)
            if (std::isfinite(ground.sample(i, j))) highest = std::max(highest, double(ground.sample(i, j)));
    return highest;
}

glm::dvec2 highestPlace(const Heightfield& ground) {
    const float* begin = ground.data();
    const auto count = static_cast<std::ptrdiff_t>(ground.width()) * ground.height();
    const auto lower = [](float a, float b) { return std::isfinite(b) && (!std::isfinite(a) || a < b); };
    const auto k = std::max_element(begin, begin + count, lower) - begin;
    const auto row = k / ground.width(), column = k % ground.width();
    return ground.worldFromGrid({double(column), double(row)});
}

glm::dvec2 onEllipse(const Heightfield& ground, double radius, double angle) {
    return radius * halfExtents(ground) * glm::dvec2(std::cos(angle), std::sin(angle));
}

// Returns the direction in which the ground near the border is low and far from the summit; radians
// counter-clockwise from east.
double bestViewAngle(const Heightfield& ground) {
    constexpr int kCandidates = 32;
    const glm::dvec2 peak = highestPlace(ground);
    const double relief = double(ground.maxHeight()) - ground.minHeight();
    double bestScore = -1e300, best = 0;
    for (int k = 0; k < kCandidates; ++k) {
        const double angle = 2 * pi * k / kCandidates;
        const glm::dvec2 place = onEllipse(ground, kOuterRadius, angle);
        const double rise = highestBetween(ground, place, place) - ground.minHeight();
        const double height = relief > 0 ? rise / relief : 0.0;
        const double score = glm::length((place - peak) / (2.0 * halfExtents(ground))) - height;
        if (score <= bestScore) continue;
        bestScore = score;
        best = angle;
    }
    return best;
}

// Radians clockwise from north.
double headingOf(const glm::dvec2& direction) {
    return std::atan2(direction.x, direction.y);
}

// The plan of the flight, u from 0 to 1.
struct Plan {
    const Heightfield& ground;
    double startAngle, meanGround;

    glm::dvec2 at(double u) const {
        return onEllipse(ground, kOuterRadius + (kInnerRadius - kOuterRadius) * u,
                         startAngle + kFlightTurn * u);
    }
    // Direction of the flight at u; continuous, not wrapped.
    glm::dvec2 direction(double u) const {
        constexpr double kStep = 1e-4;
        return at(u + kStep) - at(u - kStep);
    }
    // Change of heading per turn around the spiral's centre: 1 on a circle.
    double bend(double u) const {
        constexpr double kStep = 1e-3;
        const double turned = headingOf(direction(u - kStep)) - headingOf(direction(u + kStep));
        return std::remainder(turned, 2 * pi) / (2 * kStep * kFlightTurn);
    }
};

double plannedParameter(int k) {
    return static_cast<double>(k) / kSegments;
}

// The least height at each of the kSegments + 1 points such that straight lines between them clear
// the ground by `height`.
std::vector<double> leastHeights(const Plan& plan, double height) {
    std::vector<double> least(kSegments + 1, -1e300);
    for (int k = 0; k < kSegments; ++k) {
        const double top = height + highestBetween(plan.ground, plan.at(plannedParameter(k)),
                                                   plan.at(plannedParameter(k + 1)));
        least[k] = std::max(least[k], top);
        least[k + 1] = std::max(least[k + 1], top);
    }
    return least;
}

// Returns values that are smooth and nowhere below `least`: each is a mean of maxima whose windows all hold
// its place.
std::vector<double> smoothAbove(const std::vector<double>& least) {
    const int count = static_cast<int>(least.size());
    const auto inside = [count](int k) { return std::clamp(k, 0, count - 1); };
    std::vector<double> widened(count), smooth(count);
    for (int k = 0; k < count; ++k)
        widened[k] = *std::max_element(&least[inside(k - kWindow)], &least[inside(k + kWindow)] + 1);
    for (int k = 0; k < count; ++k) {
        // Relative to its own place, so that rounding can not push the mean below a level window.
        double sum = 0, weights = 0;
        for (int d = -kWindow; d <= kWindow; ++d) {
            const double weight = 1 + std::cos(pi * d / (kWindow + 1));
            sum += weight * (widened[inside(k + d)] - least[k]);
            weights += weight;
        }
        smooth[k] = least[k] + sum / weights;
    }
    return smooth;
}

// Seconds at which the points are passed: even speed along the line, climbs included.
std::vector<double> passingTimes(const std::vector<glm::dvec3>& points) {
    std::vector<double> times(points.size(), 0.0);
    for (std::size_t k = 1; k < points.size(); ++k)
        times[k] = times[k - 1] + glm::length(points[k] - points[k - 1]);
    const double length = times.back();
    const double segments = static_cast<double>(points.size() - 1);
    // A thousandth of the time is spread evenly over the points, so that times always rise.
    for (std::size_t k = 0; k < points.size(); ++k) {
        const double share = length > 0 ? times[k] / length : 0.0;
        times[k] = kDefaultFlightSeconds * (0.999 * share + 0.001 * static_cast<double>(k) / segments);
    }
    return times;
}

Pose flightPose(const Plan& plan, const std::vector<glm::dvec3>& points, int k) {
    const double u = plannedParameter(k);
    // The climb over two seconds, not over one segment, so that the view does not nod.
    const glm::dvec3 climb = points[std::min(k + kWindow, kSegments)] - points[std::max(k - kWindow, 0)];
    const double climbAngle = std::atan2(climb.z, std::hypot(climb.x, climb.y));
    const double above = std::atan2(points[k].z - plan.meanGround, 0.5 * extentOf(plan.ground));
    const double pitch = kFollowClimb * climbAngle - kLookDown - kLookAtGround * std::max(above, 0.0);
    return poseFromAngles(points[k], headingOf(plan.direction(u)) - kLookInwards, pitch,
                          -kBank * plan.bend(u));
}

}  // namespace

Pose defaultStartPose(const Heightfield& ground, double clearance, double pitch) {
    const glm::dvec2 place = onEllipse(ground, kOuterRadius, bestViewAngle(ground));
    const glm::dvec2 around = 0.03 * halfExtents(ground);
    const double z =
        highestBetween(ground, place - around, place + around) + comfortableHeight(ground, clearance);
    return poseFromAngles({place, z}, headingOf(highestPlace(ground) - place), pitch, 0.0);
}

RecordedPath defaultFlight(const Heightfield& ground, double clearance) {
    const Plan plan{ground, bestViewAngle(ground), meanHeight(ground)};
    const auto heights = smoothAbove(leastHeights(plan, comfortableHeight(ground, clearance)));
    std::vector<glm::dvec3> points;
    for (int k = 0; k <= kSegments; ++k) points.emplace_back(plan.at(plannedParameter(k)), heights[k]);
    const auto times = passingTimes(points);
    std::vector<PathSample> samples;
    for (int k = 0; k <= kSegments; ++k) samples.push_back({times[k], flightPose(plan, points, k)});
    return RecordedPath(std::move(samples), "computed flight");
}

}  // namespace stereonav
