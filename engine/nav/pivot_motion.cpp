#include "engine/nav/pivot_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/base/error.h"
#include "engine/nav/flight_input.h"

namespace stereonav {
namespace {

using std::numbers::pi;

constexpr double kZoomed = 1e-3;     // logarithm of a factor: what is left below it is done at once
constexpr double kMostZoom = 100.0;  // logarithm of a factor that is asked for

bool isFinite(const glm::dvec3& place) {
    return std::isfinite(place.x) && std::isfinite(place.y) && std::isfinite(place.z);
}

}  // namespace

PivotMotion::PivotMotion(const Range& range) : mRange(range) {
    if (!(range.nearest > 0 && range.nearest <= range.farthest && std::isfinite(range.farthest)))
        throw Error(
            "", "distances from the pivot",
            fmt::format("expected 0 < nearest <= farthest, got {:g} and {:g}", range.nearest, range.farthest),
            "give metres");
}

void PivotMotion::setPivot(const glm::dvec3& pivot) {
    if (!isFinite(pivot)) return;
    mPivot = pivot;
    mLeft = 0;
}

Pose PivotMotion::turned(const Pose& head, double yaw, double pitch) const {
    const PoseAngles angles = anglesOf(head);
    const double up = std::clamp(angles.pitch + clampedInput(pitch, -pi, pi), -pi / 2, pi / 2);
    const double heading = std::remainder(angles.heading + clampedInput(yaw, -2 * pi, 2 * pi), 2 * pi);
    Pose there = poseFromAngles(head.position, heading, up, angles.roll);
    const glm::dvec3 seen = glm::conjugate(head.orientation) * (mPivot - head.position);
    there.position = mPivot - there.orientation * seen;
    return there;
}

Pose PivotMotion::panned(const Pose& head, const glm::dvec2& by) const {
    if (!std::isfinite(by.x) || !std::isfinite(by.y)) return head;
    const glm::dvec3 way = mPivot - head.position;
    const double ahead = glm::dot(way, head.forward());
    const double depth = ahead > 0 ? ahead : glm::length(way);
    return {head.position - depth * (by.x * head.right() + by.y * head.up()), head.orientation};
}

void PivotMotion::zoomBy(double factor) {
    if (!(factor > 0) || !std::isfinite(factor)) return;
    mLeft = std::clamp(mLeft + std::log(factor), -kMostZoom, kMostZoom);
}

// The logarithm of the distance is followed in closed form: steps of any length end at the same distance.
Pose PivotMotion::zoomed(const Pose& head, double dt) {
    const glm::dvec3 way = head.position - mPivot;
    const double distance = glm::length(way);
    if (!(distance > 0)) mLeft = 0;  // in no direction
    if (mLeft == 0 || !(dt > 0)) return head;
    double part = mLeft * (1 - std::exp(-dt / kZoomSeconds));
    if (std::abs(mLeft - part) <= kZoomed) part = mLeft;
    mLeft -= part;
    const double nearest = std::min(mRange.nearest, distance);
    const double farthest = std::max(mRange.farthest, distance);
    const double wanted = distance * std::exp(part);
    const double there = std::clamp(wanted, nearest, farthest);
    if (there != wanted) mLeft = 0;
    return {mPivot + way * (there / distance), head.orientation};
}

}  // namespace stereonav
