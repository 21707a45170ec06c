// Traces queues of rays to the isosurface of each ray's own isovalue: leaps over blocks in which nothing
// reaches it, then goes cell by cell (Amanatides and Woo 1987), with the exact cubic in cells that may
// contain it (Y2 of docs/ledger.md). Lanes whose rays have ended take the next ray of the queue; cells that
// may contain the surface wait until enough lanes are in one. Several packets take turns, so that data that
// one waits for (memory, roots, a branch) are there at its next turn. A ray's result depends on nothing but
// the ray. Included by kernels only.
#pragma once

#include "engine/light/paths/path_kernel_types.h"
#include "engine/volume/kernel_cell.h"

namespace stereonav::STEREONAV_ISA {

struct I3 {
    I x, y, z;
};

// Read and write the entries `index` of rows of the store, in the lanes m.
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

// Returns the index of the cell's first corner. cornersFrom() and cornersIn() return the values at the cells'
// corners minus the isovalue.
STEREONAV_INLINE I firstCorner(const PathVolume& volume, const I3& cell) {
    return (cell.z * I(volume.size[1]) + cell.y) * I(volume.size[0]) + cell.x;
}
STEREONAV_INLINE Corners cornersFrom(const PathVolume& volume, I index, F isovalue, M m) {
    const I row(volume.size[0]), slice(volume.size[0] * volume.size[1]);
    const I at[4] = {index, index + row, index + slice, index + slice + row};
    Corners corners;
    for (int n = 0; n < 4; ++n) {
        const I both = gatherHalves(volume.values, at[n], m);
        corners.v[2 * n] = toFloat(shiftRight<16>(shiftLeft<16>(both))) - isovalue;
        corners.v[2 * n + 1] = toFloat(shiftRight<16>(both)) - isovalue;
    }
    return corners;
}

STEREONAV_INLINE Corners cornersIn(const PathVolume& volume, const I3& cell, F isovalue, M m) {
    return cornersFrom(volume, firstCorner(volume, cell), isovalue, m);
}

// Rays along one axis. Rays towards smaller cells are mirrored (cell c is `flip` ^ c), so that all go towards
// larger ones. Distance along the ray to a plane x of the mirrored grid: (x - base) * inverse + first.
struct Rail {
    F origin, direction;  // the ray itself: place in its first cell, 0..1; cells a unit
    F inverse, first;     // inverse: of the direction's size
    I base, at, end;      // first cell, present cell, the first beyond the volume
    I plane;              // plane at which the ray leaves its present box
    I back, flip;         // back: -1 where mirrored, else 0
    STEREONAV_INLINE F unitsTo(I x) const { return mulAdd(toFloat(x - base), inverse, first); }
};

// Returns the ray's data along one axis. mirror: a power of two above all cells, minus 1.
STEREONAV_INLINE Rail railOf(F origin, F direction, I cell, int cells, int mirror) {
    const F way = awayFromZero(direction), inverse = F(1.0f) / way;
    const M back = way < F(0.0f);
    const I flip = keep(back, I(mirror)), at = cell ^ flip;
    return {origin,
            way,
            abs(inverse),
            F(0.0f) - origin * inverse,
            select(back, I(mirror + 1) - cell, cell),
            at,
            select(back, I(mirror + 1), I(cells)),
            at,
            keep(back, I(-1)),
            flip};
}

STEREONAV_INLINE Rail select(M m, const Rail& a, const Rail& b) {
    return {select(m, a.origin, b.origin),   select(m, a.direction, b.direction),
            select(m, a.inverse, b.inverse), select(m, a.first, b.first),
            select(m, a.base, b.base),       select(m, a.at, b.at),
            select(m, a.end, b.end),         select(m, a.plane, b.plane),
            select(m, a.back, b.back),       select(m, a.flip, b.flip)};
}

// Rays that are to be traced.
struct RayQueue {
    const std::int32_t* paths;
    int count;
    const PathStore::Row<float>* way;
    const float* limit;  // largest distances by path, units; null: no limits
};

// The rays of a packet. Each lane is walking (about to step to its planes), fresh (in its first cell, which
// has not been looked up), parked (in a cell that may contain its surface) or idle.
struct Rays3 {
    Rail x, y, z;
    F t, limit, isovalue;  // units of way, units of way, stored numbers
    I path, field;
    I block, octant;  // present block and octant of walking lanes
    I corner;         // first corner of the cells
    M walking, fresh, parked;
};

// Cells in which rays end, collected until whole vectors of them can be searched for the exact place.
struct EndCells {
    static constexpr int kMost = 64, kRoom = kMost + kLanes;
    template <typename T>
    using Row = T[kRoom];
    int count = 0;
    alignas(64) Row<float> cubic[4], in, span;
    alignas(64) Row<float> start[3], way[3];
    alignas(64) Row<std::int32_t> path, cell[3];
};

constexpr int kRaysAtOnce = 64;
constexpr int kPackets = kRaysAtOnce / kLanes > 2 ? kRaysAtOnce / kLanes : 2;
constexpr int kRefill = kLanes / 4 > 0 ? kLanes / 4 : 1;  // least idle lanes that are worth filling
// Whether corners are prefetched. With sixteen lanes so many are fetched at once that it costs more than it
// saves.
constexpr bool kFetchAhead = kLanes <= 8;
// Number of walking lanes per waiting lane, below which waiting ends.
constexpr int kWorthWaiting = 1;

// Traces a queue. With `Places` it finds where rays end. Without `Places` and without `Limited` it finds only
// whether they do.
template <bool Places, bool Limited>
class RayTracer {
public:
    STEREONAV_INLINE RayTracer(const PathVolume& volume, const PathField& field, PathStore& store,
                               const RayQueue& queue)
        : mVolume(volume), mField(field), mStore(store), mQueue(queue) {
        for (int k = 0; k < 3; ++k)
            while (mMirror[k] < volume.size[k]) mMirror[k] = 2 * mMirror[k] + 1;
    }

    // Fills `met` for all rays of the queue: infinite where nothing is met; without Places and Limited, 0
    // where something is. With Places also metCell and metLocal.
    STEREONAV_INLINE void run() {
        for (int n = 0; n < PathStore::kPaths; n += kLanes) store(mStore.met + n, F(__builtin_inff()));
        Rays3 packets[kPackets];
        for (Rays3& r : packets) r = empty();
        bool goesOn = true;
        while (goesOn) {
            goesOn = false;
            for (Rays3& r : packets) {
                if (!worthWalking(r)) {
                    if (any(r.parked)) tryCells(r);
                    refill(r);
                }
                if (any(r.walking | r.fresh)) walkOn(r), goesOn = true;
            }
            for (Rays3& r : packets)
                if (any(r.walking)) lookUp(r);
        }
        finishEnds();
    }

private:
    STEREONAV_INLINE Rays3 empty() const {
        const F zero(0.0f), one(1.0f);
        const I none(0);
        const Rail rail{zero, one, one, zero, none, none, none, none, none, none};
        const M no = maskFromBits(0);
        return {rail, rail, rail, zero, zero, zero, none, none, none, none, none, no, no, no};
    }

    // Returns whether waiting lanes (for the test of their cells, or for a ray) should go on waiting for
    // those that walk.
    STEREONAV_INLINE bool worthWalking(const Rays3& r) const {
        const int walking = lanesIn(r.walking);
        const int waiting = mNext < mQueue.count ? kLanes - walking : lanesIn(r.parked);
        return walking * kWorthWaiting > waiting;
    }

    STEREONAV_INLINE void refill(Rays3& r) {
        std::uint32_t idle = bits(~(r.walking | r.fresh | r.parked));
        const int left = mQueue.count - mNext;
        if (left == 0 || __builtin_popcount(idle) < kRefill) return;
        while (__builtin_popcount(idle) > left) idle &= idle - 1;
        load(r, maskFromBits(idle));
        mNext += __builtin_popcount(idle);
    }

    // Loads the queue's next rays into the lanes m; its list has room for a whole vector behind its end.
    STEREONAV_INLINE void load(Rays3& r, M m) {
        const I path = keep(m, fromFront(loadI(mQueue.paths + mNext), m));
        const V3 local = gatherRows(mStore.local, path, m), way = gatherRows(mQueue.way, path, m);
        const I3 cell = gatherRows(mStore.cell, path, m);
        const auto rail = [&](int k, F origin, F along, I at) {
            return railOf(origin, along * F(mVolume.step[k]), at, mVolume.size[k] - 1, mMirror[k]);
        };
        r.x = select(m, rail(0, local.x, way.x, cell.x), r.x);
        r.y = select(m, rail(1, local.y, way.y, cell.y), r.y);
        r.z = select(m, rail(2, local.z, way.z, cell.z), r.z);
        r.isovalue = select(m, gatherRow(mStore.isovalue, path, m), r.isovalue);
        if constexpr (Limited) {
            r.limit = select(m, gatherRow(mQueue.limit, path, m), r.limit);
            r.t = select(m, F(0.0f), r.t);
        }
        r.path = select(m, path, r.path);
        r.field = select(m, gatherRow(mStore.field, path, m), r.field);
        r.fresh = m;
    }

    // Advances one axis to distance t. The axis whose plane is crossed is set directly and not found from
    // rounded positions, and no axis goes back, so that every step makes progress. Cells are never below 0.
    STEREONAV_INLINE static void moveOn(Rail& a, F t, F end, M m) {
        const I whole = floorToInt(mulAdd(t, a.direction, a.origin));
        const I found = a.base + (whole ^ a.back);
        a.at = max(a.at, keep(m, max(found, keep(end <= t, a.plane))));
    }
    // Moves the walking lanes to the nearest of their planes.
    STEREONAV_INLINE static void step(Rays3& r) {
        const F x = r.x.unitsTo(r.x.plane), y = r.y.unitsTo(r.y.plane), z = r.z.unitsTo(r.z.plane);
        const F t = min(x, min(y, z));
        moveOn(r.x, t, x, r.walking);
        moveOn(r.y, t, y, r.walking);
        moveOn(r.z, t, z, r.walking);
        if constexpr (Limited) r.t = max(r.t, keep(r.walking, t));
    }
    STEREONAV_INLINE static M inside(const Rays3& r) {
        const M in = (r.x.at < r.x.end) & (r.y.at < r.y.end) & (r.z.at < r.z.end);
        if constexpr (Limited) return in & (r.t < r.limit);
        return in;
    }

    // Makes one leap or step of the walking lanes; lanes that end stop walking.
    STEREONAV_INLINE void walkOn(Rays3& r) const {
        step(r);
        r.walking = (r.walking | r.fresh) & inside(r);
        r.fresh = maskFromBits(0);
        const I one(1), less(mField.shift - 1);
        // Octants, and with one bit less blocks.
        const I3 cell{r.x.at ^ r.x.flip, r.y.at ^ r.y.flip, r.z.at ^ r.z.flip};
        r.corner = firstCorner(mVolume, cell);
        const I3 octant{shiftRight(cell.x, less), shiftRight(cell.y, less), shiftRight(cell.z, less)};
        const I3 block{shiftRight<1>(octant.x), shiftRight<1>(octant.y), shiftRight<1>(octant.z)};
        const I index = (block.z * I(mField.across[1]) + block.y) * I(mField.across[0]) + block.x;
        r.block = index + r.field;
        if constexpr (kFetchAhead) fetchBlocks(keep(r.walking, r.block));
        r.octant = (octant.x & one) | shiftLeft<1>(octant.y & one) | shiftLeft<2>(octant.z & one);
    }

    // Looks up the field where the walking lanes are. Lanes in a full octant stop walking; the others get the
    // planes of the box that they may leave at once. Separate from walkOn(), so that all packets wait for
    // memory together.
    STEREONAV_INLINE void lookUp(Rays3& r) const {
        const I none(0), one(1), word = gatherHalves(mField.blocks, r.block, r.walking), code = word & I(255);
        const M leaps = none < code;
        // Moves the octant's bit, one of eight above the code, to the sign.
        const M full = shiftLeft(word, I(23) ^ r.octant) < none;
        const M here = andNot(r.walking & full, leaps);
        r.parked = r.parked | here;
        r.walking = andNot(r.walking, here);
        if constexpr (kFetchAhead) fetchAhead(keep(here, r.corner));
        // Boxes are whole blocks, octants, or, where the surface may be, cells.
        const I half(1 << (mField.shift - 1));
        const I side = half - keep(r.parked, half - one) + keep(leaps, half);
        const I count = max(shiftLeft(code, I(mField.shift)), side), low = none - side;
        r.x.plane = (r.x.at & low) + count;
        r.y.plane = (r.y.at & low) + count;
        r.z.plane = (r.z.at & low) + count;
    }

    STEREONAV_INLINE void fetchBlocks(I block) const {
        alignas(64) std::int32_t lanes[kLanes];
        store(lanes, block);
        for (const std::int32_t lane : lanes) __builtin_prefetch(mField.blocks + 2 * std::int64_t{lane});
    }
    // Prefetches corners that the packet will need at its next turn. For all lanes alike, since a loop over
    // those that need it would be mispredicted.
    STEREONAV_INLINE void fetchAhead(I corner) const {
        alignas(64) std::int32_t lanes[kLanes];
        store(lanes, corner);
        const std::int64_t row = mVolume.size[0], slice = row * mVolume.size[1];
        for (int k = 0; k < kLanes; ++k) {
            const std::int16_t* first = mVolume.values + lanes[k];
            __builtin_prefetch(first);
            __builtin_prefetch(first + row);
            __builtin_prefetch(first + slice);
            __builtin_prefetch(first + slice + row);
        }
    }

    // Lets rays walk on whose cells contain no surface.
    STEREONAV_INLINE void tryCells(Rays3& r) {
        const I one(1);
        const I fromX = r.x.at - r.x.base, fromY = r.y.at - r.y.base, fromZ = r.z.at - r.z.base;
        const auto leaves = [&](const Rail& a, I from) {
            return mulAdd(toFloat(from + one), a.inverse, a.first);
        };
        const F x = leaves(r.x, fromX), y = leaves(r.y, fromY), z = leaves(r.z, fromZ);
        const F in = max(max(x - r.x.inverse, F(0.0f)), max(y - r.y.inverse, z - r.z.inverse));
        const F out = max(in, min(x, min(y, z))), span = out - in;
        const auto place = [&](const Rail& a, I from) {
            return inCell(a.origin, in, a.direction, from ^ a.back);
        };
        const V3 start{place(r.x, fromX), place(r.y, fromY), place(r.z, fromZ)};
        const V3 way{span * r.x.direction, span * r.y.direction, span * r.z.direction};
        const I3 cell{r.x.at ^ r.x.flip, r.y.at ^ r.y.flip, r.z.at ^ r.z.flip};
        const Cubic cubic = cubicAlong(cornersFrom(mVolume, r.corner, r.isovalue, r.parked), start, way);
        const M ends = hasRoot(cubic, r.parked);
        if (any(ends)) {
            keepEnds(r.path, cubic, in, span, start, way, cell, ends);
            if (mEnds.count > EndCells::kMost - kLanes) finishEnds();
        }
        r.walking = r.walking | andNot(r.parked, ends);
        r.parked = maskFromBits(0);
    }

    STEREONAV_INLINE void keepEnds(I path, const Cubic& cubic, F in, F span, const V3& start, const V3& way,
                                   const I3& cell, M m) {
        const ToFront front(m);
        const int n = mEnds.count;
        store(mEnds.path + n, front(path));
        if constexpr (Places || Limited) {
            store(mEnds.cubic[0] + n, front(cubic.c0));
            store(mEnds.cubic[1] + n, front(cubic.c1));
            store(mEnds.cubic[2] + n, front(cubic.c2));
            store(mEnds.cubic[3] + n, front(cubic.c3));
            store(mEnds.in + n, front(in));
            store(mEnds.span + n, front(span));
        }
        if constexpr (Places) {
            const F starts[3] = {start.x, start.y, start.z}, ways[3] = {way.x, way.y, way.z};
            const I cells[3] = {cell.x, cell.y, cell.z};
            for (int k = 0; k < 3; ++k) {
                store(mEnds.start[k] + n, front(starts[k]));
                store(mEnds.way[k] + n, front(ways[k]));
                store(mEnds.cell[k] + n, front(cells[k]));
            }
        }
        mEnds.count += lanesIn(m);
    }

    // Sets hits beyond a path's limit to none.
    __attribute__((noinline)) void finishEnds() {
        if constexpr (!Places && !Limited) {
            for (int n = 0; n < mEnds.count; ++n) mStore.met[mEnds.path[n]] = 0;
        } else {
            for (int n = 0; n < mEnds.count; n += kLanes) finishEnds(n, firstLanes(mEnds.count - n));
        }
        mEnds.count = 0;
    }
    STEREONAV_INLINE void finishEnds(int n, M m) {
        const auto row = [&](const float* r) { return keep(m, loadF(r + n)); };
        const Cubic cubic{row(mEnds.cubic[0]), row(mEnds.cubic[1]), row(mEnds.cubic[2]), row(mEnds.cubic[3])};
        const Root root = firstRoot(cubic, m);
        const F met = mulAdd(root.s, row(mEnds.span), row(mEnds.in));
        const I path = keep(m, loadI(mEnds.path + n));
        M found = root.found;
        if constexpr (Limited) found = found & (met < gatherRow(mQueue.limit, path, m));
        scatter(mStore.met, path, met, found);
        if constexpr (Places) {
            for (int k = 0; k < 3; ++k) {
                const F local = mulAdd(root.s, row(mEnds.way[k]), row(mEnds.start[k]));
                scatter(mStore.metLocal[k], path, clamp(local, F(0.0f), F(1.0f)), found);
                scatter(mStore.metCell[k], path, loadI(mEnds.cell[k] + n), found);
            }
        }
    }

    const PathVolume& mVolume;
    const PathField& mField;
    PathStore& mStore;
    const RayQueue& mQueue;
    int mMirror[3] = {1, 1, 1};
    int mNext = 0;
    EndCells mEnds;
};

}  // namespace stereonav::STEREONAV_ISA
