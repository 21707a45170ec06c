// The slice is a convex polygon; its corners lie on the box's edges.
#include "engine/display/medium_gpu_region.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace stereonav {
namespace {

glm::dvec3 cornerOf(const WorldBox& box, int n) {
    return {n & 1 ? box.high.x : box.low.x, n & 2 ? box.high.y : box.low.y, n & 4 ? box.high.z : box.low.z};
}

std::vector<glm::dvec3> sliceCorners(const WorldBox& box, const SweepGeometry& g, double t) {
    std::vector<glm::dvec3> corners;
    for (int n = 0; n < 8; ++n)
        for (int axis = 1; axis < 8; axis *= 2) {
            if (n & axis) continue;
            const glm::dvec3 a = cornerOf(box, n) - g.anchor, b = cornerOf(box, n | axis) - g.anchor;
            const double ta = glm::dot(g.axis, a) - t, tb = glm::dot(g.axis, b) - t;
            if ((ta > 0) == (tb > 0)) continue;
            corners.push_back(a + ta / (ta - tb) * (b - a));
        }
    return corners;
}

}  // namespace

PixelRect coveredBySlice(const WorldBox& box, const SweepGeometry& geometry, double t, const RayFan& fan) {
    const std::vector<glm::dvec3> corners = sliceCorners(box, geometry, t);
    if (corners.empty()) return {};
    glm::dvec2 low(fan.width, fan.height), high(0.0);
    for (const glm::dvec3& corner : corners) {
        const glm::dvec2 at = fan.project(corner);
        if (!std::isfinite(at.x) || !std::isfinite(at.y)) return {0, 0, fan.width, fan.height};
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    // A pixel more on each side for what the shader rounds otherwise.
    low = glm::max(glm::floor(low) - 1.0, glm::dvec2(0.0));
    high = glm::min(glm::ceil(high) + 1.0, glm::dvec2(fan.width, fan.height));
    if (!(low.x < high.x && low.y < high.y)) return {};
    return {static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(high.x - low.x),
            static_cast<int>(high.y - low.y)};
}

PixelRect united(const PixelRect& a, const PixelRect& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    const int x = std::min(a.x, b.x), y = std::min(a.y, b.y);
    return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

PixelRect grown(const PixelRect& rect, int margin, const RayFan& fan) {
    if (rect.empty()) return {};
    const int x = std::max(rect.x - margin, 0), y = std::max(rect.y - margin, 0);
    return {x, y, std::min(rect.x + rect.width + margin, fan.width) - x,
            std::min(rect.y + rect.height + margin, fan.height) - y};
}

}  // namespace stereonav
