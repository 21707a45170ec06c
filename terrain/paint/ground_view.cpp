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

}  // namespace

GroundView::GroundView(const Heightfield& ground, const EyeView& view)
    : mGround(ground),
      mView(view),
      mBend(view.bend()),
      mRight(view.right * view.pixelWidth()),
      mUp(view.up * view.pixelHeight()) {}

bool GroundView::cellAt(const glm::dvec3& place, Cell& cell) const {
    const glm::dvec2 grid = mGround.gridFromWorld(glm::dvec2(place));
    const int width = mGround.width(), height = mGround.height();
    // Also of NaN.
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

bool GroundView::at(int x, int y, float depth, GroundSeen& seen) const {
    if (!(depth > 0) || !std::isfinite(depth)) return false;
    const glm::dvec3 ray = mView.rayDirection(x + 0.5, y + 0.5);
    double t = depth;
    for (int step = 0;; ++step) {
        const glm::dvec3 place = mView.eye + t * ray;
        Cell cell;
        if (!cellAt(place, cell)) return false;
        const glm::dvec3 normal(-cell.seenGradient, 1.0);
        const double into = glm::dot(normal, ray);
        if (into == 0) return false;
        const double perX = -t * glm::dot(normal, mRight) / into, perY = t * glm::dot(normal, mUp) / into;
        const double move = (cell.seenHeight - place.z) / into;
        const double pixel = std::max(std::abs(perX), std::abs(perY));
        t += move;
        if (!(t > 0) || !(std::abs(t - depth) <= kMostPixelsOff * pixel + kMostShareOff * depth))
            return false;
        if (std::abs(move) > kNear * pixel && step + 1 < kMostNewtonSteps) continue;
        seen.depth = t;
        seen.direction = mBend.wayToPlace(mView.eye, ray, t);
        seen.place = mBend.placeOf(mView.eye + t * ray);
        seen.gradient = cell.gradient;
        seen.perX = t * mRight + perX * ray;
        seen.perY = -t * mUp + perY * ray;
        return true;
    }
}

}  // namespace stereonav
