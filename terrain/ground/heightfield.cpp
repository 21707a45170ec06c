#include "terrain/ground/heightfield.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

// The steepest gradient inside one bilinear cell: dh/dx is linear in y and dh/dy in x, so each is
// largest at an edge.
// `steepest`, or this one where it is larger.
double steeperSlope(double steepest, const float* south, const float* north, const glm::dvec2& spacing) {
    const double gx = std::max(std::abs(double(south[1]) - south[0]), std::abs(double(north[1]) - north[0]));
    const double gy = std::max(std::abs(double(north[0]) - south[0]), std::abs(double(north[1]) - south[1]));
    const double x = gx / spacing.x, y = gy / spacing.y;
    // Most cells are less steep by far, which needs no root.
    constexpr double kSurely = 1 - 1e-12;
    if (x * x + y * y < kSurely * steepest * steepest) return steepest;
    return std::max(steepest, std::hypot(x, y));
}

// Range and steepness of the cells of a row.
struct CellRange {
    float low = std::numeric_limits<float>::infinity(), high = -std::numeric_limits<float>::infinity();
    double steepest = 0;
    bool any = false, holes = false;
};

CellRange rangeOfRow(const float* south, const float* north, int cells, const glm::dvec2& spacing) {
    CellRange range;
    for (int i = 0; i < cells; ++i) {
        const float low = std::min({south[i], south[i + 1], north[i], north[i + 1]});
        const float high = std::max({south[i], south[i + 1], north[i], north[i + 1]});
        const float sum = south[i] + south[i + 1] + north[i] + north[i + 1];
        if (!std::isfinite(sum)) {
            range.holes = true;
            continue;
        }
        range.any = true;
        range.low = std::min(range.low, low);
        range.high = std::max(range.high, high);
        range.steepest = steeperSlope(range.steepest, south + i, north + i, spacing);
    }
    return range;
}

}  // namespace

Heightfield::Heightfield(int width, int height, glm::dvec2 spacing, std::vector<float> heights,
                         const std::string& source)
    : mWidth(width), mHeight(height), mSpacing(spacing), mHeights(std::move(heights)) {
    if (width < 2 || height < 2)
        throw Error(source, "", fmt::format("expected at least 2x2 samples, got {}x{}", width, height),
                    "a surface needs two samples each way");
    if (mHeights.size() != static_cast<std::size_t>(width) * height)
        throw Error(source, "", "the number of heights is not width times height", "");
    if (!(spacing.x > 0 && spacing.y > 0 && std::isfinite(spacing.x) && std::isfinite(spacing.y)))
        throw Error(source, "spacing",
                    fmt::format("expected metres above 0, got {:g} x {:g}", spacing.x, spacing.y),
                    "check the file's pixel size");
    mOrigin = -0.5 * glm::dvec2(width - 1, height - 1) * spacing;
    mMin = std::numeric_limits<float>::infinity();
    mMax = -mMin;
    std::vector<CellRange> rows(static_cast<std::size_t>(height) - 1);
    parallelFor(height - 1, [&](int j) {
        const float* const south = &mHeights[static_cast<std::size_t>(j) * width];
        rows[j] = rangeOfRow(south, south + width, width - 1, spacing);
    });
    bool anyCell = false;
    for (const CellRange& row : rows) {
        anyCell = anyCell || row.any;
        mHasHoles = mHasHoles || row.holes;
        mMin = std::min(mMin, row.low);
        mMax = std::max(mMax, row.high);
        mMaxSlope = std::max(mMaxSlope, row.steepest);
    }
    if (!anyCell) throw Error(source, "", "no cell with four known heights", "check the file's nodata value");
    if (mHasHoles) mMaxSlope = std::numeric_limits<double>::infinity();
}

bool Heightfield::anyCell(int width, int height, const float* heights) {
    for (int j = 0; j + 1 < height; ++j)
        for (int i = 0; i + 1 < width; ++i) {
            const float *south = heights + static_cast<std::ptrdiff_t>(j) * width + i, *north = south + width;
            if (std::isfinite(south[0] + south[1] + north[0] + north[1])) return true;
        }
    return false;
}

bool Heightfield::contains(const glm::dvec2& world) const {
    const glm::dvec2 g = gridFromWorld(world);
    return g.x >= 0 && g.y >= 0 && g.x <= mWidth - 1 && g.y <= mHeight - 1;
}

double Heightfield::heightAt(const glm::dvec2& world) const {
    const glm::dvec2 g = gridFromWorld(world);
    const double x = std::clamp(g.x, 0.0, double(mWidth - 1)), y = std::clamp(g.y, 0.0, double(mHeight - 1));
    const int i = std::min(static_cast<int>(x), mWidth - 2), j = std::min(static_cast<int>(y), mHeight - 2);
    const double u = x - i, v = y - j;
    const double south = sample(i, j) * (1 - u) + sample(i + 1, j) * u;
    const double north = sample(i, j + 1) * (1 - u) + sample(i + 1, j + 1) * u;
    return south * (1 - v) + north * v;
}

glm::dvec2 Heightfield::gradientAtSample(int i, int j) const {
    // A difference over the nearest known samples each way; 0 where neither side is known.
    const auto slope = [&](int di, int dj, double step) {
        const double centre = sample(i, j);
        const bool hasBefore = i - di >= 0 && j - dj >= 0 && std::isfinite(sample(i - di, j - dj));
        const bool hasAfter = i + di < mWidth && j + dj < mHeight && std::isfinite(sample(i + di, j + dj));
        const double before = hasBefore ? sample(i - di, j - dj) : centre;
        const double after = hasAfter ? sample(i + di, j + dj) : centre;
        const double span = step * (int(hasBefore) + int(hasAfter));
        const double rise = after - before;
        return span > 0 && std::isfinite(rise) ? rise / span : 0.0;
    };
    return {slope(1, 0, mSpacing.x), slope(0, 1, mSpacing.y)};
}

glm::dvec3 Heightfield::normalAt(const glm::dvec2& world) const {
    const glm::dvec2 g = gridFromWorld(world);
    const double x = std::clamp(g.x, 0.0, double(mWidth - 1)), y = std::clamp(g.y, 0.0, double(mHeight - 1));
    const int i = std::min(static_cast<int>(x), mWidth - 2), j = std::min(static_cast<int>(y), mHeight - 2);
    const double u = x - i, v = y - j;
    const glm::dvec2 gradient =
        (1 - v) * ((1 - u) * gradientAtSample(i, j) + u * gradientAtSample(i + 1, j)) +
        v * ((1 - u) * gradientAtSample(i, j + 1) + u * gradientAtSample(i + 1, j + 1));
    return glm::normalize(glm::dvec3(-gradient, 1.0));
}

}  // namespace stereonav
