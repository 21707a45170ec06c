// Casts a packet of rays at the heightfield: leaps over the pyramid of maxima, then finds the exact hit of
// the bilinear surface in a cell. Single precision finds the cell, conservatively; double precision decides
// where in it the hit lies. Included by kernels only.
#pragma once

#include "engine/simd/simd.h"
#include "terrain/cast/caster_types.h"
#include "terrain/cast/kernel_walk.h"

namespace stereonav::STEREONAV_ISA {

// View depths in metres at which the ray leaves the block of 2^level cells around (i, j), and the block's
// border.
struct BlockExit {
    I borderI, borderJ;
    F tx, ty, t;
};

// Returns where the walks leave their blocks (blockI, blockJ) of the level.
template <bool kBent>
STEREONAV_INLINE BlockExit blockExit(const Eye<kBent>& eye, const Walk<kBent>& w, I blockI, I blockJ,
                                     I level) {
    BlockExit e;
    e.borderI = shiftLeft(blockI + select(w.eastward, I(1), I(0)), level);
    e.borderJ = shiftLeft(blockJ + select(w.northward, I(1), I(0)), level);
    e.tx = (toFloat(e.borderI - I(eye.baseI)) - eye.relativeX) * w.inverseX;
    e.ty = (toFloat(e.borderJ - I(eye.baseJ)) - eye.relativeY) * w.inverseY;
    e.t = max(min(e.tx, e.ty), w.t);
    return e;
}

// Moves the lanes `move` to the cell behind the block's border.
template <bool kBent>
STEREONAV_INLINE void leaveBlock(const Eye<kBent>& eye, Walk<kBent>& w, const BlockExit& e, I blockI,
                                 I blockJ, I level, M move) {
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

// Pyramid level to begin with for a ray without a known start.
constexpr int kColdLevel = 3;

// Returns where the walks leave their cells.
template <bool kBent>
STEREONAV_INLINE BlockExit cellExit(const Eye<kBent>& eye, const Walk<kBent>& w) {
    BlockExit e;
    e.borderI = w.i + select(w.eastward, I(1), I(0));
    e.borderJ = w.j + select(w.northward, I(1), I(0));
    e.tx = (toFloat(e.borderI - I(eye.baseI)) - eye.relativeX) * w.inverseX;
    e.ty = (toFloat(e.borderJ - I(eye.baseJ)) - eye.relativeY) * w.inverseY;
    e.t = max(min(e.tx, e.ty), w.t);
    return e;
}

// Moves the lanes `move` to the next cell. Exact: the other index stays the same.
template <bool kBent>
STEREONAV_INLINE void leaveCell(const Eye<kBent>& eye, Walk<kBent>& w, const BlockExit& e, M move) {
    const M crossX = e.tx < e.ty;
    w.i = select(move & crossX, e.borderI + e.borderI - w.i - I(1), w.i);
    w.j = select(andNot(move, crossX), e.borderJ + e.borderJ - w.j - I(1), w.j);
    w.t = select(move, e.t, w.t);
    const I outside = w.i | w.j | (eye.lastI - w.i) | (eye.lastJ - w.j);
    w.active = andNot(w.active, outside < I(0));
}

// Hits in cells: lanes, view depths in metres, Hits::approach, curvatureOf(), and heights of the corners.
struct CellHit {
    M hit, unsure;
    F t, approach, curvature;
    F h00, h10, h01, h11;
};

// Half the second derivative of the height over a cell's ground along a ray.
template <bool kBent>
STEREONAV_INLINE F curvatureOf(const Walk<kBent>& w, F twist) {
    if constexpr (kBent)
        return w.sink - w.rays.x * w.rays.y * twist;
    else
        return F(0.0f) - w.rays.x * w.rays.y * twist;
}

// Finds the first hit with the surface of cell (i, j) at or behind w.t, for lanes m. The height over ground
// is c + b s + a s^2 with s = t - w.t. unsure: set where the ray is already below ground at entry, so that it
// passed a corner of another cell, or the eye is below ground.
template <bool kBent>
STEREONAV_INLINE CellHit hitCell(const Eye<kBent>& eye, const Walk<kBent>& w, const BlockExit& e, M m) {
    CellHit c;
    const I index = w.j * I(eye.ground->width) + w.i;
    const FPair south = gatherPair(eye.ground->heights, index, m);
    const FPair north = gatherPair(eye.ground->heights + eye.ground->width, index, m);
    c.h00 = south.first, c.h10 = south.second, c.h01 = north.first, c.h11 = north.second;
    const F du = c.h10 - c.h00, dv = c.h01 - c.h00, twist = (c.h11 - c.h01) - du;
    const F u = mulAdd(w.t, w.rays.x, eye.relativeX - toFloat(w.i - I(eye.baseI)));
    const F v = mulAdd(w.t, w.rays.y, eye.relativeY - toFloat(w.j - I(eye.baseJ)));
    const F slopeU = mulAdd(v, twist, du), slopeV = mulAdd(u, twist, dv);
    F height = heightAt(w, w.t, (eye.height - c.h00) + eye.rest);
    height = height - mulAdd(u, slopeU, v * dv);
    const F b = riseAt(w, w.t) - mulAdd(w.rays.x, slopeU, w.rays.y * slopeV);
    const F a = curvatureOf(w, twist);
    c.unsure = m & (height < F(0.0f) - eye.margin - eye.margin);
    height = max(height, F(0.0f));
    const F discriminant = mulAdd(b, b, F(-4.0f) * a * height);
    const F root = discriminant * approxRsqrt(max(discriminant, F(1e-30f)));
    const M rising = b > F(0.0f);
    const F s =
        select(rising, b + root, height + height) * approxReciprocal(select(rising, F(-2.0f) * a, root - b));
    // The cell's far border is rounded too: hits a little beyond it are accepted, and decided in double
    // precision.
    const F length = mulAdd(e.t, F(0x1p-21f), e.t - w.t);
    c.hit = andNot(m, c.unsure) & (discriminant >= F(0.0f)) & (s >= F(0.0f)) & (s <= length);
    c.t = w.t + s;
    c.curvature = a;
    c.approach = mulAdd(a + a, s, b);
    return c;
}

// Makes one Newton step from the single-precision hit, with the height over ground in double precision.
// Returns the lanes whose hit that does not decide, or lies outside the cell.
template <bool kBent>
STEREONAV_INLINE M refine(const Eye<kBent>& eye, const Walk<kBent>& w, const CellHit& c, M m, Hits& hits) {
    const D t = toDouble(c.t);
    const D u = (D(eye.x) - toDouble(w.i)) + t * w.rays.exactX;
    const D v = (D(eye.y) - toDouble(w.j)) + t * w.rays.exactY;
    const D h00 = toDouble(c.h00);
    const D du = toDouble(c.h10) - h00, dv = toDouble(c.h01) - h00;
    const D twist = (toDouble(c.h11) - toDouble(c.h01)) - du;
    D slope = w.rays.exactZ;
    if constexpr (kBent)
        slope = slope + t * (D(eye.bend.bendX) * w.rays.exactX * w.rays.exactX +
                             D(eye.bend.bendY) * w.rays.exactY * w.rays.exactY);
    const F height = toFloat(((D(eye.z) - h00) + t * slope) - (u * (du + v * twist) + v * dv));
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

// Returns the rate of height over ground along a ray at a point of a cell, in metres per unit of t. rise:
// rate of the ray's own height.
STEREONAV_INLINE float cellApproach(const GroundData& g, const int* cell, const double* position,
                                    const double* direction, double rise) {
    const float* south = g.heights + static_cast<std::int64_t>(cell[1]) * g.width + cell[0];
    const float* north = south + g.width;
    const double du = double(south[1]) - south[0], dv = double(north[0]) - south[0];
    const double twist = (double(north[1]) - north[0]) - du;
    return static_cast<float>(rise - direction[0] * (du + position[1] * twist) -
                              direction[1] * (dv + position[0] * twist));
}

// Returns whether a ray is below ground at t, and the position on the ground; false in a hole. slope: mean
// rise of the ray from its origin to there, in metres per unit of t.
inline bool belowGround(const GroundData& g, const double* origin, const double* direction, double slope,
                        double t, int* cell, double* position) {
    const double x = origin[0] + t * direction[0], y = origin[1] + t * direction[1];
    cell[0] = clampInt(x, 0, g.width - 2), cell[1] = clampInt(y, 0, g.height - 2);
    const double u = x - cell[0], v = y - cell[1];
    position[0] = u < 0 ? 0 : u > 1 ? 1 : u, position[1] = v < 0 ? 0 : v > 1 ? 1 : v;
    const float* south = g.heights + static_cast<std::int64_t>(cell[1]) * g.width + cell[0];
    const float* north = south + g.width;
    const double low = south[0] + position[0] * (double(south[1]) - south[0]),
                 high = north[0] + position[0] * (double(north[1]) - north[0]);
    return origin[2] + t * slope < low + position[1] * (high - low);
}

// The plain walk in double precision, lane by lane, from a little before `from` (the float walk has cleared
// the way before, except for corners of cells), but not before `floor`. A ray that came from a finer ground
// at `floor`, and is below this one by no more than single precision resolves, has hit it there.
template <bool kBent>
inline void castExactly(const Eye<kBent>& eye, const Rays& rays, F from, F floor, M m, Hits& hits) {
    alignas(64) float t[kLanes], u[kLanes], v[kLanes], approach[kLanes], start[kLanes], least[kLanes];
    alignas(64) std::int32_t i[kLanes], j[kLanes];
    alignas(64) double x[kLanes], y[kLanes], z[kLanes];
    store(t, hits.t), store(u, hits.u), store(v, hits.v), store(approach, hits.approach), store(start, from);
    store(least, floor);
    store(i, hits.i), store(j, hits.j);
    __builtin_memcpy(x, &rays.exactX, sizeof x);
    __builtin_memcpy(y, &rays.exactY, sizeof y);
    __builtin_memcpy(z, &rays.exactZ, sizeof z);
    const GroundData& g = *eye.ground;
    for (std::uint32_t left = bits(m); left != 0; left &= left - 1) {
        const int k = __builtin_ctz(left);
        const double fastest = __builtin_fmax(__builtin_fabs(x[k]), __builtin_fabs(y[k]));
        const double back = 2.0 / (fastest > 1e-12 ? fastest : 1e-12);
        const double origin[3] = {eye.x, eye.y, eye.z}, direction[3] = {x[k], y[k], z[k]};
        const double tMin = __builtin_fmax(start[k] - back, static_cast<double>(least[k]));
        int cell[2] = {};
        double position[2] = {}, fall = 0, sink = 0;
        if constexpr (kBent) {
            fall = eye.bend.bendX / (g.spacingX * g.spacingX);
            sink = eye.bend.bendX * x[k] * x[k] + eye.bend.bendY * y[k] * y[k];
        }
        const bool entered = least[k] > eye.nearDepth && tMin == static_cast<double>(least[k]);
        t[k] = entered && belowGround(g, origin, direction, z[k] + tMin * sink, tMin, cell, position)
                   ? least[k]
                   : static_cast<float>(g.exactHit(g.context, origin, direction, fall, tMin, cell, position));
        i[k] = cell[0], j[k] = cell[1];
        u[k] = static_cast<float>(position[0]), v[k] = static_cast<float>(position[1]);
        if (t[k] < __builtin_inff())
            approach[k] =
                cellApproach(g, cell, position, direction, z[k] + 2 * static_cast<double>(t[k]) * sink);
    }
    hits = {loadF(t), loadI(i), loadI(j), loadF(u), loadF(v), loadF(approach), hits.free};
}

// Discriminant of over + t z + t^2 sink, the height of a bent ray over the highest sample. Near 0 the ray is
// level where it comes closest, and errors by rounding are within the margin.
struct Discriminant {
    F value, slack;
};
STEREONAV_INLINE Discriminant discriminantOf(const Walk<true>& w) {
    const F square = w.rays.z * w.rays.z;
    return {mulAdd(F(-4.0f) * w.sink, w.over, square), F(0x1p-20f) * square};
}

// Returns falling rays from above all ground that bend up before they reach the highest sample.
STEREONAV_INLINE M staysAbove(const Walk<true>& w) {
    const Discriminant d = discriminantOf(w);
    return (w.over > F(0.0f)) & (d.value < F(0.0f) - d.slack);
}

// Returns the view depth in metres, or a little less, at which falling rays come down to the height of the
// highest sample.
template <bool kBent>
STEREONAV_INLINE F comesDown(const Walk<kBent>& w) {
    if constexpr (kBent) {
        const Discriminant d = discriminantOf(w);
        const F root = sqrt(max(d.value, F(0.0f)) + d.slack);
        return F(0.999999f) * (w.over + w.over) / max(root - w.rays.z, F(1e-30f));
    } else {
        return F(0.999999f) * w.over / max(F(0.0f) - w.rays.z, F(1e-30f));
    }
}

// Begins walks at view depth `start`, in metres, or where rays reach this ground, if that is farther. level:
// of the pyramid.
template <bool kBent>
STEREONAV_INLINE Walk<kBent> startWalk(const Eye<kBent>& eye, const Rays& rays, F start, I level, M lanes) {
    Walk<kBent> w;
    w.floor = F(eye.nearDepth);
    w.rays = rays;
    w.inverseX = approxReciprocal(divisible(rays.x));
    w.inverseY = approxReciprocal(divisible(rays.y));
    // The sign is that of the divisor: a direction of exactly 0 counts as positive.
    w.eastward = w.inverseX > F(0.0f);
    w.northward = w.inverseY > F(0.0f);
    if constexpr (kBent)
        w.sink = mulAdd(F(static_cast<float>(eye.bend.bendX)) * rays.x, rays.x,
                        F(static_cast<float>(eye.bend.bendY)) * rays.y * rays.y);
    takeSlope(w, rays.z);
    const F west = (toFloat(I(-eye.baseI)) - eye.relativeX) * w.inverseX;
    const F east = (toFloat(eye.lastI + I(1 - eye.baseI)) - eye.relativeX) * w.inverseX;
    const F south = (toFloat(I(-eye.baseJ)) - eye.relativeY) * w.inverseY;
    const F north = (toFloat(eye.lastJ + I(1 - eye.baseJ)) - eye.relativeY) * w.inverseY;
    F t = max(start, max(min(west, east), min(south, north)));
    t = max(t, F(eye.nearDepth));
    const F end = min(max(west, east), max(south, north));
    // From above all ground a falling ray starts where it comes down to the highest sample.
    w.over = (eye.height - F(eye.ground->maxHeight)) + (eye.rest - eye.margin);
    t = select(w.downward & (w.over > F(0.0f)), max(t, comesDown(w)), t);
    w.risen = hasRisenAt(w, min(t, F(kBent ? 1e12f : 1e30f)));
    if constexpr (kBent) w.risen = w.risen | (w.downward & staysAbove(w));
    w.active = andNot(lanes & (t <= end) & (t < infinity()), w.risen);
    w.t = t;
    t = select(w.active, t, F(0.0f));
    w.i = clamp(floorToInt(mulAdd(t, rays.x, eye.relativeX)) + I(eye.baseI), I(0), eye.lastI);
    w.j = clamp(floorToInt(mulAdd(t, rays.y, eye.relativeY)) + I(eye.baseJ), I(0), eye.lastJ);
    w.level = level;
    return w;
}

// Leaps with the lanes `move` until all (patient) or most of them have left the ground or stand in a cell
// that they may hit; returns the latter. Waiting for the last lane leaves others idle where lanes differ
// much.
template <bool patient, bool kBent>
STEREONAV_INLINE M leap(const Eye<kBent>& eye, Walk<kBent>& w, M move) {
    const I top(eye.ground->levels - 1);
    M parked = maskFromBits(0);
    while (any(move)) {
        const I blockI = shiftRight(w.i, w.level), blockJ = shiftRight(w.j, w.level);
        const I index = lookup16(eye.ground->maximaOffset, w.level) +
                        blockJ * lookup16(eye.ground->maximaPitch, w.level) + blockI;
        const F highest = gather(eye.ground->maxima, index, move, F(0.0f));
        const BlockExit e = blockExit(eye, w, blockI, blockJ, w.level);
        const F lowestAt = lowestUntil(w, e.t);
        const M near = move & (heightAt(w, lowestAt, eye.rest - eye.margin) <= highest - eye.height);
        const M arrived = near & (w.level == I(0));
        parked = parked | arrived;
        const M over = andNot(move, near);
        leaveBlock(eye, w, e, blockI, blockJ, w.level, over);
        // Goes down a level where the block may be hit, and up where a border of the block above was crossed.
        const I crossed = select(e.tx < e.ty, blockI + select(w.eastward, I(1), I(0)),
                                 blockJ + select(w.northward, I(1), I(0)));
        const I up = (crossed & I(1)) ^ I(1);
        w.level = clamp(w.level + select(near, I(-1), up), I(0), top);
        const M risen = over & hasRisenAt(w, w.t);
        w.risen = w.risen | risen;
        w.active = andNot(w.active, risen);
        move = andNot(move, arrived) & w.active;
        if (!patient && __builtin_popcount(bits(parked)) > __builtin_popcount(bits(move))) break;
    }
    return parked;
}

// Stores hits `c` until all lanes of the packet are done.
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

// Tests the cells in which the lanes `m` stand, and moves on those that miss.
template <bool kBent>
STEREONAV_INLINE void tryCells(const Eye<kBent>& eye, Walk<kBent>& w, M m, CellHit& found) {
    const BlockExit e = cellExit(eye, w);
    const CellHit c = hitCell(eye, w, e, m);
    keep(found, c);
    const M done = c.hit | c.unsure;
    w.active = andNot(w.active, done);
    leaveCell(eye, w, e, andNot(m, done));
}

// Returns hits for rays that meet nothing.
STEREONAV_INLINE Hits noHits() {
    Hits hits;
    hits.t = infinity();
    hits.i = hits.j = I(0);
    hits.u = hits.v = F(0.0f);
    hits.approach = F(-1.0f);
    hits.free = F(0.0f);
    return hits;
}

// Decides a packet's hits in double precision, once all its lanes are done.
template <bool kBent>
STEREONAV_INLINE Hits settle(const Eye<kBent>& eye, const Walk<kBent>& w, const CellHit& found) {
    Hits hits = noHits();
    if (any(found.hit | found.unsure)) {
        const M doubtful = found.unsure | refine(eye, w, found, found.hit, hits);
        if (any(doubtful)) castExactly(eye, w.rays, w.t, w.floor, doubtful, hits);
    }
    // The free way ends at hits, and for misses at the border of the ground (w.t).
    hits.free = select(hits.t < infinity(), hits.t, select(w.risen, infinity(), w.t));
    hits.free = select(found.unsure, F(0.0f), hits.free);
    return hits;
}

// Walks to the end, after startWalk().
template <bool kBent>
STEREONAV_INLINE Hits walkOn(const Eye<kBent>& eye, Walk<kBent>& w) {
    const I level = w.level;
    CellHit found;
    found.hit = found.unsure = maskFromBits(0);
    found.t = infinity();
    found.approach = F(-1.0f);
    found.curvature = found.h00 = found.h10 = found.h01 = found.h11 = F(0.0f);
    // Cells tested without leaping: by all lanes, and while most of a packet do.
    constexpr int kSure = 2, kOutright = 5;
    for (int cells = 0; cells < kOutright; ++cells) {
        const M close = w.active & (level == I(0));
        if (!any(close) || (cells >= kSure && __builtin_popcount(bits(close)) < kLanes / 2)) break;
        tryCells(eye, w, close, found);
    }
    while (any(w.active)) {
        const M parked = leap<false>(eye, w, w.active);
        if (any(parked)) tryCells(eye, w, parked, found);
    }
    return settle(eye, w, found);
}

// Returns the first hits of the rays `lanes` at or behind view depth `start`, metres, and the near distance.
// level: pyramid level to begin with. 0 where the hit is expected to be close: then two cells are tested
// before leaping, which is enough for most rays, and some more while most of a packet need them.
template <bool kBent>
STEREONAV_INLINE Hits castPacket(const Eye<kBent>& eye, const Rays& rays, F start, I level, M lanes) {
    Walk<kBent> w = startWalk(eye, rays, start, level, lanes);
    return walkOn(eye, w);
}

}  // namespace stereonav::STEREONAV_ISA
