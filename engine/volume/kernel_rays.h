// Packets of rays in a volume's voxel space: where they are, how far they may leap, which cell comes next.
// Included by kernels only.
#pragma once

#include "engine/simd/simd.h"
#include "engine/volume/volume_kernel_types.h"

namespace stereonav::STEREONAV_ISA {

// Three coordinates a lane.
struct V3 {
    F x, y, z;
};
STEREONAV_INLINE F dot(const V3& a, const V3& b) {
    return mulAdd(a.x, b.x, mulAdd(a.y, b.y, a.z * b.z));
}

// Indices of cells.
struct Cells {
    I x, y, z;  // from the eye's cell
};

// One ray a lane. Directions that are almost parallel to a plane of the grid are kept off it, so that their
// inverses are finite; what a ray misses by that is far below a voxel.
struct Rays {
    V3 direction, inverse;  // voxels a metre of view depth, and its inverse
    V3 farAtEye;            // view depths of the far planes of the cell that the eye is in
    I stepX, stepY, stepZ;  // 1 or -1: to the next cell
    F perMetre;             // view depth a metre of way, 0 to 1
    F windowX, windowY;     // place in the window at unit view depth
};

// Returns d, or 1e-12 with its sign where it is nearer to 0.
STEREONAV_INLINE F awayFromZero(F d) {
    const F tiny(1e-12f);
    return select(abs(d) < tiny, select(d < F(0.0f), F(-1e-12f), tiny), d);
}

// Sets all that follows from the direction; eye: where the rays start, in its cell.
STEREONAV_INLINE void setDirection(Rays& r, const V3& direction, const float* eye) {
    const F zero(0.0f), one(1.0f);
    r.direction = direction;
    r.inverse = {one / direction.x, one / direction.y, one / direction.z};
    const auto forward = [&](F d) { return d > zero; };
    r.stepX = select(forward(direction.x), I(1), I(-1));
    r.stepY = select(forward(direction.y), I(1), I(-1));
    r.stepZ = select(forward(direction.z), I(1), I(-1));
    const auto plane = [&](F d, F inverse, float start) {
        return (select(forward(d), one, zero) - F(start)) * inverse;
    };
    r.farAtEye = {plane(direction.x, r.inverse.x, eye[0]), plane(direction.y, r.inverse.y, eye[1]),
                  plane(direction.z, r.inverse.z, eye[2])};
}

// Sets where rays cross the window, which is all that light of a lamp asks for. x, y: pixels, whose centres
// the rays go through.
STEREONAV_INLINE void setWindow(Rays& r, const VolumeView& view, F x, F y) {
    r.windowX = mulAdd(x + F(0.5f), F(view.pixelWidth), F(view.xMin));
    r.windowY = mulAdd(y + F(0.5f), F(-view.pixelHeight), F(view.yMax));
    r.perMetre = approxRsqrt(mulAdd(r.windowX, r.windowX, mulAdd(r.windowY, r.windowY, F(1.0f))));
}

// Makes the rays through the centres of pixels.
STEREONAV_INLINE Rays makeRays(const VolumeView& view, F x, F y) {
    Rays r;
    const auto along = [&](int k) {
        return awayFromZero(
            mulAdd(x, F(static_cast<float>(view.perX[k])),
                   mulAdd(y, F(static_cast<float>(view.perY[k])), F(static_cast<float>(view.direction[k])))));
    };
    setDirection(r, {along(0), along(1), along(2)}, view.eye);
    setWindow(r, view, x, y);
    return r;
}

// The volume's cells, counted from the eye's.
struct Grid {
    const CellData& data;
    F eyeX, eyeY, eyeZ;  // place in its cell, 0..1
    I baseX, baseY, baseZ, lastX, lastY, lastZ;
    STEREONAV_INLINE Grid(const CellData& cells, const VolumeView& view) : Grid(cells, view.base, view.eye) {}
    STEREONAV_INLINE Grid(const CellData& cells, const std::int32_t* base, const float* eye)
        : data(cells),
          eyeX(eye[0]),
          eyeY(eye[1]),
          eyeZ(eye[2]),
          baseX(base[0]),
          baseY(base[1]),
          baseZ(base[2]),
          lastX(cells.last[0]),
          lastY(cells.last[1]),
          lastZ(cells.last[2]) {}

    STEREONAV_INLINE Cells cellsAt(const V3& direction, F t) const {
        return {floorToInt(mulAdd(t, direction.x, eyeX)), floorToInt(mulAdd(t, direction.y, eyeY)),
                floorToInt(mulAdd(t, direction.z, eyeZ))};
    }
    STEREONAV_INLINE M inside(const Cells& c) const {
        return within(c.x + baseX, lastX) & within(c.y + baseY, lastY) & within(c.z + baseZ, lastZ);
    }
    // Returns the index of cells inside the volume.
    STEREONAV_INLINE I index(const Cells& c) const {
        const I x = c.x + baseX, y = c.y + baseY, z = c.z + baseZ;
        const I brick =
            (shiftRight<4>(z) * I(data.brickCount[1]) + shiftRight<4>(y)) * I(data.brickCount[0]) +
            shiftRight<4>(x) + I(data.firstBrick);
        const I low(15);
        return shiftLeft<12>(brick) | shiftLeft<8>(z & low) | shiftLeft<4>(y & low) | (x & low);
    }
    // Returns the codes of the cells with these indices. Cells of far bricks have none of their own: it is
    // their group's.
    STEREONAV_INLINE I code(I index, M m) const {
        const I code = gatherByte(data.codes, index, m);
        if (!data.farCodes) return code;
        const M none = m & (code == I(0));
        if (!any(none)) return code;
        const I group = shiftLeft<6>(shiftRight<12>(index)) | (shiftRight<6>(index) & I(48)) |
                        (shiftRight<4>(index) & I(12)) | (shiftRight<2>(index) & I(3));
        return select(none, gatherByte(data.farCodes, group, none), code);
    }
};

// Returns view depths at which rays leave through the planes of their cells.
STEREONAV_INLINE V3 farPlanes(const Rays& r, const Cells& c) {
    return {mulAdd(toFloat(c.x), r.inverse.x, r.farAtEye.x), mulAdd(toFloat(c.y), r.inverse.y, r.farAtEye.y),
            mulAdd(toFloat(c.z), r.inverse.z, r.farAtEye.z)};
}

// Where rays are: all that a walk changes.
struct Walk {
    F t;  // view depth, metres, free of surface up to here
    Cells at;
    M active;  // still on its way
};

// Steps to the next cell: cells are counted, not found again from a rounded position, so that a ray's cells
// do not depend on how it came there.
STEREONAV_INLINE void stepCell(const Rays& r, Walk& w, M m) {
    const V3 far = farPlanes(r, w.at);
    const F next = min(far.x, min(far.y, far.z));
    w.t = select(m, max(w.t, next), w.t);
    w.at.x = w.at.x + select(m & (far.x <= next), r.stepX, I(0));
    w.at.y = w.at.y + select(m & (far.y <= next), r.stepY, I(0));
    w.at.z = w.at.z + select(m & (far.z <= next), r.stepZ, I(0));
}

// Rays under way for each that has arrived, at which the others wait no longer.
constexpr int kStragglers = 2;
// Lanes that stand in active cells, and the cells' indices.
struct Parked {
    M lanes;
    I index;
};
// A packet while it leaps.
class Leaper {
public:
    STEREONAV_INLINE Leaper(const Grid& grid, const Rays& rays, Walk& walk)
        : mGrid(grid), mRays(rays), mWalk(walk), mMoving(walk.active), mParked{maskFromBits(0), I(0)} {}

    STEREONAV_INLINE bool goesOn() const {
        return __builtin_popcount(bits(mMoving)) * kStragglers > __builtin_popcount(bits(mParked.lanes));
    }
    STEREONAV_INLINE void step() {
        const I none(0), nearby(1);
        const M in = mGrid.inside(mWalk.at);
        mWalk.active = andNot(mWalk.active, andNot(mMoving, in));
        mMoving = mMoving & in;
        const I index = mGrid.index(mWalk.at);
        const I code = mGrid.code(index, mMoving);
        const M here = mMoving & (code == none);
        mParked.index = select(here, index, mParked.index);
        mParked.lanes = mParked.lanes | here;
        mMoving = andNot(mMoving, here);
        M wide = mGrid.data.leaping ? mMoving & (nearby < code) : maskFromBits(0);
        if (any(wide)) {
            const F ahead = mulAdd(toFloat(code - nearby) * F(mGrid.data.leapUnit), mRays.perMetre, mWalk.t);
            // Far to the side of a view a leap may be less than the view depth's rounding: such rays walk.
            wide = wide & (mWalk.t < ahead);
            mWalk.t = select(wide, ahead, mWalk.t);
            const Cells c = mGrid.cellsAt(mRays.direction, mWalk.t);
            mWalk.at = {select(wide, c.x, mWalk.at.x), select(wide, c.y, mWalk.at.y),
                        select(wide, c.z, mWalk.at.z)};
        }
        const M walk = andNot(mMoving, wide);
        stepCell(mRays, mWalk, walk);
    }
    STEREONAV_INLINE Parked parked() const { return mParked; }

private:
    const Grid& mGrid;
    const Rays& mRays;
    Walk& mWalk;
    M mMoving;
    Parked mParked;
};

// Leaps and steps until most active rays stand in active cells, or have left: a few that still have far to go
// do not hold up the others.
STEREONAV_INLINE Parked leap(const Grid& grid, const Rays& r, Walk& w) {
    Leaper leaper(grid, r, w);
    while (leaper.goesOn()) leaper.step();
    return leaper.parked();
}

}  // namespace stereonav::STEREONAV_ISA
