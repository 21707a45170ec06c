// Cells are full where the largest extinction of the values around them is above 0; boxes are asked by sums
// over all cells before a corner (a summed-volume table), eight numbers a question.
#include "engine/medium/sweep_space.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

// Of layers. With 64 levels the generated terrain's snow is sampled at 69.8 million places for a pair of
// 640x360 pixels, with 32 at 73.9 million, with 128, which take twice the memory, at 67.8 million.
constexpr int kLayerCells = 128, kLayerLevels = 64;
constexpr std::int64_t kMostCells = 1 << 19;

glm::ivec3 cellsFor(const glm::ivec3& voxels, int side) {
    return glm::max((voxels - 2) / side + 1, 1);
}

// The smallest number of voxels a side that gives not too many cells.
int cellSide(const glm::ivec3& voxels) {
    int side = 4;
    for (;; side *= 2) {
        const glm::ivec3 cells = cellsFor(voxels, side);
        if (static_cast<std::int64_t>(cells.x) * cells.y * cells.z <= kMostCells) return side;
    }
}

struct Range {
    std::int16_t low = std::numeric_limits<std::int16_t>::max(),
                 high = std::numeric_limits<std::int16_t>::min();
};
Range rangeOf(const GreyVolume& field, const glm::ivec3& first, const glm::ivec3& last) {
    Range r;
    for (int k = first.z; k <= last.z; ++k)
        for (int j = first.y; j <= last.y; ++j)
            for (int i = first.x; i <= last.x; ++i) {
                r.low = std::min(r.low, field.at(i, j, k));
                r.high = std::max(r.high, field.at(i, j, k));
            }
    return r;
}

// Heights that may be met around a cell's part of the world; none: low > high.
struct Heights {
    float low = std::numeric_limits<float>::infinity(), high = -low;
};
Heights heightsOf(const Plane<float>& plane, const glm::dvec2& first, const glm::dvec2& last) {
    const auto column = [&](double x) { return std::clamp(x, 0.0, plane.width() - 1.0); };
    const auto row = [&](double y) { return std::clamp(y, 0.0, plane.height() - 1.0); };
    Heights h;
    for (int y = static_cast<int>(row(first.y)); y <= static_cast<int>(std::ceil(row(last.y))); ++y)
        for (int x = static_cast<int>(column(first.x)); x <= static_cast<int>(std::ceil(column(last.x))); ++x)
            if (const float v = plane.at(x, y); v == v) {
                h.low = std::min(h.low, v);
                h.high = std::max(h.high, v);
            }
    return h;
}

}  // namespace

SweepSpace::SweepSpace(const Medium& medium) {
    if (medium.bounds().empty()) return;
    if (medium.field())
        takeGrid(medium);
    else
        takeLayers(medium);
    sumUp();
}

void SweepSpace::takeGrid(const Medium& medium) {
    const GreyVolume& field = *medium.field();
    const VolumeFrame& frame = field.frame;
    const int side = cellSide(frame.size);
    const double reach = medium.perturbation().largestDisplacement();
    const glm::ivec3 margin(glm::ceil(reach / (frame.spacing * static_cast<double>(side))));
    const glm::ivec3 inner = cellsFor(frame.size, side);
    mSize = inner + 2 * margin;
    mTurn = glm::transpose(frame.axes);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) mTurn[column][row] /= frame.spacing[row] * side;
    mOrigin = frame.worldFromVoxel(glm::dvec3(-margin * side));
    mFull.assign(static_cast<std::size_t>(mSize.x) * mSize.y * mSize.z, 0);
    parallelFor(inner.z, [&](int z) {
        for (int y = 0; y < inner.y; ++y)
            for (int x = 0; x < inner.x; ++x) {
                const glm::ivec3 first = glm::ivec3(x, y, z) * side;
                const Range r = rangeOf(field, first, glm::min(first + side, frame.size - 1));
                const double a = r.low * field.scale + field.offset, b = r.high * field.scale + field.offset;
                mFull[index(x + margin.x, y + margin.y, z + margin.z)] =
                    medium.table().largestExtinction(std::min(a, b), std::max(a, b)) > 0;
            }
    });
    spread(margin);
    mMostFootprint = std::numeric_limits<double>::infinity();
}

// Every cell that is full makes those around it full: the place may be displaced as far.
void SweepSpace::spread(const glm::ivec3& cells) {
    for (int axis = 0; axis < 3; ++axis) {
        if (cells[axis] == 0) continue;
        const std::vector<std::uint8_t> before = mFull;
        glm::ivec3 c;
        for (c.z = 0; c.z < mSize.z; ++c.z)
            for (c.y = 0; c.y < mSize.y; ++c.y)
                for (c.x = 0; c.x < mSize.x; ++c.x) {
                    if (!before[index(c.x, c.y, c.z)]) continue;
                    glm::ivec3 to = c;
                    const int last = std::min(c[axis] + cells[axis], mSize[axis] - 1);
                    for (to[axis] = std::max(c[axis] - cells[axis], 0); to[axis] <= last; ++to[axis])
                        mFull[index(to.x, to.y, to.z)] = 1;
                }
    }
}

// A cell is full where a layer's heights in it and its neighbours come near; footprints up to a third of a
// cell read no further.
void SweepSpace::takeLayers(const Medium& medium) {
    const WorldBox& box = medium.bounds();
    const double reach = medium.perturbation().largestDisplacement();
    mSize = {kLayerCells, kLayerCells, kLayerLevels};
    const glm::dvec3 cell = (box.high - box.low) / glm::dvec3(mSize);
    mOrigin = box.low;
    mTurn = glm::dmat3(1.0);
    for (int axis = 0; axis < 3; ++axis) mTurn[axis][axis] = 1 / cell[axis];
    mMostFootprint = std::min(cell.x, cell.y) / 3;
    mFull.assign(static_cast<std::size_t>(mSize.x) * mSize.y * mSize.z, 0);
    parallelFor(mSize.y, [&](int y) {
        for (int x = 0; x < mSize.x; ++x)
            for (const HeightLayer& layer : medium.layers()) {
                if (layer.levels.empty()) continue;
                const glm::dvec2 origin(layer.originX, layer.originY);
                const auto sample = [&](double cx, double cy, double out) {
                    return (glm::dvec2(box.low) + glm::dvec2(cx, cy) * glm::dvec2(cell) + out - origin) /
                           layer.spacing;
                };
                const Heights h =
                    heightsOf(layer.levels[0], sample(x - 1, y - 1, -reach), sample(x + 2, y + 2, reach));
                if (!(h.low <= h.high)) continue;
                const double low = (h.low - layer.below - reach - box.low.z) / cell.z,
                             high = (h.high + layer.above + reach - box.low.z) / cell.z;
                const int last = std::min(static_cast<int>(std::floor(high)), mSize.z - 1);
                for (int z = std::max(static_cast<int>(std::floor(low)), 0); z <= last; ++z)
                    mFull[index(x, y, z)] = 1;
            }
    });
}

void SweepSpace::sumUp() {
    const glm::ivec3 n = mSize + 1;
    mSums.assign(static_cast<std::size_t>(n.x) * n.y * n.z, 0);
    const auto at = [&](int x, int y, int z) -> std::int32_t& {
        return mSums[(static_cast<std::size_t>(z) * n.y + y) * n.x + x];
    };
    for (int z = 0; z < mSize.z; ++z)
        for (int y = 0; y < mSize.y; ++y) {
            std::int32_t row = 0;
            for (int x = 0; x < mSize.x; ++x) {
                row += mFull[index(x, y, z)];
                at(x + 1, y + 1, z + 1) = row + at(x + 1, y, z + 1) + at(x + 1, y + 1, z) - at(x + 1, y, z);
            }
        }
    mFull = {};
}

bool SweepSpace::any(const glm::dvec3& low, const glm::dvec3& high) const {
    if (mSums.empty()) return false;
    int a[3], b[3];  // cells a .. b - 1
    for (int axis = 0; axis < 3; ++axis) {
        // A little wider, for rounding; NaN asks for everything.
        const double from = low[axis] - 1e-3, to = high[axis] + 1e-3;
        const int size = mSize[axis];
        if (from >= size || to < 0) return false;
        a[axis] = from > 0 ? static_cast<int>(from) : 0;
        b[axis] = to < size ? static_cast<int>(to) + 1 : size;
    }
    const std::ptrdiff_t row = mSize.x + 1, slice = row * (mSize.y + 1);
    const std::int32_t* near = mSums.data() + a[2] * slice;
    const std::int32_t* far = mSums.data() + b[2] * slice;
    const std::ptrdiff_t first = a[1] * row, last = b[1] * row;
    const auto over = [&](const std::int32_t* sums) {
        return sums[last + b[0]] - sums[last + a[0]] - sums[first + b[0]] + sums[first + a[0]];
    };
    return over(far) != over(near);
}

SweepBeam SweepSpace::beamOf(const SweepGeometry& geometry, const RayFan& fan, bool forward, double x0,
                             double y0, double x1, double y1) const {
    SweepBeam beam;
    const double x = 0.5 * (x0 + x1), y = 0.5 * (y0 + y1);
    const auto wayOf = [&](double px, double py, bool& crosses) {
        const glm::dvec3 way = fan.direction(px, py);
        const double along = glm::dot(way, geometry.axis);
        crosses = crosses && (forward ? along : -along) > kLeastCosine;
        return way / along;
    };
    beam.known = true;
    const glm::dvec3 way = wayOf(x, y, beam.known), place = fan.start(x, y);
    beam.way = cellDirection(way);
    beam.start = glm::dot(place, geometry.axis);
    beam.origin = cellFromWorld(geometry.anchor + place);
    for (int n = 0; n < 4; ++n) {
        const double cx = n & 1 ? x1 : x0, cy = n & 2 ? y1 : y0;
        beam.perWay = glm::max(beam.perWay, glm::abs(cellDirection(wayOf(cx, cy, beam.known) - way)));
        if (!fan.parallel) continue;
        const glm::dvec3 corner = fan.start(cx, cy);  // and on to the plane of the middle
        const glm::dvec3 there = corner + way * (beam.start - glm::dot(corner, geometry.axis));
        beam.spread = glm::max(beam.spread, glm::abs(cellDirection(there - place)));
    }
    beam.side = fan.parallel ? 0 : forward ? 1 : -1;
    return beam;
}

bool SweepSpace::meets(const SweepBeam& beam, double t0, double t1) const {
    const double s0 = t0 - beam.start, s1 = t1 - beam.start;
    const glm::dvec3 p = beam.origin + s0 * beam.way, r = beam.spread + std::abs(s0) * beam.perWay;
    if (t0 == t1) return any(p - r, p + r);
    const glm::dvec3 q = beam.origin + s1 * beam.way, u = beam.spread + std::abs(s1) * beam.perWay;
    return any(glm::min(p - r, q - u), glm::max(p + r, q + u));
}

// Runs of planes are asked for together first.
std::uint32_t SweepSpace::planesMet(const SweepBeam& beam, const double* t, int count) const {
    constexpr int kRun = 4;
    int first = 0, last = count;  // those on the rays' side
    if (beam.side > 0)
        while (first < last && !(t[first] > beam.start)) ++first;
    if (beam.side < 0)
        while (last > first && !(t[last - 1] < beam.start)) --last;
    if (first == last) return 0;
    std::uint32_t met = 0;
    if (!beam.known) {
        for (int n = first; n < last; ++n) met |= 1u << n;
        return met;
    }
    if (!meets(beam, t[first], t[last - 1])) return 0;
    for (int run = first; run < last; run += kRun) {
        const int end = std::min(run + kRun, last);
        if (!meets(beam, t[run], t[end - 1])) continue;
        for (int n = run; n < end; ++n)
            if (meets(beam, t[n], t[n])) met |= 1u << n;
    }
    return met;
}

}  // namespace stereonav
