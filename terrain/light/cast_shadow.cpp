#include "terrain/light/cast_shadow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace stereonav {
namespace {

// Where there is no ground yet: lower than all heights that a ground may have.
constexpr double kNothing = -1e300;

// Samples of a grid as lines across the larger part of the sun's way over it.
struct SunLines {
    const std::vector<float>& heights;
    const LightGrid& grid;
    glm::dvec2 way;  // steps of the ground's samples for a metre towards the sun
    bool columns;    // whether a line is a column

    SunLines(const std::vector<float>& field, const LightGrid& samples, const glm::dvec2& spacing,
             const glm::dvec3& toSun)
        : heights(field),
          grid(samples),
          way(glm::dvec2(toSun) / std::hypot(toSun.x, toSun.y) / spacing),
          columns(std::abs(way.x) > std::abs(way.y)) {}

    int lines() const { return columns ? grid.width : grid.height; }
    int length() const { return columns ? grid.height : grid.width; }
    double along() const { return columns ? way.x : way.y; }
    double aside() const { return columns ? way.y : way.x; }
    // Samples of the ground.
    int line(int k) const { return columns ? grid.column(k) : grid.row(k); }
    int place(int k) const { return columns ? grid.row(k) : grid.column(k); }
    LightGrid::Place placeOf(double at) const { return columns ? grid.placeY(at) : grid.placeX(at); }
    int most() const { return (columns ? grid.groundHeight : grid.groundWidth) - 1; }
    double height(int k, int n) const {
        const float h = heights[index(k, n)];
        return std::isfinite(h) ? h : kNothing;
    }
    std::size_t index(int k, int n) const {
        return columns ? static_cast<std::size_t>(n) * grid.width + k
                       : static_cast<std::size_t>(k) * grid.width + n;
    }
};

}  // namespace

ShadowCaster::ShadowCaster(const Heightfield& ground, const LightGrid& grid)
    : mGrid(grid), mSpacing(ground.spacing()), mHeights(grid.count()) {
    for (int j = 0; j < grid.height; ++j)
        for (int i = 0; i < grid.width; ++i)
            mHeights[static_cast<std::size_t>(j) * grid.width + i] =
                ground.sample(grid.column(i), grid.row(j));
}

std::vector<std::uint8_t> ShadowCaster::hidden(const glm::dvec3& toSun) const {
    std::vector<std::uint8_t> hidden(mGrid.count(), 0);
    const double across = std::hypot(toSun.x, toSun.y);
    if (!(toSun.z > 0) || !(across > 1e-9)) return hidden;
    const SunLines sun(mHeights, mGrid, mSpacing, toSun);
    const double sink = toSun.z / across;
    const bool fromLast = sun.along() > 0;
    // Higher of ground and shadow along the line before.
    std::vector<double> before(sun.length(), kNothing), here(sun.length());
    for (int k = 0; k < sun.lines(); ++k) {
        const int line = fromLast ? sun.lines() - 1 - k : k, last = fromLast ? line + 1 : line - 1;
        const double steps = k == 0 ? 0 : sun.line(last) - sun.line(line);
        const double way = k == 0 ? 0 : steps / sun.along(), fall = way * sink;
        for (int n = 0; n < sun.length(); ++n) {
            const double height = sun.height(line, n);
            double shadow = kNothing;
            const double from = sun.place(n) + way * sun.aside();
            if (k > 0 && from >= 0 && from <= sun.most()) {
                const LightGrid::Place at = sun.placeOf(from);
                shadow = before[at.index] + at.next * (before[at.index + 1] - before[at.index]) - fall;
            }
            here[n] = std::max(height, shadow);
            if (height <= kNothing || shadow <= height) continue;
            // The shadow's edge is as wide as what rays sink from line to line: a step of the samples on
            // level ground.
            hidden[sun.index(line, n)] = static_cast<std::uint8_t>(
                255 * std::min(1.0, (shadow - height) / std::max(fall, 1e-30)) + 0.5);
        }
        std::swap(before, here);
    }
    return hidden;
}

}  // namespace stereonav
