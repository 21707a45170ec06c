// Places on isosurfaces: smoothed normals (Y3 of docs/ledger.md) and lifted starts, like isovalue_surface.h
// but for vectors. Included by kernels only.
#pragma once

#include "engine/light/paths/path_trace.h"

namespace stereonav::STEREONAV_ISA {

// A place: a cell, and coordinates in it from its first corner, 0 to 1.
struct Place {
    I3 cell;
    V3 local;
};

// Weights of four voxels along an axis and of their slopes: the cubic B-spline.
struct Spline {
    F value[4], slope[4];
    STEREONAV_INLINE explicit Spline(F f) {
        const F g = F(1.0f) - f, f2 = f * f, g2 = g * g, sixth(1.0f / 6);
        value[0] = g2 * g * sixth;
        value[1] = mulAdd(f2, mulAdd(f, F(0.5f), F(-1.0f)), F(2.0f / 3));
        value[2] = mulAdd(g2, mulAdd(g, F(0.5f), F(-1.0f)), F(2.0f / 3));
        value[3] = f2 * f * sixth;
        slope[0] = F(-0.5f) * g2;
        slope[1] = f * mulAdd(F(1.5f), f, F(-2.0f));
        slope[2] = g * mulAdd(F(-1.5f), g, F(2.0f));
        slope[3] = F(0.5f) * f2;
    }
};

// Below this share of the values that it was computed from, a slope is only rounding.
constexpr float kRounding = 1e-5f;

constexpr float kOwnSlopeOnly = 0.25f;  // kOwnSlope of isovalue_surface.h

// Finds smoothed normals of the surfaces of `isovalue` (stored numbers) at places, in the lanes m.
class NormalFinder {
public:
    STEREONAV_INLINE NormalFinder(const PathVolume& volume, const Place& at, F isovalue, M m)
        : mVolume(volume),
          mIsovalue(isovalue),
          mLanes(m),
          mX(at.local.x),
          mY(at.local.y),
          mZ(at.local.z),
          mLocal(at.local) {
        const I zero(0), last(volume.size[0] - 2);
        mFirst = at.cell.x == zero;
        mLast = at.cell.x == last;
        mLeft = max(at.cell.x - I(1), zero);
        mRight = min(at.cell.x + I(1), last);
        mCellY = at.cell.y;
        mCellZ = at.cell.z;
    }

    // Returns unit normals, along the axes, towards smaller values; 0 where the gradient vanishes.
    STEREONAV_INLINE V3 find() const {
        F gx(0.0f), gy(0.0f), gz(0.0f), mean(0.0f);
        Corners cell;
        for (int c = 0; c < 4; ++c) {
            F slope(0.0f), value(0.0f), across(0.0f);
            const I slice = clamped(mCellZ, c, mVolume.size[2]) * I(mVolume.size[1]);
            for (int b = 0; b < 4; ++b) {
                const Row row = rowAt((slice + clamped(mCellY, b, mVolume.size[1])) * I(mVolume.size[0]));
                if ((b == 1 || b == 2) && (c == 1 || c == 2)) {
                    cell.v[4 * (c - 1) + 2 * (b - 1)] = row.second;
                    cell.v[4 * (c - 1) + 2 * (b - 1) + 1] = row.third;
                }
                slope = mulAdd(row.slope, mY.value[b], slope);
                value = mulAdd(row.value, mY.value[b], value);
                across = mulAdd(row.value, mY.slope[b], across);
            }
            gx = mulAdd(slope, mZ.value[c], gx);
            gy = mulAdd(across, mZ.value[c], gy);
            gz = mulAdd(value, mZ.slope[c], gz);
            mean = mulAdd(value, mZ.value[c], mean);
        }
        return unitOf({gx, gy, gz}, slopeIn(cell), mean);
    }

private:
    struct Row {
        F value, slope, second, third;
    };
    STEREONAV_INLINE static I clamped(I cell, int n, int size) {
        return clamp(cell + I(n - 1), I(0), I(size - 1));
    }
    STEREONAV_INLINE Row rowAt(I row) const {
        const I a = gatherHalves(mVolume.values, row + mLeft, mLanes);
        const I b = gatherHalves(mVolume.values, row + mRight, mLanes);
        const auto low = [](I two) { return toFloat(shiftRight<16>(shiftLeft<16>(two))); };
        const auto high = [](I two) { return toFloat(shiftRight<16>(two)); };
        const F v0 = low(a) - mIsovalue, v3 = high(b) - mIsovalue;
        const F v1 = select(mFirst, v0, high(a) - mIsovalue), v2 = select(mLast, v3, low(b) - mIsovalue);
        const auto sum = [&](const F* w) {
            return mulAdd(v0, w[0], mulAdd(v1, w[1], mulAdd(v2, w[2], v3 * w[3])));
        };
        return {sum(mX.value), sum(mX.slope), v1, v2};
    }
    // Returns whether places are inside their cell, not on its faces, where the trilinear values have two
    // slopes.
    STEREONAV_INLINE M withinCell() const {
        const F zero(0.0f), one(1.0f);
        return (mLocal.x > zero) & (mLocal.x < one) & (mLocal.y > zero) & (mLocal.y < one) &
               (mLocal.z > zero) & (mLocal.z < one);
    }
    // Returns the slope of the trilinear values, per voxel.
    STEREONAV_INLINE V3 slopeIn(const Corners& c) const {
        const auto along = [&](int k, F s, F t, int a, int b) {
            const F low = lerp(c.v[k] - c.v[0], c.v[a + k] - c.v[a], s);
            return lerp(low, lerp(c.v[b + k] - c.v[b], c.v[a + b + k] - c.v[a + b], s), t);
        };
        return {along(1, mLocal.y, mLocal.z, 2, 4), along(2, mLocal.x, mLocal.z, 1, 4),
                along(4, mLocal.x, mLocal.y, 1, 2)};
    }
    // Returns the direction towards smaller values, in units of length along the axes.
    STEREONAV_INLINE V3 downOf(const V3& slope) const {
        return {F(0.0f) - slope.x * F(mVolume.step[0]), F(0.0f) - slope.y * F(mVolume.step[1]),
                F(0.0f) - slope.z * F(mVolume.step[2])};
    }
    STEREONAV_INLINE V3 unitOf(const V3& smooth, const V3& slope, F mean) const {
        const V3 own = downOf(slope);
        V3 down = downOf(smooth);
        const M other = withinCell() & (dot(down, own) < dot(own, own) * F(kOwnSlopeOnly));
        down = {select(other, own.x, down.x), select(other, own.y, down.y), select(other, own.z, down.z)};
        const V3 g{select(other, slope.x, smooth.x), select(other, slope.y, smooth.y),
                   select(other, slope.z, smooth.z)};
        const F scale = max(max(abs(g.x), abs(g.y)), abs(g.z));
        const M flat = scale <= max(abs(mean) * F(kRounding), F(1e-12f));
        const F inverse = select(flat, F(0.0f), F(1.0f) / sqrt(max(dot(down, down), F(1e-30f))));
        return {down.x * inverse, down.y * inverse, down.z * inverse};
    }

    const PathVolume& mVolume;
    F mIsovalue;
    M mLanes, mFirst, mLast;
    I mLeft, mRight, mCellY, mCellZ;
    Spline mX, mY, mZ;
    V3 mLocal;
};

// Returns values at places of cells, from 0 to 1 along each axis.
STEREONAV_INLINE F trilinear(const Corners& c, const V3& p) {
    const F near = lerp(lerp(c.v[0], c.v[1], p.x), lerp(c.v[2], c.v[3], p.x), p.y);
    const F far = lerp(lerp(c.v[4], c.v[5], p.x), lerp(c.v[6], c.v[7], p.x), p.y);
    return lerp(near, far, p.z);
}

// Moves a place along one axis, kept within the volume.
STEREONAV_INLINE void moveAlong(I& cell, F& local, F by, int size) {
    const F to = local + by;
    const I whole = floorToInt(to), moved = cell + whole;
    const M below = moved < I(0), above = I(size - 2) < moved;
    cell = clamp(moved, I(0), I(size - 2));
    local = select(below, F(0.0f), select(above, F(1.0f), to - toFloat(whole)));
}

constexpr float kLiftsTried[3] = {0.25f, 0.5f, 1.0f};  // kLifts of isovalue_surface.h

// Returns the starts of rays as liftedStart() does; normal: unit, along the axes.
STEREONAV_INLINE Place lifted(const PathVolume& volume, const Place& from, const V3& normal, F isovalue,
                              M m) {
    const V3 way{normal.x * F(volume.step[0]), normal.y * F(volume.step[1]), normal.z * F(volume.step[2])};
    const F perVoxel = F(1.0f) / sqrt(max(dot(way, way), F(1e-30f)));
    Place result = from;
    M searching = m;
    for (const float lift : kLiftsTried) {
        const F by = perVoxel * F(lift);
        Place to = from;
        moveAlong(to.cell.x, to.local.x, way.x * by, volume.size[0]);
        moveAlong(to.cell.y, to.local.y, way.y * by, volume.size[1]);
        moveAlong(to.cell.z, to.local.z, way.z * by, volume.size[2]);
        result.cell = {select(searching, to.cell.x, result.cell.x),
                       select(searching, to.cell.y, result.cell.y),
                       select(searching, to.cell.z, result.cell.z)};
        result.local = {select(searching, to.local.x, result.local.x),
                        select(searching, to.local.y, result.local.y),
                        select(searching, to.local.z, result.local.z)};
        const F value = trilinear(cornersIn(volume, to.cell, isovalue, searching), to.local);
        searching = andNot(searching, value < F(0.0f));
        if (!any(searching)) break;
    }
    return result;
}

}  // namespace stereonav::STEREONAV_ISA
