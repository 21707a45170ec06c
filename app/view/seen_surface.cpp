#include "app/view/seen_surface.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "app/output/eye_marks.h"

namespace stereonav {
namespace {

constexpr int kMostSteps = 12;
constexpr double kNear = 1e-4;  // share of the picture: near enough to what is pointed at

bool sameView(const EyeView& a, const EyeView& b) {
    return a.eye == b.eye && a.forward == b.forward && a.up == b.up;
}

}  // namespace

std::optional<glm::dvec3> surfaceUnder(const StereoViews& shown, const StereoViews& cast,
                                       const Plane<float>& viewDepth, const glm::dvec2& share,
                                       const glm::ivec2& guard) {
    std::optional<glm::dvec3> place = worldUnder(cast, viewDepth, share, guard);
    if (sameView(shown.left, cast.left)) return place;
    const EyeView& view = shown.left;
    const glm::dvec2 size(view.width, view.height);
    glm::dvec2 at = share;
    for (int n = 0; n < kMostSteps && place; ++n) {
        const glm::dvec3 seen = view.project(view.bend().apparent(*place));
        const glm::dvec2 off = share - glm::dvec2(seen) / size;
        if (!(seen.z > 0) || !std::isfinite(glm::length(off))) return std::nullopt;
        if (glm::length(off) < kNear) break;
        at += off;
        place = worldUnder(cast, viewDepth, at, guard);
    }
    return place;
}

}  // namespace stereonav
