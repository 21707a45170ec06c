// How far a point is from the surface (freeDistance of surface_cells.h): cells are visited in rings around
// the point, where leap codes say where to begin and what to skip; then the box that may be nearest is
// halved, again and again, until the nearest is known well enough (branch and bound, best first). The
// trilinear value within a box lies between its corners' values, so a box whose corners are all on one side
// holds no surface, and one with corners on both sides does.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "engine/volume/open_distance.h"

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
    double most;   // some is no further
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

// Bounds of the distance to a box that holds surface. Let c be its point nearest to p, `gap` the way between
// them, and g the steepest ascent on each axis from c into the box. A point p + y of the surface has g.(y -
// gap) >= -value(c), so |y| >= (g.gap - value(c)) / |g|: exact where the value is linear. Just behind the y
// of that length, by less than `slack`, the surface is looked for.
Bounds boundsOf(const Box& box, const glm::dvec3& p, double slack) {
    const glm::dvec3 c = glm::clamp(p, box.low, box.high), gap = c - p;
    const double value = box.valueAt(c), distance = glm::length(gap);
    constexpr double kRounding = 1 + 1e-12;  // must not part the most from the least of the same surface
    Bounds bounds{distance, (distance + glm::length(box.high - box.low)) * kRounding};
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
    if (box.valueAt(q) >= 0)
        bounds.most = std::min(bounds.most, std::max(distance, glm::length(q - p)) * kRounding);
    return bounds;
}

// The search would not end for a tolerance of 0; in the smallest spacing.
constexpr double kLeastTolerance = 1e-6;

// Cells along each side of the smallest block that is looked through.
constexpr int kSmallestBlock = 2;

// A box that may hold the nearest surface, and the cell that it is of.
struct Candidate {
    Box box;
    glm::ivec3 cell;
    int halvings;
};

class Search {
public:
    Search(const SurfaceCells& cells, const glm::dvec3& voxel, double upTo, double tolerance)
        : mCells(cells),
          mSpacing(cells.frame.spacing),
          mPoint(voxel * mSpacing),
          mDiagonal(glm::length(mSpacing)),
          mLast(cells.frame.size - 2),
          mHome(glm::clamp(glm::floor(voxel), glm::dvec3(0.0), glm::dvec3(mLast))),
          mUpTo(upTo),
          mTolerance(0.999 *
                     std::max(tolerance, kLeastTolerance * std::min({mSpacing.x, mSpacing.y, mSpacing.z}))),
          mMost(upTo) {}

    double run() {
        const std::uint8_t code = codeOf(mHome);
        const std::optional<CellRecord> own = mCells.record(mHome);
        if (code == kCellActive && !own) return 0;  // outside the region
        if (own && boxOf(mHome, *own).valueAt(mPoint) >= 0) return 0;
        const double known = code > kCellNear ? (code - 1) * mCells.leapUnit : 0.0;
        if (known >= mUpTo) return mUpTo;
        if (known > 0) descend();
        visitAll();
        const Candidate* nearest = settle();
        if (!nearest) return mUpTo;
        if (!own && isBehind(nearest->cell)) return 0;
        return std::min(mQueue.front().least, mUpTo);
    }

private:
    std::uint8_t codeOf(const glm::ivec3& cell) const { return mCells.code(cell); }

    bool holdsSurface(const CellRecord& record) const {
        const auto [least, most] = std::minmax_element(std::begin(record.values), std::end(record.values));
        return static_cast<float>(*least) < mCells.isovalue && static_cast<float>(*most) >= mCells.isovalue;
    }

    Box boxOf(const glm::ivec3& cell, const CellRecord& record) const {
        Box box{glm::dvec3(cell) * mSpacing, glm::dvec3(cell + 1) * mSpacing, {}};
        for (int n = 0; n < 8; ++n)
            box.values[n] = static_cast<double>(record.values[n]) - static_cast<double>(mCells.isovalue);
        return box;
    }

    // Goes from the home cell always to the neighbour with the least code, which leads near to the nearest
    // surface: some is no further than that.
    void descend() {
        glm::ivec3 cell = mHome;
        for (std::uint8_t code = codeOf(cell); code > kCellActive;) {
            glm::ivec3 best = cell;
            forNeighbours(cell, [&](const glm::ivec3& next) {
                const std::uint8_t there = codeOf(next);
                if (there >= code || (there == kCellActive && !mCells.record(next))) return;
                code = there;
                best = next;
            });
            if (best == cell) return;
            cell = best;
        }
        const std::optional<CellRecord> record = mCells.record(cell);
        if (record && holdsSurface(*record))
            mMost = std::min(mMost, boundsOf(boxOf(cell, *record), mPoint, mTolerance).most);
    }

    // Visits a cell in the volume and the 26 around it that are in it too.
    template <typename Visit>
    void forNeighbours(const glm::ivec3& cell, const Visit& visit) const {
        const glm::ivec3 low = glm::max(cell - 1, 0), high = glm::min(cell + 1, mLast);
        for (int k = low.z; k <= high.z; ++k)
            for (int j = low.y; j <= high.y; ++j)
                for (int i = low.x; i <= high.x; ++i) visit({i, j, k});
    }

    // All cells no further than what is known.
    void visitAll() {
        const double most = mMost / std::min({mSpacing.x, mSpacing.y, mSpacing.z});
        const int reach = static_cast<int>(
            std::min(most + 1, static_cast<double>(std::max({mLast.x, mLast.y, mLast.z}) + 1)));
        int size = 2;
        while (size < 2 * reach + 2) size *= 2;
        visitBlock(mHome - size / 2, size);
    }

    // size: cells along each side, a power of two.
    void visitBlock(const glm::ivec3& low, int size) {
        if (low.x > mLast.x || low.y > mLast.y || low.z > mLast.z) return;
        if (low.x + size <= 0 || low.y + size <= 0 || low.z + size <= 0) return;
        if (squaredTo(low, size) > mMost * mMost) return;
        const int half = size / 2;
        if (isFree(low + half, half)) return;
        if (size <= kSmallestBlock) return visitRows(low, size);
        // The nearest eighth first.
        const glm::ivec3 nearest(mHome.x >= low.x + half, mHome.y >= low.y + half, mHome.z >= low.z + half);
        for (int n = 0; n < 8; ++n) {
            const glm::ivec3 part = glm::ivec3(n & 1, n >> 1 & 1, n >> 2) ^ nearest;
            visitBlock(low + half * part, half);
        }
    }

    // Returns the squared distance from the point to the nearest point of a cell, or of a block of them.
    double squaredTo(const glm::ivec3& cell, int size = 1) const {
        const glm::dvec3 low = glm::dvec3(cell) * mSpacing;
        const glm::dvec3 away = mPoint - glm::clamp(mPoint, low, low + static_cast<double>(size) * mSpacing);
        return glm::dot(away, away);
    }

    // Returns whether a cell's code says that none is active up to `reach` cells from it along all axes.
    bool isFree(const glm::ivec3& cell, int reach) const {
        if (cell.x < 0 || cell.y < 0 || cell.z < 0 || cell.x > mLast.x || cell.y > mLast.y ||
            cell.z > mLast.z)
            return false;
        const std::uint8_t code = codeOf(cell);
        return code > kCellNear && (code - 1) * mCells.leapUnit > reach * mDiagonal;
    }

    // A small block row by row. What a code keeps free of a row is skipped.
    void visitRows(const glm::ivec3& low, int size) {
        const glm::ivec3 first = glm::max(low, 0), last = glm::min(low + size - 1, mLast);
        const double perCode = mCells.leapUnit / mSpacing.x;
        for (int k = first.z; k <= last.z; ++k)
            for (int j = first.y; j <= last.y; ++j)
                for (int i = first.x; i <= last.x; ++i) {
                    const std::uint8_t code = codeOf({i, j, k});
                    if (code > kCellNear) i += static_cast<int>((code - 1) * perCode);
                    if (code == kCellActive) visitCell({i, j, k});
                }
    }

    void visitCell(const glm::ivec3& cell) {
        if (squaredTo(cell) > mMost * mMost) return;
        const std::optional<CellRecord> record = mCells.record(cell);
        if (record && holdsSurface(*record)) consider({boxOf(cell, *record), cell, 0});
    }

    // Queues a box that holds surface unless other surface is nearer.
    void consider(const Candidate& candidate) {
        const Bounds bounds = boundsOf(candidate.box, mPoint, mTolerance);
        if (bounds.least > mMost) return;
        mMost = std::min(mMost, bounds.most);
        mQueue.push_back({bounds.least, mCandidates.size()});
        mCandidates.push_back(candidate);
        std::push_heap(mQueue.begin(), mQueue.end());
    }

    // Halves the box that may be nearest until it is known to be, within the tolerance, and gives it; null
    // where there is no surface within reach.
    const Candidate* settle() {
        while (!mQueue.empty()) {
            const Candidate top = mCandidates[mQueue.front().candidate];
            constexpr int kDeepest = 75;  // 25 halvings an axis: finer than the least tolerance
            if (mMost - mQueue.front().least <= mTolerance || top.halvings >= kDeepest)
                return &mCandidates[mQueue.front().candidate];
            std::pop_heap(mQueue.begin(), mQueue.end());
            mQueue.pop_back();
            const glm::dvec3 extent = top.box.high - top.box.low;
            const int axis =
                extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
            for (const bool upper : {false, true}) {
                const Box half = top.box.half(axis, upper);
                if (half.holdsSurface()) consider({half, top.cell, top.halvings + 1});
            }
        }
        return nullptr;
    }

    // Nothing of the surface lies between the point and the cell's nearest point, so both are on the same
    // side of it; where that is on the surface itself, the cell's other corners tell.
    bool isBehind(const glm::ivec3& cell) const {
        const Box box = boxOf(cell, *mCells.record(cell));
        const double value = box.valueAt(glm::clamp(mPoint, box.low, box.high));
        if (std::abs(value) > 1e-9) return value > 0;
        return std::none_of(box.values.begin(), box.values.end(), [](double v) { return v > 0; });
    }

    struct Queued {
        double least;
        std::size_t candidate;
        bool operator<(const Queued& other) const { return least > other.least; }  // the least on top
    };

    const SurfaceCells& mCells;
    glm::dvec3 mSpacing, mPoint;  // metres along the volume's axes
    double mDiagonal;
    glm::ivec3 mLast, mHome;
    double mUpTo, mTolerance;
    double mMost;  // some surface is no further, or none is nearer than upTo
    std::vector<Candidate> mCandidates;
    std::vector<Queued> mQueue;  // a heap
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

double openDistance(const SurfaceCells& cells, const glm::dvec3& world, double upTo, double tolerance) {
    const glm::dvec3 voxel = cells.frame.voxelFromWorld(world), last(cells.frame.size - 1);
    if (!std::isfinite(voxel.x + voxel.y + voxel.z) || cells.codes.empty() || !(upTo > 0)) return 0;
    const glm::dvec3 nearest = glm::clamp(voxel, glm::dvec3(0.0), last);
    const double away = glm::length((voxel - nearest) * cells.frame.spacing);
    if (away >= upTo) return upTo;
    const double further = std::sqrt((upTo - away) * (upTo + away));
    return std::min(std::hypot(away, Search(cells, nearest, further, tolerance).run()), upTo);
}

}  // namespace stereonav