// Bounds of a medium's extinction in each cell of a coarse grid, the majorants and minorants of delta
// tracking, and the walk of a ray through the grid (Amanatides and Woo 1987). Empty cells cost one step;
// homogeneous ones need no reading of the medium.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <limits>
#include <vector>

#include "engine/medium/model/medium.h"

namespace stereonav {

struct ExtinctionRange {
    float least = 0, most = 0;  // 1/m
};

// A grid of cells over a medium, with the least and largest extinction in each.
struct ExtinctionBounds {
    glm::ivec3 size{0};  // cells; 0: the medium is empty
    // The medium's size in cells: at most `size`, since the last cells may be cut off.
    glm::dvec3 extent{0.0};
    glm::dvec3 origin{0.0};        // world, metres: the low corner of cell (0, 0, 0)
    glm::dmat3 cellsFromWay{1.0};  // cell coordinates = this * (world - origin)
    std::vector<ExtinctionRange> cells;

    glm::dvec3 cellsFromWorld(const glm::dvec3& world) const { return cellsFromWay * (world - origin); }
    std::size_t index(const glm::ivec3& c) const {
        return (static_cast<std::size_t>(c.z) * size.y + c.y) * size.x + c.x;
    }
    const ExtinctionRange& at(const glm::ivec3& c) const { return cells[index(c)]; }
};

// Makes bounds that hold at every point of the medium at that time, seconds. Cells follow the voxels of a
// grid, or the world's axes for layers.
ExtinctionBounds makeExtinctionBounds(const Medium& medium, double time);

struct WorldRay {
    glm::dvec3 origin{0.0}, direction{0, 0, -1};  // world, metres; unit
    glm::dvec3 at(double distance) const { return origin + distance * direction; }
};

// The cells that a ray passes between two distances, metres, nearest first.
class CellWalk {
public:
    CellWalk(const ExtinctionBounds& bounds, const WorldRay& ray, double first, double last);

    bool inside() const { return mInside; }
    double begin() const { return mBegin; }  // metres along the ray at which the cell begins
    double end() const { return mEnd; }
    const ExtinctionRange& range() const { return mBounds.at(mCell); }
    void step();

private:
    bool clip(const glm::dvec3& start, double first, double last);
    double nearestFace() const { return std::min({mNext.x, mNext.y, mNext.z}); }

    const ExtinctionBounds& mBounds;
    glm::dvec3 mWay{0.0};               // cells per metre of the ray
    glm::dvec3 mNext{0.0}, mEach{0.0};  // metres to the next face across each axis, and between faces
    glm::ivec3 mCell{0};
    double mBegin = 0, mEnd = 0, mLast = 0;
    bool mInside = false;
};

inline bool CellWalk::clip(const glm::dvec3& start, double first, double last) {
    mBegin = first;
    mLast = last;
    for (int a = 0; a < 3; ++a) {
        const double size = mBounds.extent[a];
        if (mWay[a] == 0.0) {
            if (!(start[a] >= 0 && start[a] <= size)) return false;
            continue;
        }
        const double low = -start[a] / mWay[a], high = (size - start[a]) / mWay[a];
        if (std::isnan(low) || std::isnan(high)) return false;
        mBegin = std::max(mBegin, std::min(low, high));
        mLast = std::min(mLast, std::max(low, high));
    }
    return mBegin < mLast;
}

inline CellWalk::CellWalk(const ExtinctionBounds& bounds, const WorldRay& ray, double first, double last)
    : mBounds(bounds), mWay(bounds.cellsFromWay * ray.direction) {
    const glm::dvec3 start = bounds.cellsFromWorld(ray.origin);
    if (bounds.size.x == 0 || !clip(start, first, last)) return;
    for (int a = 0; a < 3; ++a) {
        const double place = start[a] + mWay[a] * mBegin;
        mCell[a] = std::clamp(static_cast<int>(std::floor(place)), 0, bounds.size[a] - 1);
        const bool none = mWay[a] == 0.0;
        mEach[a] = none ? std::numeric_limits<double>::infinity() : 1 / std::abs(mWay[a]);
        mNext[a] = none ? mEach[a] : (mCell[a] + (mWay[a] > 0 ? 1 : 0) - start[a]) / mWay[a];
    }
    mInside = true;
    mEnd = std::clamp(nearestFace(), mBegin, mLast);
}

inline void CellWalk::step() {
    const int a = mNext.x <= mNext.y ? (mNext.x <= mNext.z ? 0 : 2) : (mNext.y <= mNext.z ? 1 : 2);
    mCell[a] += mWay[a] > 0 ? 1 : -1;
    mNext[a] += mEach[a];
    mBegin = mEnd;
    mInside = mBegin < mLast && mCell[a] >= 0 && mCell[a] < mBounds.size[a];
    mEnd = std::clamp(nearestFace(), mBegin, mLast);
}

}  // namespace stereonav
