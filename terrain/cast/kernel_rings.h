// Rays that leave a ground through its border and go on over the coarser ground around it
// (terrain/ground/ground_rings.h). Where that ground lies higher than the finer one did at the border, a ray
// meets the step between the two. Included by kernels only.
#pragma once

#include "engine/simd/simd.h"
#include "terrain/cast/caster_types.h"
#include "terrain/cast/kernel_cast.h"
#include "terrain/cast/kernel_shade.h"

namespace stereonav::STEREONAV_ISA {

// The same rays in grid units of the coarser ground: exact, since scales are powers of two.
STEREONAV_INLINE void scaleRays(Rays& rays, double scale) {
    const D d(scale);
    const F f(static_cast<float>(scale));
    rays.exactX = rays.exactX * d, rays.exactY = rays.exactY * d;
    rays.x = rays.x * f, rays.y = rays.y * f;
}

// Where the rays leave the ground. They come from inside it, or above its border.
template <bool kBent>
STEREONAV_INLINE F borderExit(const Eye<kBent>& eye, const Rays& rays) {
    const F inverseX = approxReciprocal(divisible(rays.x)), inverseY = approxReciprocal(divisible(rays.y));
    const F west = (toFloat(I(-eye.baseI)) - eye.relativeX) * inverseX;
    const F east = (toFloat(eye.lastI + I(1 - eye.baseI)) - eye.relativeX) * inverseX;
    const F south = (toFloat(I(-eye.baseJ)) - eye.relativeY) * inverseY;
    const F north = (toFloat(eye.lastJ + I(1 - eye.baseJ)) - eye.relativeY) * inverseY;
    return min(max(west, east), max(south, north));
}

// Of a ray where its walk stands.
struct Standing {
    F height;    // over ground, metres
    F u, v;      // in its cell
    F approach;  // as of a hit
};

template <bool kBent>
STEREONAV_INLINE Standing standingAt(const Eye<kBent>& eye, const Walk<kBent>& w, M m) {
    Standing s;
    const I index = w.j * I(eye.ground.width) + w.i;
    const FPair south = gatherPair(eye.ground.heights, index, m);
    const FPair north = gatherPair(eye.ground.heights + eye.ground.width, index, m);
    const F du = south.second - south.first, dv = north.first - south.first;
    const F twist = (north.second - north.first) - du;
    s.u = clamp(mulAdd(w.t, w.rays.x, eye.relativeX - toFloat(w.i - I(eye.baseI))), F(0.0f), F(1.0f));
    s.v = clamp(mulAdd(w.t, w.rays.y, eye.relativeY - toFloat(w.j - I(eye.baseJ))), F(0.0f), F(1.0f));
    const F slopeU = mulAdd(s.v, twist, du), slopeV = mulAdd(s.u, twist, dv);
    s.height = heightAt(w, w.t, (eye.height - south.first) + eye.rest) - mulAdd(s.u, slopeU, s.v * dv);
    s.approach = riseAt(w, w.t) - mulAdd(w.rays.x, slopeU, w.rays.y * slopeV);
    return s;
}

// Below the ground by more than rounding makes of nothing. False in a hole, whose heights are NaN.
template <bool kBent>
STEREONAV_INLINE M sunk(const Eye<kBent>& eye, F height) {
    return height < F(0.0f) - eye.margin - eye.margin;
}

// Where a walk stands.
struct WalkPlace {
    F t;
    I i, j;
};

STEREONAV_INLINE void meetAt(const WalkPlace& w, const Standing& s, M m, Hits& hits) {
    hits.t = select(m, w.t, hits.t);
    hits.i = select(m, w.i, hits.i);
    hits.j = select(m, w.j, hits.j);
    hits.u = select(m, s.u, hits.u);
    hits.v = select(m, s.v, hits.v);
    hits.approach = select(m, s.approach, hits.approach);
    hits.free = select(m, w.t, hits.free);
}

// First hits of rays that come from the finer ground at `border`; start: as of castPacket.
template <bool kBent>
STEREONAV_INLINE Hits castEntering(const Eye<kBent>& eye, const Rays& rays, F border, F start, M lanes) {
    const M entering = start <= border;
    const I cold(kColdLevel < eye.ground.levels ? kColdLevel : 0);
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

// Whether all rays `lanes` start beyond the border at `exit`, known to be free until there, of a ground that
// goes on: then it has nothing for them. So it is with most, as lower ones end further out.
STEREONAV_INLINE bool startBeyond(const CasterScene& scene, F start, F exit, M lanes) {
    return scene.beyond.scene != nullptr && !any(lanes & (start <= exit));
}

// For rays `lanes` that did not meet the ground `inner`: what they meet beyond it, and its colour, or the
// sky's. start: as of castPacket.
template <bool kBent>
inline void castBeyond(const CasterScene& inner, const CasterView& view, const Eye<kBent>& innerEye,
                       const Rays& innerRays, F start, M lanes, Hits& hits, I& color) {
    const CasterScene* scene = &inner;
    double x = innerEye.x, y = innerEye.y;
    Rays rays = innerRays;
    F border = borderExit(innerEye, rays);
    M left = lanes;
    while (scene->beyond.scene != nullptr && any(left)) {
        const CoarserGround& beyond = scene->beyond;
        x = (x - beyond.originX) * beyond.scale;
        y = (y - beyond.originY) * beyond.scale;
        scaleRays(rays, beyond.scale);
        scene = beyond.scene;
        const Eye<kBent> eye = makeEyeAt<kBent>(scene->ground, view, x, y);
        const F exit = borderExit(eye, rays);
        if (startBeyond(*scene, start, exit, left)) {
            border = max(border, exit);
            continue;
        }
        const Hits met = castEntering(eye, rays, border, start, left);
        const M here = left & (met.t < infinity());
        const M shaded = scene->beyond.scene != nullptr ? here : left;
        if (any(shaded)) color = select(shaded, shadePacket(*scene, view, rays, met, shaded), color);
        hits.t = select(here, met.t, hits.t);
        hits.free = select(left, met.free, hits.free);
        left = andNot(left, here);
        border = max(border, exit);
    }
}

// Colours of rays `lanes` that were cast at the scene's first ground; hits become those beyond it where they
// met nothing there.
template <bool kBent>
STEREONAV_INLINE I shadeThrough(const CasterScene& scene, const CasterView& view, const Eye<kBent>& eye,
                                const Rays& rays, F start, M lanes, Hits& hits) {
    if (scene.beyond.scene == nullptr) return shadePacket(scene, view, rays, hits, lanes);
    const M here = lanes & (hits.t < infinity());
    I color = I(0);
    if (any(here)) color = shadePacket(scene, view, rays, hits, here);
    const M left = andNot(lanes, here);
    if (any(left)) castBeyond(scene, view, eye, rays, start, left, hits, color);
    return color;
}

}  // namespace stereonav::STEREONAV_ISA
