// Cells of grids are full where the largest extinction of the values around them is above 0; boxes are asked
// by sums over all cells before a corner (a summed-volume table), eight numbers a question. Layers are asked
// by the bounds of their heights.
#include "engine/medium/sweep/sweep_space.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

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

}  // namespace

SweepSpace::SweepSpace(const Medium& medium) {
    if (medium.bounds().empty()) return;
    if (medium.field())
        takeGrid(medium);
    else
        takeLayers(medium);
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
    sumUp();
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

void SweepSpace::takeLayers(const Medium& medium) {
    mBounds = medium.bounds();
    mOrigin = mBounds.low;
    const double reach = medium.perturbation().largestDisplacement();
    for (const HeightLayer& layer : medium.layers())
        if (!layer.levels.empty() && layer.lowest < layer.highest) mLayers.emplace_back(layer, reach);
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

SweepSpace::Filling SweepSpace::fillingOf(const glm::dvec3& low, const glm::dvec3& high) const {
    if (mSums.empty()) return Filling::Empty;
    int a[3], b[3];  // cells a .. b - 1
    bool within = true;
    for (int axis = 0; axis < 3; ++axis) {
        // A little wider, for rounding; NaN asks for everything.
        const double from = low[axis] - 1e-3, to = high[axis] + 1e-3;
        const int size = mSize[axis];
        if (from >= size || to < 0) return Filling::Empty;
        within = within && from >= 0 && to < size;
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
    const std::int32_t full = over(far) - over(near);
    if (full == 0) return Filling::Empty;
    const bool all = within && full == (b[0] - a[0]) * (b[1] - a[1]) * (b[2] - a[2]);
    return all ? Filling::Full : Filling::Partly;
}

bool SweepSpace::anyLayer(const SweepBeam& beam, const glm::dvec3& low, const glm::dvec3& high) const {
    const glm::dvec3 middle = 0.5 * (low + high), half = 0.5 * (high - low);
    double footprint = beam.least;
    for (const SweepBeam::Footprint& f : beam.footprint)
        footprint = std::max(
            footprint, f.constant + glm::dot(f.gradient, middle) + glm::dot(glm::abs(f.gradient), half));
    return std::any_of(mLayers.begin(), mLayers.end(), [&](const HeightBounds& layer) {
        return layer.meets(mOrigin + low, mOrigin + high, footprint);
    });
}

// The footprint of RayFan::pixelSize().
SweepBeam::Footprint SweepSpace::footprintOf(const SweepGeometry& geometry, const RayFan& fan) const {
    if (fan.parallel) return {glm::dvec3(0.0), fan.perX};
    const glm::dvec3 gradient = fan.perX * fan.forward;
    return {gradient, glm::dot(gradient, mOrigin - geometry.anchor - fan.origin)};
}

double SweepSpace::largestFootprint(const SweepGeometry& geometry, const RayFan& fan) const {
    double largest = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::bvec3 high(corner & 1, corner & 2, corner & 4);
        largest =
            std::max(largest, fan.pixelSize(glm::mix(mBounds.low, mBounds.high, high) - geometry.anchor));
    }
    return largest;
}

SweepBeam SweepSpace::lightBeamOf(const SweepGeometry& geometry, double x0, double y0, double x1,
                                  double y1) const {
    SweepBeam beam = beamOf(geometry, geometry.light, true, x0, y0, x1, y1);
    if (mLayers.empty() || geometry.eyes.empty()) return beam;
    SweepBeam::Footprint& all = beam.footprint[1];
    all = footprintOf(geometry, geometry.eyes[0]);
    for (const RayFan& fan : geometry.eyes) {
        const SweepBeam::Footprint eye = footprintOf(geometry, fan);
        if (eye.gradient == all.gradient)  // so it is for both eyes of a pair
            all.constant = std::max(all.constant, eye.constant);
        else
            beam.least = std::max(beam.least, largestFootprint(geometry, fan));
    }
    return beam;
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
    if (!mLayers.empty()) beam.footprint[0] = footprintOf(geometry, fan);
    return beam;
}

SweepSpace::Filling SweepSpace::fillingOf(const SweepBeam& beam, double t0, double t1) const {
    const double s0 = t0 - beam.start, s1 = t1 - beam.start;
    const glm::dvec3 p = beam.origin + s0 * beam.way, r = beam.spread + std::abs(s0) * beam.perWay;
    const auto filling = [&](const glm::dvec3& low, const glm::dvec3& high) {
        if (mLayers.empty()) return fillingOf(low, high);
        return anyLayer(beam, low, high) ? Filling::Partly : Filling::Empty;
    };
    if (t0 == t1) return filling(p - r, p + r);
    const glm::dvec3 q = beam.origin + s1 * beam.way, u = beam.spread + std::abs(s1) * beam.perWay;
    return filling(glm::min(p - r, q - u), glm::max(p + r, q + u));
}

// Runs of planes are asked for together first; where all cells are full there is no more to ask.
std::uint32_t SweepSpace::planesMet(const SweepBeam& beam, const double* t, int count) const {
    constexpr int kRun = 4;
    int first = 0, last = count;  // those on the rays' side
    if (beam.side > 0)
        while (first < last && !(t[first] > beam.start)) ++first;
    if (beam.side < 0)
        while (last > first && !(t[last - 1] < beam.start)) --last;
    if (first == last) return 0;
    const auto planes = [](int from, int to) {
        return static_cast<std::uint32_t>((std::uint64_t{1} << to) - (std::uint64_t{1} << from));
    };
    if (!beam.known) return planes(first, last);
    const Filling all = fillingOf(beam, t[first], t[last - 1]);
    if (all == Filling::Empty) return 0;
    if (all == Filling::Full) return planes(first, last);
    std::uint32_t met = 0;
    for (int run = first; run < last; run += kRun) {
        const int end = std::min(run + kRun, last);
        const Filling filling = fillingOf(beam, t[run], t[end - 1]);
        if (filling == Filling::Full) met |= planes(run, end);
        if (filling != Filling::Partly) continue;
        for (int n = run; n < end; ++n)
            if (fillingOf(beam, t[n], t[n]) != Filling::Empty) met |= 1u << n;
    }
    return met;
}

std::size_t SweepSpace::heldBytes() const {
    std::size_t bytes = mSums.size() * sizeof(std::int32_t);
    for (const HeightBounds& layer : mLayers) bytes += layer.heldBytes();
    return bytes;
}

}  // namespace stereonav
