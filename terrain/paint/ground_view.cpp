#include "terrain/paint/ground_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace stereonav {
namespace {

constexpr int kMostNewtonSteps = 3;
constexpr double kNear = 1e-3;        // pixels: no step is made for less
constexpr double kBesideEdge = 1e-3;  // spacings beyond the outer samples that count as ground, for rounding
constexpr double kMostPixelsOff = 2, kMostShareOff = 1e-3;
constexpr double kLeastInto = 0.02;  // sine of the angle between ray and ground that counts at least
constexpr double kMostSteps = 128;
constexpr int kHalvings = 20;

}  // namespace

GroundView::GroundView(const Heightfield& ground, const EyeView& view)
    : mGround(ground),
      mView(view),
      mBend(view.bend()),
      mRight(view.right * view.pixelWidth()),
      mUp(view.up * view.pixelHeight()),
      mSpacing(std::min(ground.spacing().x, ground.spacing().y)) {}

bool GroundView::cellAt(const glm::dvec3& place, Cell& cell) const {
    const glm::dvec2 grid = mGround.gridFromWorld(glm::dvec2(place));
    const int width = mGround.width(), height = mGround.height();
    // Written so that NaN counts as outside.
    if (!(grid.x >= -kBesideEdge && grid.x <= width - 1 + kBesideEdge && grid.y >= -kBesideEdge &&
          grid.y <= height - 1 + kBesideEdge))
        return false;
    const int i = std::clamp(static_cast<int>(grid.x), 0, width - 2);
    const int j = std::clamp(static_cast<int>(grid.y), 0, height - 2);
    const double u = grid.x - i, v = grid.y - j;
    const double sw = mGround.sample(i, j), se = mGround.sample(i + 1, j), nw = mGround.sample(i, j + 1),
                 ne = mGround.sample(i + 1, j + 1);
    const double south = sw + u * (se - sw), north = nw + u * (ne - nw);
    cell.height = south + v * (north - south);
    cell.gradient = glm::dvec2((se - sw) * (1 - v) + (ne - nw) * v, north - south) / mGround.spacing();
    cell.seenHeight = cell.height - mBend.sinkAt(glm::dvec2(place));
    cell.seenGradient = cell.gradient - 2 * mBend.fall * (glm::dvec2(place) - mBend.middle);
    return std::isfinite(cell.height);
}

double GroundView::over(const glm::dvec3& ray, double t, Cell& cell) const {
    const glm::dvec3 place = mView.eye + t * ray;
    return cellAt(place, cell) ? place.z - cell.seenHeight : std::nan("");
}

GroundView::PerPixel GroundView::perPixel(const glm::dvec3& ray, double t, const Cell& cell) const {
    const glm::dvec3 normal(-cell.seenGradient, 1.0);
    const double into = glm::dot(normal, ray);
    return {into, -t * glm::dot(normal, mRight) / into, t * glm::dot(normal, mUp) / into};
}

GroundView::Way GroundView::followed(const glm::dvec3& ray, double depth, Cell& cell) const {
    Way way{depth, false};
    for (int step = 0; step < kMostNewtonSteps; ++step) {
        const double above = over(ray, way.t, cell);
        const PerPixel per = perPixel(ray, way.t, cell);
        if (!std::isfinite(above) || per.into == 0) return {depth, false};
        const double move = -above / per.into, pixel = std::max(std::abs(per.x), std::abs(per.y));
        way.t += move;
        if (!(way.t > 0) || !(std::abs(way.t - depth) <= kMostPixelsOff * pixel + kMostShareOff * depth))
            return {depth, false};
        if (step == 0) way.found = std::abs(move) * glm::length(glm::dvec2(ray)) <= kSameCell * mSpacing;
        if (std::abs(move) <= kNear * pixel) break;
    }
    return way;
}

GroundView::Way GroundView::searched(const glm::dvec3& ray, double depth, Cell& cell) const {
    const double above = over(ray, depth, cell);
    const glm::dvec3 normal(-cell.seenGradient, 1.0);
    // A pixel's size where it is seen, and how far it reaches along the view at the slope that the ground
    // has.
    const double size = depth * std::max(glm::length(mRight), glm::length(mUp));
    const double into = std::max(std::abs(glm::dot(normal, ray)) / glm::length(normal), kLeastInto);
    const double most = kMostPixelsOff * size * glm::length(normal) + kMostShareOff * depth;
    if (!(std::abs(above) <= most)) return {depth, false};
    const double reach = kMostPixelsOff * size / into + kMostShareOff * depth;
    const double way = std::max(glm::length(glm::dvec2(ray)), 1e-12);
    const int steps =
        static_cast<int>(std::clamp(std::ceil(2 * reach * way / (0.5 * mSpacing)), 2.0, kMostSteps));
    Way nearest{depth, true, true};
    double least = std::abs(above), before = std::nan(""), from = 0;
    for (int n = 0; n <= steps; ++n) {
        const double t = std::max(depth + reach * (2.0 * n / steps - 1), 1e-3 * depth),
                     now = over(ray, t, cell);
        if (before >= 0 && now < 0) {
            double low = from, high = t;
            for (int halving = 0; halving < kHalvings; ++halving) {
                const double middle = 0.5 * (low + high);
                (over(ray, middle, cell) >= 0 ? low : high) = middle;
            }
            over(ray, low, cell);
            return {low, true};
        }
        if (std::abs(now) < least) least = std::abs(now), nearest.t = t;
        before = now, from = t;
    }
    // The ray passes by, above a crest or below: takes the ground next to it.
    over(ray, nearest.t, cell);
    return nearest;
}

bool GroundView::at(int x, int y, float depth, GroundSeen& seen) const {
    if (!(depth > 0) || !std::isfinite(depth)) return false;
    const glm::dvec3 ray = mView.rayDirection(x + 0.5, y + 0.5);
    Cell cell;
    Way way = followed(ray, depth, cell);
    if (!way.found) way = searched(ray, depth, cell);
    if (!way.found) return false;
    const PerPixel per = perPixel(ray, way.t, cell);
    // Where the tangent plane faces away from the eye it does not give the width of a pixel.
    const bool faces = per.into < 0;
    glm::dvec3 apparent = mView.eye + way.t * ray;
    if (way.beside) apparent.z = cell.seenHeight;
    seen.depth = way.t;
    seen.direction = mBend.wayToPlace(mView.eye, ray, way.t);
    seen.place = mBend.placeOf(apparent);
    seen.gradient = cell.gradient;
    seen.perX = way.t * mRight + (faces ? per.x : 0) * ray;
    seen.perY = -way.t * mUp + (faces ? per.y : 0) * ray;
    return true;
}

}  // namespace stereonav
