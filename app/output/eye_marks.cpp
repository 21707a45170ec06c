#include "app/output/eye_marks.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace stereonav {
namespace {

// Share of its depth that a point may lie behind the visible surface without being hidden: a pixel's depth is
// that of its middle.
constexpr double kBehind = 0.01;

bool isInside(const EyeView& view, const glm::dvec2& place) {
    return place.x >= 0 && place.y >= 0 && place.x < view.width && place.y < view.height;
}

// A pixel of a depth plane, which may have fewer pixels than the view, and its middle in pixels of the view.
struct DepthPixel {
    double depth = std::nan("");  // NaN where the plane has no such pixel
    glm::dvec2 middle{0.0};
};
DepthPixel pixelAt(const EyeView& view, const Plane<float>& viewDepth, const glm::ivec2& guard,
                   const glm::dvec2& place) {
    const glm::dvec2 shown(viewDepth.width() - 2 * guard.x, viewDepth.height() - 2 * guard.y);
    const glm::dvec2 scale = shown / glm::dvec2(view.width, view.height);
    const glm::dvec2 pixel = glm::floor(place * scale) + glm::dvec2(guard);
    if (!(pixel.x >= 0 && pixel.y >= 0 && pixel.x < viewDepth.width() && pixel.y < viewDepth.height()))
        return {};
    return {static_cast<double>(viewDepth.at(static_cast<int>(pixel.x), static_cast<int>(pixel.y))),
            (pixel - glm::dvec2(guard) + 0.5) / scale};
}

double depthAt(const EyeView& view, const Plane<float>& viewDepth, const glm::ivec2& guard,
               const glm::dvec2& place) {
    return pixelAt(view, viewDepth, guard, place).depth;
}

// Returns whether this pixel and all its neighbours show something nearer. At grazing angles depths differ
// within a pixel: objects that stand on the ground must not be hidden by it.
bool isHidden(const EyeView& view, const Plane<float>& viewDepth, const glm::ivec2& guard,
              const glm::dvec2& place, double depth) {
    const glm::dvec2 pixel(static_cast<double>(view.width) / std::max(1, viewDepth.width() - 2 * guard.x),
                           static_cast<double>(view.height) / std::max(1, viewDepth.height() - 2 * guard.y));
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
            const double seen = depthAt(view, viewDepth, guard, place + glm::dvec2(i, j) * pixel);
            const bool nearer = seen > 0 && seen < depth * (1 - kBehind);
            const bool outside = std::isnan(seen) && (i != 0 || j != 0);
            if (!nearer && !outside) return false;
        }
    return true;
}

}  // namespace

EyeMark markUnder(const StereoViews& views, const Plane<float>& viewDepth, const glm::dvec2& share,
                  const glm::ivec2& guard) {
    const glm::dvec2 left = share * glm::dvec2(views.left.width, views.left.height);
    const double depth = depthAt(views.left, viewDepth, guard, left);
    if (!(depth > 0 && std::isfinite(depth))) return {left, left};
    return {left, {views.rightColumn(left.x, depth), left.y}};
}

std::optional<glm::dvec3> worldUnder(const StereoViews& views, const Plane<float>& viewDepth,
                                     const glm::dvec2& share, const glm::ivec2& guard) {
    const EyeView& view = views.left;
    const glm::dvec2 place = share * glm::dvec2(view.width, view.height);
    if (!isInside(view, place)) return std::nullopt;
    const DepthPixel pixel = pixelAt(view, viewDepth, guard, place);
    if (!(pixel.depth > 0 && std::isfinite(pixel.depth))) return std::nullopt;
    return view.bend().placeOf(view.pointAt(pixel.middle.x, pixel.middle.y, pixel.depth));
}

std::optional<PointMark> markOf(const StereoViews& views, const Plane<float>& viewDepth,
                                const glm::dvec3& world, const glm::ivec2& guard) {
    const glm::dvec3 seenAt = views.left.bend().apparent(world);  // both eyes belong to one head
    const glm::dvec3 left = views.left.project(seenAt), right = views.right.project(seenAt);
    if (!(left.z >= views.left.nearDepth && std::isfinite(left.z))) return std::nullopt;
    const PointMark point{{glm::dvec2(left), glm::dvec2(right)}, left.z};
    if (!isInside(views.left, point.mark.left) || !isInside(views.right, point.mark.right))
        return std::nullopt;
    if (isHidden(views.left, viewDepth, guard, point.mark.left, left.z)) return std::nullopt;
    return point;
}

}  // namespace stereonav
