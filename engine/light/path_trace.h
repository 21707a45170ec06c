// Follows queues of rays to the isosurface of each ray's own isovalue: leaps over blocks in which nothing
// reaches it, then cell by cell (Amanatides and Woo 1987), with the exact cubic in cells that may hold it
// (Y2). Lanes whose rays have ended take the next of the queue; cells wait until enough lanes stand in one.
// What a ray meets depends on nothing but the ray. Included by kernels only.
#pragma once

#include "engine/light/path_kernel_types.h"
#include "engine/volume/kernel_cell.h"

namespace stereonav::STEREONAV_ISA {

struct I3 {
    I x, y, z;
};

STEREONAV_INLINE I gatherRow(const std::int32_t* row, I index, M m) {
    return gather(reinterpret_cast<const std::uint32_t*>(row), index, m);
}
STEREONAV_INLINE F gatherRow(const float* row, I index, M m) {
    return gather(row, index, m, F(0.0f));
}
STEREONAV_INLINE V3 gatherRows(const PathStore::Row<float>* rows, I index, M m) {
    return {gatherRow(rows[0], index, m), gatherRow(rows[1], index, m), gatherRow(rows[2], index, m)};
}
STEREONAV_INLINE I3 gatherRows(const PathStore::Row<std::int32_t>* rows, I index, M m) {
    return {gatherRow(rows[0], index, m), gatherRow(rows[1], index, m), gatherRow(rows[2], index, m)};
}
STEREONAV_INLINE void scatterRows(PathStore::Row<float>* rows, I index, const V3& v, M m) {
    scatter(rows[0], index, v.x, m);
    scatter(rows[1], index, v.y, m);
    scatter(rows[2], index, v.z, m);
}
STEREONAV_INLINE void scatterRows(PathStore::Row<std::int32_t>* rows, I index, const I3& v, M m) {
    scatter(rows[0], index, v.x, m);
    scatter(rows[1], index, v.y, m);
    scatter(rows[2], index, v.z, m);
}
STEREONAV_INLINE int lanesIn(M m) {
    return __builtin_popcount(bits(m));
}

// The values of cells at their corners less the isovalue.
STEREONAV_INLINE Corners cornersIn(const PathVolume& volume, const I3& cell, F isovalue, M m) {
    const I row(volume.size[0]), slice(volume.size[0] * volume.size[1]);
    const I index = (cell.z * I(volume.size[1]) + cell.y) * row + cell.x;
    const I at[4] = {index, index + row, index + slice, index + slice + row};
    Corners corners;
    for (int n = 0; n < 4; ++n) {
        const I both = gatherHalves(volume.values, at[n], m);
        corners.v[2 * n] = toFloat(shiftRight<16>(shiftLeft<16>(both))) - isovalue;
        corners.v[2 * n + 1] = toFloat(shiftRight<16>(both)) - isovalue;
    }
    return corners;
}

// Rays along one axis: units of way to a plane x of the grid are (x - base) * inverse + first.
struct Rail {
    F origin, direction, inverse, first;  // origin: in the first cell, 0..1; direction: cells a unit
    I base, at;                           // first cell, present cell
    I back;                               // -1 for rays towards smaller cells, else 0
    STEREONAV_INLINE F unitsTo(I plane) const { return mulAdd(toFloat(plane - base), inverse, first); }
};

STEREONAV_INLINE Rail railOf(F origin, F direction, I cell) {
    const F way = awayFromZero(direction), inverse = F(1.0f) / way;
    return {origin, way, inverse, F(0.0f) - origin * inverse, cell, cell, select(way < F(0.0f), I(-1), I(0))};
}

STEREONAV_INLINE Rail select(M m, const Rail& a, const Rail& b) {
    return {select(m, a.origin, b.origin),   select(m, a.direction, b.direction),
            select(m, a.inverse, b.inverse), select(m, a.first, b.first),
            select(m, a.base, b.base),       select(m, a.at, b.at),
            select(m, a.back, b.back)};
}

struct RayQueue {
    const std::int32_t* paths;
    int count;
    const PathStore::Row<float>* way;
    const float* limit;  // units of way, by path; null: none
};

// Rays of a packet: each lane is walking, stands in a cell that may hold its surface (parked), or is idle.
struct Rays3 {
    Rail x, y, z;
    F t, limit, isovalue;
    I path, field;
    M walking, parked;
};

constexpr int kRefill = kLanes / 4 > 0 ? kLanes / 4 : 1;  // idle lanes that are worth filling
// Walking lanes for each that waits, below which these do not wait any longer.
constexpr int kWorthWaiting = 2;

class RayTracer {
public:
    STEREONAV_INLINE RayTracer(const PathVolume& volume, const PathField& field, PathStore& store,
                               const RayQueue& queue)
        : mVolume(volume), mField(field), mStore(store), mQueue(queue) {}

    // Fills met (and where, with `Places`) of all rays of the queue.
    template <bool Places>
    STEREONAV_INLINE void run() {
        Rays3 a = empty(), b = empty();
        for (;;) {
            refill(a);
            refill(b);
            if (!any(a.walking | a.parked | b.walking | b.parked)) return;
            walk(a, b);
            if (any(a.parked)) tryCells<Places>(a);
            if (any(b.parked)) tryCells<Places>(b);
        }
    }

private:
    STEREONAV_INLINE Rays3 empty() const {
        const F zero(0.0f), one(1.0f);
        const Rail rail{zero, one, one, zero, I(0), I(0), I(0)};
        const M none = maskFromBits(0);
        return {rail, rail, rail, zero, zero, zero, I(0), I(0), none, none};
    }

    STEREONAV_INLINE void refill(Rays3& r) {
        const M idle = ~(r.walking | r.parked);
        if (mNext < mQueue.count && lanesIn(idle) >= kRefill) load(r, idle);
    }

    STEREONAV_INLINE void load(Rays3& r, M idle) {
        alignas(64) std::int32_t paths[kLanes] = {};
        std::uint32_t filled = 0;
        for (std::uint32_t left = bits(idle); left && mNext < mQueue.count; left &= left - 1) {
            const int lane = __builtin_ctz(left);
            paths[lane] = mQueue.paths[mNext++];
            filled |= 1u << lane;
        }
        const M m = maskFromBits(filled);
        const I path = loadI(paths);
        const V3 local = gatherRows(mStore.local, path, m), way = gatherRows(mQueue.way, path, m);
        const I3 cell = gatherRows(mStore.cell, path, m);
        r.x = select(m, railOf(local.x, way.x * F(mVolume.step[0]), cell.x), r.x);
        r.y = select(m, railOf(local.y, way.y * F(mVolume.step[1]), cell.y), r.y);
        r.z = select(m, railOf(local.z, way.z * F(mVolume.step[2]), cell.z), r.z);
        r.isovalue = select(m, gatherRow(mStore.isovalue, path, m), r.isovalue);
        r.limit = select(m, mQueue.limit ? gatherRow(mQueue.limit, path, m) : F(__builtin_inff()), r.limit);
        r.t = select(m, F(0.0f), r.t);
        r.path = select(m, path, r.path);
        r.field = select(m, gatherRow(mStore.field, path, m), r.field);
        r.walking = r.walking | m;
        scatter(mStore.met, path, F(__builtin_inff()), m);
    }

    STEREONAV_INLINE M inside(const Rays3& r) const {
        return within(r.x.at, I(mVolume.size[0] - 2)) & within(r.y.at, I(mVolume.size[1] - 2)) &
               within(r.z.at, I(mVolume.size[2] - 2)) & (r.t < r.limit);
    }

    // The plane at which an axis leaves the box of `count` groups around the present one; groups of
    // 2^shift cells.
    STEREONAV_INLINE static I farPlane(const Rail& a, I group, I count, I shift) {
        return shiftLeft(group + (count ^ a.back) - (a.back + a.back), shift);
    }
    // On to where the rays are after t. The axis that left its box is set, not found from rounded
    // positions, and none goes back: so every step gets on.
    STEREONAV_INLINE static void moveOn(Rail& a, F t, M left, I plane, M m) {
        const I found = a.base + floorToInt(mulAdd(t, a.direction, a.origin));
        const I ahead = select(a.back < I(0), min(found, a.at), max(found, a.at));
        a.at = select(m, select(left, plane + a.back, ahead), a.at);
    }

    // Two packets at a time: while one waits for its blocks the other computes.
    STEREONAV_INLINE void walk(Rays3& a, Rays3& b) const {
        M movingA = a.walking, movingB = b.walking;
        const M waits = mNext < mQueue.count ? maskFromBits(~0u) : maskFromBits(0);
        const auto waiting = [&](const Rays3& r) { return lanesIn(r.parked | andNot(waits, r.walking)); };
        while ((lanesIn(movingA) + lanesIn(movingB)) * kWorthWaiting > waiting(a) + waiting(b)) {
            walkOn(a, movingA);
            walkOn(b, movingB);
        }
    }

    // One leap or step of the moving lanes; those that end or arrive in a full octant move no more.
    STEREONAV_INLINE void walkOn(Rays3& r, M& moving) const {
        const I none(0), one(1), shift(mField.shift), less(mField.shift - 1);
        const M in = inside(r);
        r.walking = andNot(r.walking, andNot(moving, in));
        moving = moving & in;
        // Octants, and with one bit less blocks.
        const I3 octant{shiftRight(r.x.at, less), shiftRight(r.y.at, less), shiftRight(r.z.at, less)};
        const I3 block{shiftRight<1>(octant.x), shiftRight<1>(octant.y), shiftRight<1>(octant.z)};
        const I index = (block.z * I(mField.across[1]) + block.y) * I(mField.across[0]) + block.x;
        const I word = gatherHalves(mField.blocks, index + r.field, moving);
        const I code = word & I(255);
        const M leaps = none < code;
        const I bit = (octant.x & one) | shiftLeft<1>(octant.y & one) | shiftLeft<2>(octant.z & one);
        const M full = none < (shiftRight(word, bit + I(8)) & one);
        const M here = andNot(moving & full, leaps);
        r.parked = r.parked | here;
        r.walking = andNot(r.walking, here);
        moving = andNot(moving, here);
        const I count = max(code, one), level = select(leaps, shift, less);
        const I planeX = farPlane(r.x, select(leaps, block.x, octant.x), count, level);
        const I planeY = farPlane(r.y, select(leaps, block.y, octant.y), count, level);
        const I planeZ = farPlane(r.z, select(leaps, block.z, octant.z), count, level);
        step(r, planeX, planeY, planeZ, moving);
    }

    STEREONAV_INLINE static void step(Rays3& r, I planeX, I planeY, I planeZ, M m) {
        const F x = r.x.unitsTo(planeX), y = r.y.unitsTo(planeY), z = r.z.unitsTo(planeZ);
        const F t = min(x, min(y, z));
        moveOn(r.x, t, x <= t, planeX, m);
        moveOn(r.y, t, y <= t, planeY, m);
        moveOn(r.z, t, z <= t, planeZ, m);
        r.t = select(m, max(r.t, t), r.t);
    }

    template <bool Places>
    STEREONAV_INLINE void tryCells(Rays3& r) const {
        const I one(1);
        const I planeX = r.x.at + one + r.x.back, planeY = r.y.at + one + r.y.back,
                planeZ = r.z.at + one + r.z.back;
        const F x = r.x.unitsTo(planeX), y = r.y.unitsTo(planeY), z = r.z.unitsTo(planeZ);
        const F in = max(max(x - abs(r.x.inverse), F(0.0f)), max(y - abs(r.y.inverse), z - abs(r.z.inverse)));
        const F out = max(in, min(x, min(y, z))), span = out - in;
        const auto place = [&](const Rail& a) { return inCell(a.origin, in, a.direction, a.at - a.base); };
        const V3 start{place(r.x), place(r.y), place(r.z)};
        const V3 way{span * r.x.direction, span * r.y.direction, span * r.z.direction};
        const I3 cell{r.x.at, r.y.at, r.z.at};
        const Corners corners = cornersIn(mVolume, cell, r.isovalue, r.parked);
        const Root root = firstRoot(cubicAlong(corners, start, way), r.parked);
        const F met = mulAdd(root.s, span, in);
        const M found = r.parked & root.found & (met < r.limit);
        scatter(mStore.met, r.path, met, found);
        if constexpr (Places) {
            const auto along = [&](F from, F by) {
                return clamp(mulAdd(root.s, by, from), F(0.0f), F(1.0f));
            };
            const V3 local{along(start.x, way.x), along(start.y, way.y), along(start.z, way.z)};
            scatterRows(mStore.metCell, r.path, cell, found);
            scatterRows(mStore.metLocal, r.path, local, found);
        }
        const M further = andNot(r.parked, root.found);  // found beyond the limit: nothing is met
        r.parked = maskFromBits(0);
        r.walking = r.walking | further;
        step(r, planeX, planeY, planeZ, further);
    }

    const PathVolume& mVolume;
    const PathField& mField;
    PathStore& mStore;
    const RayQueue& mQueue;
    int mNext = 0;
};

}  // namespace stereonav::STEREONAV_ISA
