// How far a point is from the surface (freeDistance of surface_cells.h): leap codes say where to begin and
// what to skip, and active cells are halved until their surface is known well enough. The trilinear value
// within a box lies between its corners' values, so a box whose corners are all on one side holds none.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/volume/surface_cells.h"

namespace stereonav {
namespace {

// A box in metres along the volume's axes, and the values at its corners (x + 2 y + 4 z) minus the isovalue.
struct Box {
    glm::dvec3 low, high;
    std::array<double, 8> values;

    bool holdsSurface() const {
        bool below = false, reached = false;
        for (const double v : values) (v < 0 ? below : reached) = true;
        return below && reached;
    }
    Box half(int axis, bool upper) const {
        Box part = *this;
        (upper ? part.low : part.high)[axis] = 0.5 * (low[axis] + high[axis]);
        const int bit = 1 << axis;
        for (int n = 0; n < 8; ++n)
            if (((n & bit) != 0) != upper) part.values[n] = 0.5 * (values[n & ~bit] + values[n | bit]);
        return part;
    }
    double valueAt(const glm::dvec3& point) const {
        const glm::dvec3 f = (point - low) / (high - low);
        double sum = 0;
        for (int n = 0; n < 8; ++n)
            sum += (n & 1 ? f.x : 1 - f.x) * (n & 2 ? f.y : 1 - f.y) * (n & 4 ? f.z : 1 - f.z) * values[n];
        return sum;
    }
};

// What a box says of the distance to its surface without being halved.
struct Bounds {
    double least;  // no surface of the box is nearer
    double most;   // some is no further; infinity when that is not known
};

// The steepest ascents along one axis, a metre: of the eight corners' four edges.
struct Slopes {
    double lowest, highest;
    Slopes(const Box& box, int axis) {
        const int bit = 1 << axis;
        lowest = 1e300, highest = -1e300;
        for (int n = 0; n < 8; ++n) {
            if (n & bit) continue;
            const double rise = box.values[n | bit] - box.values[n];
            lowest = std::min(lowest, rise), highest = std::max(highest, rise);
        }
        const double length = box.high[axis] - box.low[axis];
        lowest /= length, highest /= length;
    }
};

// Let c be the box's point nearest to p, `gap` the way between them, and g the steepest ascent on each axis
// from c into the box. A point p + y of the surface has g.(y - gap) >= -value(c), so |y| >= (g.gap -
// value(c)) / |g|: exact where the value is linear. Just behind the y of that length the surface is looked
// for.
Bounds boundsOf(const Box& box, const glm::dvec3& p, double slack) {
    const glm::dvec3 c = glm::clamp(p, box.low, box.high), gap = c - p;
    const double value = box.valueAt(c), distance = glm::length(gap);
    Bounds bounds{distance, std::numeric_limits<double>::infinity()};
    if (value >= 0) return bounds;
    glm::dvec3 ascent;  // signed
    for (int axis = 0; axis < 3; ++axis) {
        const Slopes slopes(box, axis);
        const double up = std::max(slopes.highest, 0.0), down = std::min(slopes.lowest, 0.0);
        const bool towardsHigh = gap[axis] > 0 || (gap[axis] == 0 && up >= -down);
        ascent[axis] = towardsHigh ? up : down;
    }
    const double squared = glm::dot(ascent, ascent);
    if (!(squared > 0)) return bounds;
    const double t = (glm::dot(ascent, gap) - value) / squared, length = t * std::sqrt(squared);
    bounds.least = std::max(distance, length * (1 - 1e-12));
    const glm::dvec3 beyond = p + ascent * (t * (1 + 0.9 * slack / length));
    const glm::dvec3 q = glm::clamp(beyond, box.low, box.high);
    if (box.valueAt(q) >= 0) bounds.most = std::max(distance, glm::length(q - p));
    return bounds;
}

// The search would not end for a tolerance of 0; in the smallest spacing.
constexpr double kLeastTolerance = 1e-6;

// From zero outwards: 0, 1, -1, 2, -2, ...
int outwards(int n) {
    return n & 1 ? (n + 1) / 2 : -(n / 2);
}

class Search {
public:
    Search(const SurfaceCells& cells, const glm::dvec3& voxel, double upTo, double tolerance)
        : mCells(cells),
          mSpacing(cells.frame.spacing),
          mPoint(voxel * mSpacing),
          mHome(glm::clamp(glm::floor(voxel), glm::dvec3(0.0), glm::dvec3(cells.frame.size - 2))),
          mUpTo(upTo),
          mSlack(0.5 * std::max(tolerance, kLeastTolerance * std::min({mSpacing.x, mSpacing.y, mSpacing.z}))),
          mNearest(upTo + mSlack) {}

    double run() {
        const std::uint8_t code = codeOf(mHome);
        const CellRecord* own = mCells.record(mHome);
        if (code == kCellActive && !own) return 0;  // outside the region
        if (own && boxOf(mHome, *own).valueAt(mPoint) >= 0) return 0;
        const double diagonal = glm::length(mSpacing);
        const double known = code > kCellNear ? (code - 1) * mCells.leapUnit : 0.0;
        // Codes are of distances between cells, rounded down, so the nearest active cell is rarely far
        // beyond.
        double radius = known + mCells.leapUnit + 2.1 * diagonal;
        if (known >= mUpTo) return mUpTo;
        for (;; radius *= 2) {
            radius = std::min(radius, mUpTo);
            searchWithin(radius);
            if (mNearest - mSlack <= radius || radius >= mUpTo) break;
        }
        if (!own && mFound && isBehind()) return 0;
        return std::clamp(mNearest - mSlack, 0.0, mUpTo);
    }

private:
    std::uint8_t codeOf(const glm::ivec3& cell) const {
        return mCells.codes[mCells.layout.index(cell.x, cell.y, cell.z)];
    }

    Box boxOf(const glm::ivec3& cell, const CellRecord& record) const {
        Box box{glm::dvec3(cell) * mSpacing, glm::dvec3(cell + 1) * mSpacing, {}};
        for (int n = 0; n < 8; ++n)
            box.values[n] = static_cast<double>(record.values[n]) - static_cast<double>(mCells.isovalue);
        return box;
    }

    double distanceTo(const Box& box) const {
        const glm::dvec3 away = mPoint - glm::clamp(mPoint, box.low, box.high);
        return std::sqrt(glm::dot(away, away));
    }

    // Along one axis, from the point to a cell.
    double gap(int axis, int cell) const {
        const double low = cell * mSpacing[axis];
        return std::max({low - mPoint[axis], mPoint[axis] - (low + mSpacing[axis]), 0.0});
    }

    // Cells to each side of the home cell that a distance may reach.
    int cellsWithin(double distance, int axis) const {
        return static_cast<int>(
            std::min(distance / mSpacing[axis] + 1, static_cast<double>(mCells.frame.size[axis])));
    }

    void searchWithin(double radius) {
        const int count = 2 * cellsWithin(radius, 2);
        for (int n = 0; n <= count; ++n) {
            const int k = mHome.z + outwards(n);
            if (k < 0 || k > mCells.frame.size.z - 2) continue;
            const double dz = gap(2, k);
            if (dz <= std::min(radius, mNearest)) searchLayer(k, dz * dz, radius);
        }
    }

    void searchLayer(int k, double squared, double radius) {
        const int count = 2 * cellsWithin(radius, 1);
        for (int n = 0; n <= count; ++n) {
            const int j = mHome.y + outwards(n);
            if (j < 0 || j > mCells.frame.size.y - 2) continue;
            const double dy = gap(1, j), limit = std::min(radius, mNearest);
            const double left = limit * limit - squared - dy * dy;
            if (left >= 0) searchRow(j, k, std::sqrt(left));
        }
    }

    // Cells of a row that lie no further than `reach` along it. What a code keeps free is skipped.
    void searchRow(int j, int k, double reach) {
        const double middle = mPoint.x / mSpacing.x, span = std::min(reach / mSpacing.x, 1e6);
        const int first = std::max(static_cast<int>(std::floor(middle - span)), 0);
        const int last = std::min(static_cast<int>(std::floor(middle + span)), mCells.frame.size.x - 2);
        const double perCode = mCells.leapUnit / mSpacing.x;
        for (int i = first; i <= last;) {
            const std::uint8_t code = codeOf({i, j, k});
            if (code > kCellNear) {
                i += 1 + static_cast<int>((code - 1) * perCode);
                continue;
            }
            if (code == kCellActive)
                if (const CellRecord* record = mCells.record({i, j, k})) examine({i, j, k}, *record);
            ++i;
        }
    }

    void examine(const glm::ivec3& cell, const CellRecord& record) {
        const Box box = boxOf(cell, record);
        const double before = mNearest;
        refine(box, 0);
        if (mNearest < before) {
            mNearestCell = cell;
            mFound = true;
        }
    }

    // Lowers mNearest to a lower bound of the distance to the box's surface that is off by no more than the
    // slack. What would gain less than the slack is left out, which the answer makes up for.
    void refine(const Box& box, int depth) {
        if (distanceTo(box) >= mNearest - mSlack || !box.holdsSurface()) return;
        const Bounds bounds = boundsOf(box, mPoint, mSlack);
        if (bounds.least >= mNearest - mSlack) return;
        const glm::dvec3 extent = box.high - box.low;
        constexpr int kDeepest = 75;  // 25 halvings an axis: finer than the least slack
        if (bounds.most - bounds.least <= mSlack || glm::dot(extent, extent) <= mSlack * mSlack ||
            depth >= kDeepest) {
            mNearest = bounds.least;
            return;
        }
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
        const bool upperFirst = mPoint[axis] > 0.5 * (box.low[axis] + box.high[axis]);
        refine(box.half(axis, upperFirst), depth + 1);
        refine(box.half(axis, !upperFirst), depth + 1);
    }

    // Nothing of the surface lies between the point and the nearest cell's nearest point, so both are on
    // the same side of it; where that is on the surface itself, the cell's other corners tell.
    bool isBehind() const {
        const Box box = boxOf(mNearestCell, *mCells.record(mNearestCell));
        const double value = box.valueAt(glm::clamp(mPoint, box.low, box.high));
        if (std::abs(value) > 1e-9) return value > 0;
        return std::none_of(box.values.begin(), box.values.end(), [](double v) { return v > 0; });
    }

    const SurfaceCells& mCells;
    glm::dvec3 mSpacing, mPoint;  // metres along the volume's axes
    glm::ivec3 mHome;
    double mUpTo, mSlack;
    double mNearest;  // the answer plus mSlack
    glm::ivec3 mNearestCell{0};
    bool mFound = false;
};

}  // namespace

double freeDistance(const SurfaceCells& cells, const glm::dvec3& world, double upTo, double tolerance) {
    const glm::dvec3 voxel = cells.frame.voxelFromWorld(world);
    const glm::dvec3 last(cells.frame.size - 1);
    const bool inside = voxel.x >= 0 && voxel.y >= 0 && voxel.z >= 0 && voxel.x <= last.x &&
                        voxel.y <= last.y && voxel.z <= last.z;  // false for NaN
    if (!inside || cells.codes.empty() || !(upTo > 0)) return 0;
    const glm::dvec3 faces = glm::min(voxel, last - voxel) * cells.frame.spacing;
    return Search(cells, voxel, std::min({upTo, faces.x, faces.y, faces.z}), tolerance).run();
}

}  // namespace stereonav
