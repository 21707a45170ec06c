// A packet of rays against the heightfield: leaps over the pyramid of maxima, then the exact hit of the
// bilinear surface in a cell. Single precision finds the cell, conservatively; double precision has the
// last word on where in it the hit lies. Included by kernels only.
#pragma once

#include "engine/simd/simd.h"
#include "terrain/cast/caster_types.h"

namespace stereonav::STEREONAV_ISA {

// Ray directions for a unit of view depth: grid units for x and y, metres for z.
struct Rays {
    D exactX, exactY, exactZ;
    F x, y, z;
};

// Where rays meet the ground. t is infinite for a miss; then the rest means nothing.
struct Hits {
    F t;
    I i, j;      // cell
    F u, v;      // position in the cell
    F approach;  // rate of height over ground along the ray, metres a unit of t (negative from above)
    F free;      // the ray is above the ground (where there is ground) up to here; 0: not known
};

// What is the same for all rays of a view.
struct Eye {
    const GroundData& ground;
    double x, y, z;    // grid, grid, metres
    int baseI, baseJ;  // grid cell that single-precision coordinates are relative to
    F relativeX, relativeY;
    // Metres: its height as a float and what that leaves over. Heights of the ground are taken from the
    // first, which is exact where both are far from 0, and only then is the rest added: ground at 10,000 km
    // is as exact as ground at 0.
    F height, rest;
    F margin;  // metres: bound of the rounding error of a ray's height (see below)
    I lastI, lastJ;
    float nearDepth;
};

STEREONAV_INLINE int clampInt(double x, int low, int high) {
    return x < low ? low : x > high ? high : static_cast<int>(x);
}

// x, y: of the eye, in grid coordinates of this ground.
STEREONAV_INLINE Eye makeEyeAt(const GroundData& ground, const CasterView& view, double x, double y) {
    const int baseI = clampInt(x, 0, ground.width - 2);
    const int baseJ = clampInt(y, 0, ground.height - 2);
    // Heights take part as (eye - sample) + rest + t * slope, beside differences of samples: each term is
    // rounded once, and each is at most the largest of these in size; 2^-21 of it covers the few roundings of
    // 2^-24.
    const float height = static_cast<float>(view.originZ);
    const auto size = [](double z) { return static_cast<float>(z < 0 ? -z : z); };
    float largest = ground.maxHeight - ground.minHeight;
    if (size(view.originZ - ground.minHeight) > largest) largest = size(view.originZ - ground.minHeight);
    if (size(view.originZ - ground.maxHeight) > largest) largest = size(view.originZ - ground.maxHeight);
    return {ground,
            x,
            y,
            view.originZ,
            baseI,
            baseJ,
            F(static_cast<float>(x - baseI)),
            F(static_cast<float>(y - baseJ)),
            F(height),
            F(static_cast<float>(view.originZ - height)),
            F(largest * 0x1p-21f),
            I(ground.width - 2),
            I(ground.height - 2),
            view.nearDepth};
}

STEREONAV_INLINE Eye makeEye(const GroundData& ground, const CasterView& view) {
    return makeEyeAt(ground, view, view.originX, view.originY);
}

STEREONAV_INLINE F infinity() {
    return F(__builtin_inff());
}

// A direction component that may be divided by: its size is kept above 1e-18.
STEREONAV_INLINE F divisible(F d) {
    return select(abs(d) < F(1e-18f), select(d < F(0.0f), F(-1e-18f), F(1e-18f)), d);
}

struct Walk {
    Rays rays;
    F inverseX, inverseY;
    M eastward, northward, downward;
    F t;
    F floor;  // no hit lies before: the near distance, or where the ray came to this ground
    I i, j, level;
    M active;
    M risen;  // above all ground and rising: free for good
    F over;   // height of the eye over the highest sample, metres, and the margin
};

// Parameters at which the ray leaves the block of 2^level cells around (i, j), and the block's border.
struct BlockExit {
    I borderI, borderJ;
    F tx, ty, t;
};

STEREONAV_INLINE BlockExit blockExit(const Eye& eye, const Walk& w, I blockI, I blockJ, I level) {
    BlockExit e;
    e.borderI = shiftLeft(blockI + select(w.eastward, I(1), I(0)), level);
    e.borderJ = shiftLeft(blockJ + select(w.northward, I(1), I(0)), level);
    e.tx = (toFloat(e.borderI - I(eye.baseI)) - eye.relativeX) * w.inverseX;
    e.ty = (toFloat(e.borderJ - I(eye.baseJ)) - eye.relativeY) * w.inverseY;
    e.t = max(min(e.tx, e.ty), w.t);
    return e;
}

// Moves the lanes `move` to the cell behind the block's border.
STEREONAV_INLINE void leaveBlock(const Eye& eye, Walk& w, const BlockExit& e, I blockI, I blockJ, I level,
                                 M move) {
    const I last = shiftLeft(I(1), level) - I(1);
    const I firstI = shiftLeft(blockI, level), firstJ = shiftLeft(blockJ, level);
    const I alongI =
        clamp(floorToInt(mulAdd(e.t, w.rays.x, eye.relativeX)) + I(eye.baseI), firstI, firstI + last);
    const I alongJ =
        clamp(floorToInt(mulAdd(e.t, w.rays.y, eye.relativeY)) + I(eye.baseJ), firstJ, firstJ + last);
    const I overI = e.borderI - select(w.eastward, I(0), I(1));
    const I overJ = e.borderJ - select(w.northward, I(0), I(1));
    const M crossX = e.tx < e.ty;
    w.i = select(move, select(crossX, overI, alongI), w.i);
    w.j = select(move, select(crossX, alongJ, overJ), w.j);
    w.t = select(move, e.t, w.t);
    const I outside = w.i | w.j | (eye.lastI - w.i) | (eye.lastJ - w.j);
    w.active = andNot(w.active, outside < I(0));
}

// Pyramid level to begin with for a ray about which nothing is known.
constexpr int kColdLevel = 3;

// The same for single cells: nothing to round, the other index stays.
STEREONAV_INLINE BlockExit cellExit(const Eye& eye, const Walk& w) {
    BlockExit e;
    e.borderI = w.i + select(w.eastward, I(1), I(0));
    e.borderJ = w.j + select(w.northward, I(1), I(0));
    e.tx = (toFloat(e.borderI - I(eye.baseI)) - eye.relativeX) * w.inverseX;
    e.ty = (toFloat(e.borderJ - I(eye.baseJ)) - eye.relativeY) * w.inverseY;
    e.t = max(min(e.tx, e.ty), w.t);
    return e;
}

STEREONAV_INLINE void leaveCell(const Eye& eye, Walk& w, const BlockExit& e, M move) {
    const M crossX = e.tx < e.ty;
    w.i = select(move & crossX, e.borderI + e.borderI - w.i - I(1), w.i);
    w.j = select(andNot(move, crossX), e.borderJ + e.borderJ - w.j - I(1), w.j);
    w.t = select(move, e.t, w.t);
    const I outside = w.i | w.j | (eye.lastI - w.i) | (eye.lastJ - w.j);
    w.active = andNot(w.active, outside < I(0));
}

struct CellHit {
    M hit, unsure;
    F t, approach, curvature;
    F h00, h10, h01, h11;
};

// The first meeting with the surface of cell (i, j) at or behind w.t, for lanes m. The height over
// ground is c + b s + a s^2 with s = t - w.t. `unsure`: already below at entry, so that a corner of
// another cell was passed over, or the eye is below ground.
STEREONAV_INLINE CellHit hitCell(const Eye& eye, const Walk& w, const BlockExit& e, M m) {
    CellHit c;
    const I index = w.j * I(eye.ground.width) + w.i;
    const FPair south = gatherPair(eye.ground.heights, index, m);
    const FPair north = gatherPair(eye.ground.heights + eye.ground.width, index, m);
    c.h00 = south.first, c.h10 = south.second, c.h01 = north.first, c.h11 = north.second;
    const F du = c.h10 - c.h00, dv = c.h01 - c.h00, twist = (c.h11 - c.h01) - du;
    const F u = mulAdd(w.t, w.rays.x, eye.relativeX - toFloat(w.i - I(eye.baseI)));
    const F v = mulAdd(w.t, w.rays.y, eye.relativeY - toFloat(w.j - I(eye.baseJ)));
    const F slopeU = mulAdd(v, twist, du), slopeV = mulAdd(u, twist, dv);
    F height = mulAdd(w.t, w.rays.z, (eye.height - c.h00) + eye.rest);
    height = height - mulAdd(u, slopeU, v * dv);
    const F b = w.rays.z - mulAdd(w.rays.x, slopeU, w.rays.y * slopeV);
    const F a = F(0.0f) - w.rays.x * w.rays.y * twist;
    c.unsure = m & (height < F(0.0f) - eye.margin - eye.margin);
    height = max(height, F(0.0f));
    const F discriminant = mulAdd(b, b, F(-4.0f) * a * height);
    const F root = discriminant * approxRsqrt(max(discriminant, F(1e-30f)));
    const M rising = b > F(0.0f);
    const F s =
        select(rising, b + root, height + height) * approxReciprocal(select(rising, F(-2.0f) * a, root - b));
    // The cell's far border is rounded too: a little more is let in, and settled in double precision.
    const F length = mulAdd(e.t, F(0x1p-21f), e.t - w.t);
    c.hit = andNot(m, c.unsure) & (discriminant >= F(0.0f)) & (s >= F(0.0f)) & (s <= length);
    c.t = w.t + s;
    c.curvature = a;
    c.approach = mulAdd(a + a, s, b);
    return c;
}

// One Newton step from the single-precision hit, with the height over ground taken in double precision.
// Lanes whose hit is not settled by it, or lies outside the cell, are returned.
STEREONAV_INLINE M refine(const Eye& eye, const Walk& w, const CellHit& c, M m, Hits& hits) {
    const D t = toDouble(c.t);
    const D u = (D(eye.x) - toDouble(w.i)) + t * w.rays.exactX;
    const D v = (D(eye.y) - toDouble(w.j)) + t * w.rays.exactY;
    const D h00 = toDouble(c.h00);
    const D du = toDouble(c.h10) - h00, dv = toDouble(c.h01) - h00;
    const D twist = (toDouble(c.h11) - toDouble(c.h01)) - du;
    const F height = toFloat(((D(eye.z) - h00) + t * w.rays.exactZ) - (u * (du + v * twist) + v * dv));
    const F step = F(0.0f) - height * approxReciprocal(c.approach);
    const F settledU = mulAdd(step, w.rays.x, toFloat(u)), settledV = mulAdd(step, w.rays.y, toFloat(v));
    const M inside =
        (settledU > F(0.0f)) & (settledU < F(1.0f)) & (settledV > F(0.0f)) & (settledV < F(1.0f));
    const F remaining = abs(c.curvature * step * step);
    const M settled = remaining <= F(1e-7f) * abs(c.approach) * c.t;
    const M good = m & inside & settled;
    hits.t = select(good, c.t + step, hits.t);
    hits.i = select(good, w.i, hits.i);
    hits.j = select(good, w.j, hits.j);
    hits.u = select(good, settledU, hits.u);
    hits.v = select(good, settledV, hits.v);
    hits.approach = select(good, c.approach, hits.approach);
    return andNot(m, good);
}

// Rate of height over ground along a ray at a point of a cell, metres for a unit of t.
STEREONAV_INLINE float cellApproach(const GroundData& g, const int* cell, const double* position,
                                    const double* direction) {
    const float* south = g.heights + static_cast<std::int64_t>(cell[1]) * g.width + cell[0];
    const float* north = south + g.width;
    const double du = double(south[1]) - south[0], dv = double(north[0]) - south[0];
    const double twist = (double(north[1]) - north[0]) - du;
    return static_cast<float>(direction[2] - direction[0] * (du + position[1] * twist) -
                              direction[1] * (dv + position[0] * twist));
}

// Whether a ray is below ground at t, and where in the ground; not in a hole.
inline bool belowGround(const GroundData& g, const double* origin, const double* direction, double t,
                        int* cell, double* position) {
    const double x = origin[0] + t * direction[0], y = origin[1] + t * direction[1];
    cell[0] = clampInt(x, 0, g.width - 2), cell[1] = clampInt(y, 0, g.height - 2);
    const double u = x - cell[0], v = y - cell[1];
    position[0] = u < 0 ? 0 : u > 1 ? 1 : u, position[1] = v < 0 ? 0 : v > 1 ? 1 : v;
    const float* south = g.heights + static_cast<std::int64_t>(cell[1]) * g.width + cell[0];
    const float* north = south + g.width;
    const double low = south[0] + position[0] * (double(south[1]) - south[0]),
                 high = north[0] + position[0] * (double(north[1]) - north[0]);
    return origin[2] + t * direction[2] < low + position[1] * (high - low);
}

// The plain walk in double precision, lane by lane, from a little before `from` (the float walk has
// cleared what lies before, up to corners of cells), but not before `floor`. A ray that came to this ground
// there, and is below it by no more than single precision tells, has met it there.
inline void castExactly(const Eye& eye, const Rays& rays, F from, F floor, M m, Hits& hits) {
    alignas(64) float t[kLanes], u[kLanes], v[kLanes], approach[kLanes], start[kLanes], least[kLanes];
    alignas(64) std::int32_t i[kLanes], j[kLanes];
    alignas(64) double x[kLanes], y[kLanes], z[kLanes];
    store(t, hits.t), store(u, hits.u), store(v, hits.v), store(approach, hits.approach), store(start, from);
    store(least, floor);
    store(i, hits.i), store(j, hits.j);
    __builtin_memcpy(x, &rays.exactX, sizeof x);
    __builtin_memcpy(y, &rays.exactY, sizeof y);
    __builtin_memcpy(z, &rays.exactZ, sizeof z);
    const GroundData& g = eye.ground;
    for (std::uint32_t left = bits(m); left != 0; left &= left - 1) {
        const int k = __builtin_ctz(left);
        const double fastest = __builtin_fmax(__builtin_fabs(x[k]), __builtin_fabs(y[k]));
        const double back = 2.0 / (fastest > 1e-12 ? fastest : 1e-12);
        const double origin[3] = {eye.x, eye.y, eye.z}, direction[3] = {x[k], y[k], z[k]};
        const double tMin = __builtin_fmax(start[k] - back, static_cast<double>(least[k]));
        int cell[2] = {};
        double position[2] = {};
        const bool entered = least[k] > eye.nearDepth && tMin == static_cast<double>(least[k]);
        t[k] = entered && belowGround(g, origin, direction, tMin, cell, position)
                   ? least[k]
                   : static_cast<float>(g.exactHit(g.context, origin, direction, tMin, cell, position));
        i[k] = cell[0], j[k] = cell[1];
        u[k] = static_cast<float>(position[0]), v[k] = static_cast<float>(position[1]);
        if (t[k] < __builtin_inff()) approach[k] = cellApproach(g, cell, position, direction);
    }
    hits = {loadF(t), loadI(i), loadI(j), loadF(u), loadF(v), loadF(approach), hits.free};
}

STEREONAV_INLINE Walk startWalk(const Eye& eye, const Rays& rays, F start, I level, M lanes) {
    Walk w;
    w.floor = F(eye.nearDepth);
    w.rays = rays;
    w.inverseX = approxReciprocal(divisible(rays.x));
    w.inverseY = approxReciprocal(divisible(rays.y));
    // By the sign of what is divided by: a direction of exactly 0 has the positive one.
    w.eastward = w.inverseX > F(0.0f);
    w.northward = w.inverseY > F(0.0f);
    w.downward = rays.z < F(0.0f);
    const F west = (toFloat(I(-eye.baseI)) - eye.relativeX) * w.inverseX;
    const F east = (toFloat(eye.lastI + I(1 - eye.baseI)) - eye.relativeX) * w.inverseX;
    const F south = (toFloat(I(-eye.baseJ)) - eye.relativeY) * w.inverseY;
    const F north = (toFloat(eye.lastJ + I(1 - eye.baseJ)) - eye.relativeY) * w.inverseY;
    F t = max(start, max(min(west, east), min(south, north)));
    t = max(t, F(eye.nearDepth));
    const F end = min(max(west, east), max(south, north));
    // Above all ground: a falling ray starts where it comes down to the highest sample.
    w.over = (eye.height - F(eye.ground.maxHeight)) + (eye.rest - eye.margin);
    const F down = F(0.999999f) * w.over / max(F(0.0f) - rays.z, F(1e-30f));
    t = select(w.downward & (w.over > F(0.0f)), max(t, down), t);
    w.risen = andNot(mulAdd(min(t, F(1e30f)), rays.z, w.over) > F(0.0f), w.downward);
    w.active = andNot(lanes & (t <= end) & (t < infinity()), w.risen);
    w.t = t;
    t = select(w.active, t, F(0.0f));
    w.i = clamp(floorToInt(mulAdd(t, rays.x, eye.relativeX)) + I(eye.baseI), I(0), eye.lastI);
    w.j = clamp(floorToInt(mulAdd(t, rays.y, eye.relativeY)) + I(eye.baseJ), I(0), eye.lastJ);
    w.level = level;
    return w;
}

// Leaps with the lanes `move` until all (patient) or most have left the ground or stand in a cell they may
// hit: the latter are returned. Waiting for the last leaves the others idle where lanes differ much.
template <bool patient>
STEREONAV_INLINE M leap(const Eye& eye, Walk& w, M move) {
    const I top(eye.ground.levels - 1);
    M parked = maskFromBits(0);
    while (any(move)) {
        const I blockI = shiftRight(w.i, w.level), blockJ = shiftRight(w.j, w.level);
        const I index = lookup16(eye.ground.maximaOffset, w.level) +
                        blockJ * lookup16(eye.ground.maximaPitch, w.level) + blockI;
        const F highest = gather(eye.ground.maxima, index, move, F(0.0f));
        const BlockExit e = blockExit(eye, w, blockI, blockJ, w.level);
        const F lowestAt = select(w.downward, e.t, w.t);
        const M near = move & (mulAdd(lowestAt, w.rays.z, eye.rest - eye.margin) <= highest - eye.height);
        const M arrived = near & (w.level == I(0));
        parked = parked | arrived;
        const M over = andNot(move, near);
        leaveBlock(eye, w, e, blockI, blockJ, w.level, over);
        // Down where the block may be hit; up where a border of the block above was crossed.
        const I crossed = select(e.tx < e.ty, blockI + select(w.eastward, I(1), I(0)),
                                 blockJ + select(w.northward, I(1), I(0)));
        const I up = (crossed & I(1)) ^ I(1);
        w.level = clamp(w.level + select(near, I(-1), up), I(0), top);
        const M risen = andNot(over & (mulAdd(w.t, w.rays.z, w.over) > F(0.0f)), w.downward);
        w.risen = w.risen | risen;
        w.active = andNot(w.active, risen);
        move = andNot(move, arrived) & w.active;
        if (!patient && __builtin_popcount(bits(parked)) > __builtin_popcount(bits(move))) break;
    }
    return parked;
}

// What is kept of a packet's hits until all its lanes are done.
STEREONAV_INLINE void keep(CellHit& found, const CellHit& c) {
    found.t = select(c.hit, c.t, found.t);
    found.approach = select(c.hit, c.approach, found.approach);
    found.curvature = select(c.hit, c.curvature, found.curvature);
    found.h00 = select(c.hit, c.h00, found.h00);
    found.h10 = select(c.hit, c.h10, found.h10);
    found.h01 = select(c.hit, c.h01, found.h01);
    found.h11 = select(c.hit, c.h11, found.h11);
    found.hit = found.hit | c.hit;
    found.unsure = found.unsure | c.unsure;
}

// Tries the cells that the lanes `m` stand in, and moves on those that miss.
STEREONAV_INLINE void tryCells(const Eye& eye, Walk& w, M m, CellHit& found) {
    const BlockExit e = cellExit(eye, w);
    const CellHit c = hitCell(eye, w, e, m);
    keep(found, c);
    const M done = c.hit | c.unsure;
    w.active = andNot(w.active, done);
    leaveCell(eye, w, e, andNot(m, done));
}

// The last word on a packet's hits, once all its lanes are done.
STEREONAV_INLINE Hits settle(const Eye& eye, const Walk& w, const CellHit& found) {
    Hits hits;
    hits.t = infinity();
    hits.i = hits.j = I(0);
    hits.u = hits.v = F(0.0f);
    hits.approach = F(-1.0f);
    hits.free = F(0.0f);
    if (any(found.hit | found.unsure)) {
        const M doubtful = found.unsure | refine(eye, w, found, found.hit, hits);
        if (any(doubtful)) castExactly(eye, w.rays, w.t, w.floor, doubtful, hits);
    }
    // Hits end the free way, misses at the border of the ground (w.t).
    hits.free = select(hits.t < infinity(), hits.t, select(w.risen, infinity(), w.t));
    hits.free = select(found.unsure, F(0.0f), hits.free);
    return hits;
}

// The rest of a walk that was started.
STEREONAV_INLINE Hits walkOn(const Eye& eye, Walk w) {
    const I level = w.level;
    CellHit found;
    found.hit = found.unsure = maskFromBits(0);
    found.t = infinity();
    found.approach = F(-1.0f);
    found.curvature = found.h00 = found.h10 = found.h01 = found.h11 = F(0.0f);
    if (any(w.active & (level == I(0)))) {
        tryCells(eye, w, w.active & (level == I(0)), found);
        if (any(w.active)) tryCells(eye, w, w.active & (level == I(0)), found);
    }
    while (any(w.active)) {
        const M parked = leap<false>(eye, w, w.active);
        if (any(parked)) tryCells(eye, w, parked, found);
    }
    return settle(eye, w, found);
}

// First hits of the rays `lanes` at or behind `start` (and the near distance). level: pyramid level to
// begin with; 0 where the hit is thought to be close: then two cells are tried outright, which is all
// that most rays need.
STEREONAV_INLINE Hits castPacket(const Eye& eye, const Rays& rays, F start, I level, M lanes) {
    return walkOn(eye, startWalk(eye, rays, start, level, lanes));
}

}  // namespace stereonav::STEREONAV_ISA
