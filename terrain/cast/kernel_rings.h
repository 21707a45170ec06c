// Rays that leave a ground through its border and continue over the coarser ground around it
// (terrain/ground/ground_rings.h). Where the coarser ground lies higher at the border than the finer one, a
// ray hits the step between them. Included by kernels only.
#pragma once

#include "engine/simd/simd.h"
#include "terrain/cast/caster_types.h"
#include "terrain/cast/kernel_cast.h"
#include "terrain/cast/kernel_shade.h"

namespace stereonav::STEREONAV_ISA {

// Returns the same rays in grid units of a coarser ground: exact, since scales are powers of two.
STEREONAV_INLINE Rays scaled(Rays rays, double scale) {
    const D d(scale);
    const F f(static_cast<float>(scale));
    rays.exactX = rays.exactX * d, rays.exactY = rays.exactY * d;
    rays.x = rays.x * f, rays.y = rays.y * f;
    return rays;
}

// A ground of a scene, the eye over it, and the distances to its borders.
template <bool kBent>
struct Ring {
    const CasterScene* scene;
    double scale;                // its grid units per grid unit of the first ground: a power of two
    F west, east, south, north;  // grid units of the first ground
    Eye<kBent> eye;
};

// All grounds of a scene, the first one first, as seen by a view's eye. They are the same for all rays, so
// they are made once.
template <bool kBent>
class Rings {
public:
    STEREONAV_INLINE Rings(const CasterScene& first, const CasterView& view) {
        double x = view.originX, y = view.originY, scale = 1;
        for (const CasterScene* scene = &first;; scene = scene->beyond.scene) {
            mRings[mCount++] = ringAt(*scene, view, x, y, scale);
            const CoarserGround& beyond = scene->beyond;
            if (beyond.scene == nullptr) break;
            x = (x - beyond.originX) * beyond.scale;
            y = (y - beyond.originY) * beyond.scale;
            scale *= beyond.scale;
        }
    }

    int count() const { return mCount; }
    const Ring<kBent>& operator[](int n) const { return mRings[n]; }

private:
    static constexpr int kMost = 32;  // grids have fewer levels, and each ring has another level

    STEREONAV_INLINE static Ring<kBent> ringAt(const CasterScene& scene, const CasterView& view, double x,
                                               double y, double scale) {
        const Eye<kBent> eye = makeEyeAt<kBent>(scene.ground, view, x, y);
        const F units(static_cast<float>(1 / scale));
        return {&scene,
                scale,
                (toFloat(I(-eye.baseI)) - eye.relativeX) * units,
                (toFloat(eye.lastI + I(1 - eye.baseI)) - eye.relativeX) * units,
                (toFloat(I(-eye.baseJ)) - eye.relativeY) * units,
                (toFloat(eye.lastJ + I(1 - eye.baseJ)) - eye.relativeY) * units,
                eye};
    }

    int mCount = 0;
    Ring<kBent> mRings[kMost];
};

// 1 / direction: distances of the first ground's rays to borders are multiplied by it.
struct Inverses {
    F x, y;
};
STEREONAV_INLINE Inverses inversesOf(const Rays& rays) {
    return {approxReciprocal(divisible(rays.x)), approxReciprocal(divisible(rays.y))};
}

// Returns the view depth in metres at which rays leave the ring. Rays come from inside it, or from above its
// border.
template <bool kBent>
STEREONAV_INLINE F borderExit(const Ring<kBent>& ring, const Inverses& inverse) {
    return min(max(ring.west * inverse.x, ring.east * inverse.x),
               max(ring.south * inverse.y, ring.north * inverse.y));
}

// The position of a walk over its ground.
struct Standing {
    F height;    // over ground, metres
    F u, v;      // in the cell, 0 to 1
    F approach;  // Hits::approach
};

// Returns the positions of lanes m over this ground.
template <bool kBent>
STEREONAV_INLINE Standing standingAt(const Eye<kBent>& eye, const Walk<kBent>& w, M m) {
    Standing s;
    const I index = w.j * I(eye.ground->width) + w.i;
    const FPair south = gatherPair(eye.ground->heights, index, m);
    const FPair north = gatherPair(eye.ground->heights + eye.ground->width, index, m);
    const F du = south.second - south.first, dv = north.first - south.first;
    const F twist = (north.second - north.first) - du;
    s.u = clamp(mulAdd(w.t, w.rays.x, eye.relativeX - toFloat(w.i - I(eye.baseI))), F(0.0f), F(1.0f));
    s.v = clamp(mulAdd(w.t, w.rays.y, eye.relativeY - toFloat(w.j - I(eye.baseJ))), F(0.0f), F(1.0f));
    const F slopeU = mulAdd(s.v, twist, du), slopeV = mulAdd(s.u, twist, dv);
    s.height = heightAt(w, w.t, (eye.height - south.first) + eye.rest) - mulAdd(s.u, slopeU, s.v * dv);
    s.approach = riseAt(w, w.t) - mulAdd(w.rays.x, slopeU, w.rays.y * slopeV);
    return s;
}

// Returns the lanes that are below the ground by more than rounding can cause; false in a hole, where heights
// are NaN.
template <bool kBent>
STEREONAV_INLINE M sunk(const Eye<kBent>& eye, F height) {
    return height < F(0.0f) - eye.margin - eye.margin;
}

// View depth in metres, and cell, of a walk.
struct WalkPlace {
    F t;
    I i, j;
};

// Makes the positions of lanes m their hits.
STEREONAV_INLINE void meetAt(const WalkPlace& w, const Standing& s, M m, Hits& hits) {
    hits.t = select(m, w.t, hits.t);
    hits.i = select(m, w.i, hits.i);
    hits.j = select(m, w.j, hits.j);
    hits.u = select(m, s.u, hits.u);
    hits.v = select(m, s.v, hits.v);
    hits.approach = select(m, s.approach, hits.approach);
    hits.free = select(m, w.t, hits.free);
}

// Returns the first hits of rays that come from the finer ground at `border`; start: castPacket()'s.
template <bool kBent>
STEREONAV_INLINE Hits castEntering(const Eye<kBent>& eye, const Rays& rays, F border, F start, M lanes) {
    const M entering = start <= border;
    const I cold(kColdLevel < eye.ground->levels ? kColdLevel : 0);
    Walk<kBent> w = startWalk(eye, rays, max(start, border), select(entering, cold, I(0)), lanes);
    w.floor = border;
    const M atBorder = w.active & entering & (w.t <= border);
    if (!any(atBorder)) return walkOn(eye, w);
    const Standing standing = standingAt(eye, w, atBorder);
    const M below = atBorder & sunk(eye, standing.height);
    const WalkPlace entry{w.t, w.i, w.j};
    w.active = andNot(w.active, below);
    Hits hits = walkOn(eye, w);
    meetAt(entry, standing, below, hits);
    return hits;
}

// Casts the rays `lanes`, which did not hit the first ground, beyond it: finds their hits, and returns the
// colour of those or of the sky. rays: of the first ground; start: as for castPacket().
template <bool kBent>
inline void castBeyond(const Rings<kBent>& rings, const CasterView& view, const Rays& rays, F start, M lanes,
                       Hits& hits, I& color) {
    const Inverses inverse = inversesOf(rays);
    F border = borderExit(rings[0], inverse);
    M left = lanes;
    for (int n = 1; n < rings.count() && any(left); ++n) {
        const Ring<kBent>& ring = rings[n];
        const bool last = n + 1 == rings.count();
        const F exit = borderExit(ring, inverse);
        // A ring in which all rays are known to be free up to its border can be skipped. That is so for most
        // rings, since lower rays end farther out.
        if (!last && !any(left & (start <= exit))) {
            border = max(border, exit);
            continue;
        }
        const Rays here = scaled(rays, ring.scale);
        const Hits found = castEntering(ring.eye, here, border, start, left);
        const M met = left & (found.t < infinity());
        const M shaded = last ? left : met;
        if (any(shaded)) color = select(shaded, shadePacket(*ring.scene, view, here, found, shaded), color);
        hits.t = select(met, found.t, hits.t);
        hits.free = select(left, found.free, hits.free);
        left = andNot(left, met);
        border = max(border, exit);
    }
}

// Returns the PackedColors of rays `lanes` that were cast at the first ground. Where they missed it, their
// hits are replaced by those beyond it.
template <bool kBent>
STEREONAV_INLINE I shadeThrough(const Rings<kBent>& rings, const CasterView& view, const Rays& rays, F start,
                                M lanes, Hits& hits) {
    if (rings.count() == 1) return shadePacket(*rings[0].scene, view, rays, hits, lanes);
    const M here = lanes & (hits.t < infinity());
    I color = I(0);
    if (any(here)) color = shadePacket(*rings[0].scene, view, rays, hits, here);
    const M left = andNot(lanes, here);
    if (any(left)) castBeyond(rings, view, rays, start, left, hits, color);
    return color;
}

// Casts the rays `lanes`: sets hits, and returns their PackedColors. start: castPacket()'s.
template <bool kBent>
STEREONAV_INLINE I castThrough(const Rings<kBent>& rings, const CasterView& view, const Rays& rays, F start,
                               M lanes, Hits& hits) {
    if (!any(lanes & (start < infinity()))) {  // lower rays have risen above all ground for good: so do these
        hits = noHits();
        hits.free = infinity();
        return shadePacket(*rings[0].scene, view, rays, hits, lanes);
    }
    const Ring<kBent>& first = rings[0];
    const I cold(kColdLevel < first.scene->ground.levels ? kColdLevel : 0);
    const bool passed = rings.count() > 1 && !any(lanes & (start <= borderExit(first, inversesOf(rays))));
    hits = passed ? noHits() : castPacket(first.eye, rays, start, select(start > F(0.0f), I(0), cold), lanes);
    return shadeThrough(rings, view, rays, start, lanes, hits);
}

}  // namespace stereonav::STEREONAV_ISA
