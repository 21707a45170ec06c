// Rasters and their pixels; what needs to know reference systems is in terrain/read/gdal.
#include "terrain/raster/georeference.h"

#include <cmath>
#include <utility>

namespace stereonav {

glm::dvec2 Georeference::fromPixel(const glm::dvec2& p) const {
    const auto& t = transform;
    return {t[0] + p.x * t[1] + p.y * t[2], t[3] + p.x * t[4] + p.y * t[5]};
}

glm::dvec2 Georeference::toPixel(const glm::dvec2& reference) const {
    const auto& t = transform;
    const double x = reference.x - t[0], y = reference.y - t[3];
    const double determinant = t[1] * t[5] - t[2] * t[4];
    return {(x * t[5] - y * t[2]) / determinant, (y * t[1] - x * t[4]) / determinant};
}

bool Georeference::axisAligned() const {
    constexpr double kTolerance = 0.01;  // pixels, over the whole raster
    return std::abs(transform[2]) * height <= kTolerance * std::abs(transform[1]) &&
           std::abs(transform[4]) * width <= kTolerance * std::abs(transform[5]);
}

PixelMap::PixelMap(int nodesX, std::vector<glm::dvec2> nodes, int shift)
    : mNodesX(nodesX), mShift(shift), mNodes(std::move(nodes)) {}

glm::dvec2 PixelMap::at(int column, int row) const {
    const int step = 1 << mShift, i = column >> mShift, j = row >> mShift;
    const double u = (column - i * step) / double(step), v = (row - j * step) / double(step);
    const glm::dvec2* node = &mNodes[static_cast<std::size_t>(j) * mNodesX + i];
    const glm::dvec2* next = node + mNodesX;
    return (1 - v) * ((1 - u) * node[0] + u * node[1]) + v * ((1 - u) * next[0] + u * next[1]);
}

}  // namespace stereonav
