#include "app/view/session_orbit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/scene/capabilities.h"
#include "engine/scene/seen_from_outside.h"

namespace stereonav {
namespace {

constexpr double kTurn = std::numbers::pi;  // radians a drag of the picture's height
constexpr double kDragZoom = 4.0;           // logarithm of the factor of such a drag
constexpr double kNotch = 5.0 / 6;          // factor on the distance per notch of the wheel
constexpr double kNearest = 2.0;            // near depths: what is nearer can not be seen
constexpr double kFarthest = 20.0;          // sizes of the scene
constexpr double kUnknownSize = 1e6;        // near depths, of a scene without bounds

struct Bounds {
    glm::dvec3 middle{0.0};
    double size = 0;  // metres
};
std::optional<Bounds> boundsOf(const Scene& scene) {
    const auto between = [](const glm::dvec3& low, const glm::dvec3& high) {
        return std::optional(Bounds{0.5 * (low + high), glm::length(high - low)});
    };
    const auto usable = [](const std::optional<Bounds>& bounds) {
        return bounds && std::isfinite(bounds->size) && std::isfinite(glm::length(bounds->middle));
    };
    std::optional<Bounds> bounds;
    if (const auto* const object = scene.offered<const SeenFromOutside>())
        bounds = between(object->low, object->high);
    else if (const auto* const box = scene.offered<const SceneBox>())
        bounds = between(box->low, box->high);
    return usable(bounds) ? bounds : std::nullopt;
}

PivotMotion::Range rangeOf(const Scene& scene) {
    const double nearest = kNearest * scene.lens.nearDepth;
    const auto bounds = boundsOf(scene);
    const double size = bounds ? bounds->size : 0,
                 home = bounds ? glm::distance(bounds->middle, scene.startPose.position) : 0;
    const double farthest = bounds ? kFarthest * size + home : kUnknownSize * nearest;
    return {nearest, std::clamp(farthest, nearest, 1e300)};
}

std::optional<glm::dvec3> middleOf(const Scene& scene) {
    const auto bounds = boundsOf(scene);
    return bounds ? std::optional(bounds->middle) : std::nullopt;
}

}  // namespace

SessionOrbit::SessionOrbit(const Scene& scene)
    : mOn(scene.offered<const SeenFromOutside>() != nullptr),
      mStartsOn(mOn),
      mMiddle(middleOf(scene)),
      mMotion(rangeOf(scene)) {
    if (mMiddle) mMotion.setPivot(*mMiddle);
}

void SessionOrbit::replaceScene(const Scene& scene) {
    mStartsOn = scene.offered<const SeenFromOutside>() != nullptr;
    mMiddle = middleOf(scene);
    const glm::dvec3 pivot = mMotion.pivot();
    mMotion = PivotMotion(rangeOf(scene));
    mMotion.setPivot(pivot);
}

void SessionOrbit::set(bool on) {
    mOn = on;
    endZoom();
}

void SessionOrbit::takeHold(const std::optional<glm::dvec3>& place, const Pose& head, double depth) {
    if (place)
        mMotion.setPivot(*place);
    else if (mMiddle)
        mMotion.setPivot(*mMiddle);
    else
        mMotion.setPivot(head.position + depth * head.forward());
}

Pose SessionOrbit::dragged(const Pose& head, OrbitDrag drag, const glm::dvec2& by, double height) {
    if (drag == OrbitDrag::Pan) return mMotion.panned(head, by);
    if (!(height > 0)) return head;
    const glm::dvec2 share = by / height;
    if (drag == OrbitDrag::Turn) return mMotion.turned(head, kTurn * share.x, kTurn * share.y);
    mMotion.zoomBy(std::exp(-kDragZoom * share.y));
    return head;
}

void SessionOrbit::zoomBy(double notches) {
    mMotion.zoomBy(std::pow(kNotch, notches));
}

}  // namespace stereonav
