#include "terrain/cast/plain_caster.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/math/constants.h"

namespace stereonav {
namespace {

// A ray in grid coordinates; z stays in metres. Over level ground it is z + t dz + t^2 sink.
struct GridRay {
    glm::dvec2 origin, direction;
    double z, dz, sink;
    double x(double t) const { return origin.x + t * direction.x; }
    double y(double t) const { return origin.y + t * direction.y; }
};

struct Interval {
    double begin, end;
};

// Part of the ray above [0, last] on one axis.
Interval insideSlab(double origin, double direction, double last) {
    if (direction == 0)
        return origin >= 0 && origin <= last ? Interval{-kInfinity, kInfinity} : Interval{1, 0};
    const double a = -origin / direction, b = (last - origin) / direction;
    return {std::min(a, b), std::max(a, b)};
}

// Smallest root in [0, length] of c + b s + a s^2, or infinity. The stable form: no difference of
// nearly equal numbers.
double firstRoot(double a, double b, double c, double length) {
    if (c == 0) return 0;
    if (c < 0) a = -a, b = -b, c = -c;  // from below: the same surface seen from its other side
    const double discriminant = b * b - 4 * a * c;
    if (!(discriminant >= 0)) return kInfinity;
    const double root = std::sqrt(discriminant);
    double s = kInfinity;
    if (b < 0) {
        s = 2 * c / (root - b);
    } else if (a < 0) {
        s = (b + root) / (-2 * a);
    }
    return s <= length ? s : kInfinity;
}

// The height above the surface along the ray inside cell (i, j), from t on, is quadratic in s = t' - t.
double hitInCell(const Heightfield& ground, const GridRay& ray, int i, int j, double t, double end) {
    const double h00 = ground.sample(i, j), h10 = ground.sample(i + 1, j);
    const double h01 = ground.sample(i, j + 1), h11 = ground.sample(i + 1, j + 1);
    const double du = h10 - h00, dv = h01 - h00, twist = (h11 - h01) - du;
    if (!std::isfinite(twist)) return kInfinity;
    const double u = ray.x(t) - i, v = ray.y(t) - j;
    const glm::dvec2 d = ray.direction;
    // Eye and ground are subtracted first, which is exact where both are far from 0.
    const double c = (ray.z - h00) + t * (ray.dz + t * ray.sink) - (u * du + v * dv + u * v * twist);
    const double b = (ray.dz + 2 * t * ray.sink) - (d.x * (du + v * twist) + d.y * (dv + u * twist));
    const double a = ray.sink - d.x * d.y * twist;
    return t + firstRoot(a, b, c, end - t);
}

GridRay gridRay(const Heightfield& ground, const glm::dvec3& origin, const glm::dvec3& direction,
                const EarthBend& bend) {
    const glm::dvec2 way(direction), off = glm::dvec2(origin) - bend.middle;
    return {ground.gridFromWorld(glm::dvec2(origin)), way / ground.spacing(),
            origin.z + bend.sinkAt(glm::dvec2(origin)), direction.z + 2 * bend.fall * glm::dot(off, way),
            bend.fall * glm::dot(way, way)};
}

// Returns the ray parameter from which on the ray can hit nothing more: a straight ray is then above or below
// all heights, a bent one rises above them, after it may have come down twice. Infinite for a level straight
// ray.
double passedAll(const Heightfield& ground, const GridRay& ray) {
    constexpr double kRounding = 1e-12;
    if (ray.sink > 0) {
        const double over = ray.z - ground.maxHeight();
        const double square = ray.dz * ray.dz, discriminant = square - 4 * ray.sink * over;
        if (discriminant < -kRounding * square) return -kInfinity;
        const double root = std::sqrt(std::max(0.0, discriminant));
        return ray.dz > 0 ? -2 * over / (ray.dz + root) : (root - ray.dz) / (2 * ray.sink);
    }
    if (ray.dz == 0) return kInfinity;
    return ((ray.dz < 0 ? ground.minHeight() : ground.maxHeight()) - ray.z) / ray.dz;
}

}  // namespace

GroundHit castPlain(const Heightfield& ground, const glm::dvec3& origin, const glm::dvec3& direction,
                    double tMin, const EarthBend& bend) {
    const GroundHit miss{kInfinity, 0, 0, 0, 0};
    const GridRay ray = gridRay(ground, origin, direction, bend);
    const int lastI = ground.width() - 2, lastJ = ground.height() - 2;
    const Interval x = insideSlab(ray.origin.x, ray.direction.x, lastI + 1);
    const Interval y = insideSlab(ray.origin.y, ray.direction.y, lastJ + 1);
    double t = std::max({x.begin, y.begin, tMin});
    const double end = std::min(x.end, y.end);
    if (!(t <= end)) return miss;
    int i = std::clamp(static_cast<int>(std::floor(ray.x(t))), 0, lastI);
    int j = std::clamp(static_cast<int>(std::floor(ray.y(t))), 0, lastJ);
    const int stepI = ray.direction.x > 0 ? 1 : -1, stepJ = ray.direction.y > 0 ? 1 : -1;
    // A ray straight up or down stays in its cell and ends there.
    const double last = std::max(t, passedAll(ground, ray) * (1 + 1e-12) + 1e-9);
    while (i >= 0 && j >= 0 && i <= lastI && j <= lastJ) {
        const double tx =
            ray.direction.x != 0 ? (i + (stepI > 0) - ray.origin.x) / ray.direction.x : kInfinity;
        const double ty =
            ray.direction.y != 0 ? (j + (stepJ > 0) - ray.origin.y) / ray.direction.y : kInfinity;
        const double exit = std::max(t, std::min({tx, ty, last}));
        if (!std::isfinite(exit)) return miss;
        const double hit = hitInCell(ground, ray, i, j, t, exit);
        if (hit < kInfinity)
            return {hit, i, j, std::clamp(ray.x(hit) - i, 0.0, 1.0), std::clamp(ray.y(hit) - j, 0.0, 1.0)};
        if (exit >= last) return miss;
        (tx < ty ? i : j) += tx < ty ? stepI : stepJ;
        t = exit;
    }
    return miss;
}

}  // namespace stereonav
