// The exact hit of rays with the trilinear isosurface in their cells (Parker et al. 1998; Y2 of
// docs/ledger.md): the value along a ray is a cubic, and the first place where it reaches the isovalue is
// looked for between its extrema. Included by kernels only.
#pragma once

#include "engine/volume/kernel_places.h"

namespace stereonav::STEREONAV_ISA {

// The cubic c0 + c1 s + c2 s^2 + c3 s^3.
struct Cubic {
    F c0, c1, c2, c3;
    STEREONAV_INLINE F at(F s) const { return mulAdd(mulAdd(mulAdd(c3, s, c2), s, c1), s, c0); }
    STEREONAV_INLINE F slope(F s) const { return mulAdd(mulAdd(F(3.0f) * c3, s, c2 + c2), s, c1); }
};

// Returns the value less the isovalue along start + s * way, s from 0 to 1.
STEREONAV_INLINE Cubic cubicAlong(const Corners& c, const V3& start, const V3& way) {
    F a[4], b[4];  // along the edges in x: a + b s
    for (int n = 0; n < 4; ++n) {
        const F slope = c.v[2 * n + 1] - c.v[2 * n];
        a[n] = mulAdd(slope, start.x, c.v[2 * n]);
        b[n] = slope * way.x;
    }
    F q0[2], q1[2], q2[2];
    for (int n = 0; n < 2; ++n) {
        const F da = a[2 * n + 1] - a[2 * n], db = b[2 * n + 1] - b[2 * n];
        q0[n] = mulAdd(da, start.y, a[2 * n]);
        q1[n] = mulAdd(db, start.y, mulAdd(da, way.y, b[2 * n]));
        q2[n] = db * way.y;
    }
    const F d0 = q0[1] - q0[0], d1 = q1[1] - q1[0], d2 = q2[1] - q2[0];
    return {mulAdd(d0, start.z, q0[0]), mulAdd(d1, start.z, mulAdd(d0, way.z, q1[0])),
            mulAdd(d2, start.z, mulAdd(d1, way.z, q2[0])), d2 * way.z};
}

constexpr float kCloseEnough = 1e-6f;  // share of the way through a cell
// After a step of Newton's as short as this the next would be of the order of its square.
constexpr float kQuadratic = 1e-4f;

// A root of a cubic, 0 to 1.
struct Root {
    F s;
    M found;
};

// Where a cubic turns: its local minimum and maximum, where they are.
struct Turns {
    F low, high;
    M bent;  // there are any
};
STEREONAV_INLINE Turns turnsOf(const Cubic& f) {
    const F zero(0.0f);
    const F discriminant = mulAdd(f.c2, f.c2, F(-3.0f) * f.c1 * f.c3);
    const F root = sqrt(max(discriminant, zero));
    const M falling = f.c2 < zero;
    // Both extrema without cancelling: one from the sum of equal signs, the other from their product.
    const F q = select(falling, root - f.c2, zero - f.c2 - root);
    const F first = q * approxReciprocal(F(3.0f) * f.c3), second = f.c1 * approxReciprocal(q);
    return {select(falling, first, second), select(falling, second, first), discriminant > zero};
}
// Returns whether the local maximum lies in (0, 1) and is >= 0.
STEREONAV_INLINE M topsOut(const Cubic& f, const Turns& turns) {
    const F zero(0.0f);
    return turns.bent & (turns.high > zero) & (turns.high < F(1.0f)) & (f.at(turns.high) >= zero);
}

// Returns whether firstRoot() finds a root.
STEREONAV_INLINE M hasRoot(const Cubic& f, M m) {
    const F zero(0.0f);
    return m & ((f.c0 >= zero) | (f.at(F(1.0f)) >= zero) | topsOut(f, turnsOf(f)));
}

// Returns the first s in [0, 1] where the cubic is >= 0. Between its local minimum and maximum a cubic rises,
// so one bracket holds the first root, in which Newton's steps are kept by bisection.
STEREONAV_INLINE Root firstRoot(const Cubic& f, M m) {
    const F zero(0.0f), one(1.0f);
    const M atOnce = m & (f.c0 >= zero);
    const Turns turns = turnsOf(f);
    const M hasLow = turns.bent & (turns.low > zero) & (turns.low < one);
    const M tops = topsOut(f, turns);
    F to = select(tops, turns.high, one);
    F from = select(hasLow & (turns.low < to), turns.low, zero);
    const M found = andNot(m, atOnce) & (tops | (f.at(one) >= zero));
    F s = zero;
    if (any(found)) {
        const F below = f.at(from), above = f.at(to);
        s = mulAdd((to - from) * below, approxReciprocal(min(below - above, F(-1e-30f))), from);
        M searching = found;
        for (int step = 0; step < 6; ++step) {
            const F value = f.at(s);
            const M under = value < zero;
            from = select(under, s, from);
            to = select(under, to, s);
            const F next = s - value * approxReciprocal(f.slope(s));
            const M kept = (next >= from) & (next <= to);
            const F better = select(kept, next, F(0.5f) * (from + to));
            const F move = abs(better - s);
            const M moves = searching & (move > select(kept, F(kQuadratic), F(kCloseEnough)));
            s = select(searching, better, s);
            searching = moves;  // a ray that is done stays as it is, whatever its neighbours need
            if (!any(searching)) break;
        }
    }
    return {select(atOnce, zero, s), atOnce | found};
}

// Where packets of rays meet the surface.
struct Hits {
    F t;       // view depth, metres; infinite where nothing is hit
    V3 local;  // place in the cell, 0..1
    I word;    // Places::word
    M hit;
};

// A ray's way through its cell.
struct Crossing {
    F in, out;      // view depths
    V3 start, way;  // coordinates in the cell, 0..1; way: from entering to leaving
};

// Returns a coordinate of the ray at t in its cell, 0..1.
STEREONAV_INLINE F inCell(F eye, F t, F direction, I cell) {
    return clamp(mulAdd(t, direction, eye) - toFloat(cell), F(0.0f), F(1.0f));
}

// Returns the way through the cells `at`, from view depth `nearest` on.
STEREONAV_INLINE Crossing crossingOf(const Grid& grid, const Rays& r, const Cells& at, F nearest) {
    const V3 far = farPlanes(r, at);
    Crossing c;
    c.in =
        max(max(far.x - abs(r.inverse.x), nearest), max(far.y - abs(r.inverse.y), far.z - abs(r.inverse.z)));
    c.out = max(c.in, min(far.x, min(far.y, far.z)));
    const F span = c.out - c.in;
    c.start = {inCell(grid.eyeX, c.in, r.direction.x, at.x), inCell(grid.eyeY, c.in, r.direction.y, at.y),
               inCell(grid.eyeZ, c.in, r.direction.z, at.z)};
    c.way = {span * r.direction.x, span * r.direction.y, span * r.direction.z};
    return c;
}

STEREONAV_INLINE Hits noHits() {
    const F zero(0.0f);
    return {F(__builtin_inff()), {zero, zero, zero}, I(0), maskFromBits(0)};
}

// Tries the cells in which rays stand and walks on those that meet nothing there. Rays end without a hit
// where they leave the volume, or the part of it that is known.
STEREONAV_INLINE void tryCells(const Grid& grid, const Rays& r, F nearest, const Parked& parked, Walk& w,
                               Hits& hits) {
    if (!any(parked.lanes)) return;
    const auto [word, known] = placesOf(grid.data, parked.index, parked.lanes);
    const Crossing c = crossingOf(grid, r, w.at, nearest);
    const Root root = firstRoot(cubicAlong(cornersOf(grid, word, w.at, known), c.start, c.way), known);
    hits.t = select(root.found, mulAdd(root.s, c.out - c.in, c.in), hits.t);
    hits.local = {select(root.found, mulAdd(root.s, c.way.x, c.start.x), hits.local.x),
                  select(root.found, mulAdd(root.s, c.way.y, c.start.y), hits.local.y),
                  select(root.found, mulAdd(root.s, c.way.z, c.start.z), hits.local.z)};
    hits.word = select(root.found, word, hits.word);
    hits.hit = hits.hit | root.found;
    const M further = andNot(known, root.found);
    w.active = andNot(w.active, andNot(parked.lanes, further));
    stepCell(r, w, further);
}

// Walks the active rays on to cells with surface and tries these.
STEREONAV_INLINE void advance(const Grid& grid, const Rays& r, F nearest, Walk& w, Hits& hits) {
    const Parked parked = leap(grid, r, w);
    tryCells(grid, r, nearest, parked, w, hits);
}

// Two packets at once: while one waits for memory the other goes on.
STEREONAV_INLINE void advancePair(const Grid& grid, const Rays (&r)[2], F nearest, Walk (&w)[2],
                                  Hits (&hits)[2]) {
    Leaper first(grid, r[0], w[0]), second(grid, r[1], w[1]);
    while (first.goesOn() && second.goesOn()) {
        first.step();
        second.step();
    }
    while (first.goesOn()) first.step();
    while (second.goesOn()) second.step();
    tryCells(grid, r[0], nearest, first.parked(), w[0], hits[0]);
    tryCells(grid, r[1], nearest, second.parked(), w[1], hits[1]);
}

}  // namespace stereonav::STEREONAV_ISA
