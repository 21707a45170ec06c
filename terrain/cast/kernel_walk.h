// A packet of rays, the eye that they come from, and their walk over a ground. Included by kernels only.
//
// Over a round Earth (CasterView::fall) rays are parabolas that open upwards (kBent). Straight rays are
// compiled separately, and cost nothing more.
#pragma once

#include "engine/simd/simd.h"
#include "terrain/cast/caster_types.h"

namespace stereonav::STEREONAV_ISA {

// Ray directions per unit of view depth: grid units for x and y, metres for z.
struct Rays {
    D exactX, exactY, exactZ;
    F x, y, z;
};

// Hits of rays with the ground. t: view depth in metres, infinite for a miss, where the other members have no
// meaning.
struct Hits {
    F t;
    I i, j;      // cell
    F u, v;      // position in the cell, 0 to 1
    F approach;  // rate of height over ground along the ray, metres a unit of t (negative from above)
    F free;      // up to here the ray is known to be above the ground; 0: not known
};

// The curvature of a round Earth: a ray rises by t^2 (bendX x^2 + bendY y^2) metres over level ground, for a
// direction of (x, y) grid units per unit of t.
template <bool kBent>
struct EyeBend {};
template <>
struct EyeBend<true> {
    double bendX, bendY;  // metres, for t = 1
};

// Values that are the same for all rays of a view.
template <bool kBent>
struct Eye {
    const GroundData* ground;
    double x, y, z;          // grid, grid, metres
    int baseI, baseJ;        // grid cell that single-precision coordinates are relative to
    F relativeX, relativeY;  // grid units from that cell
    // The eye's height in metres: as a float, and the remainder. Heights of the ground are subtracted from
    // the first, which is exact where both are far from 0; then the remainder is added. So ground at 10,000
    // km is as exact as ground at 0.
    F height, rest;
    F margin;  // metres: bound of the rounding error of a ray's height (see below)
    I lastI, lastJ;
    float nearDepth;  // metres along the view
    EyeBend<kBent> bend;
};

// Returns x rounded towards 0, low to high.
STEREONAV_INLINE int clampInt(double x, int low, int high) {
    return x < low ? low : x > high ? high : static_cast<int>(x);
}

// Returns the largest rise in metres of a ray by its bend over this ground.
STEREONAV_INLINE double largestRise(const GroundData& ground, double fall, double x, double y) {
    const double east = ground.width - 1 - x, north = ground.height - 1 - y;
    const double wide = (x > east ? x : east) * ground.spacingX,
                 high = (y > north ? y : north) * ground.spacingY;
    return fall * (wide * wide + high * high);
}

// Returns the eye of a view at grid coordinates x, y of this ground.
template <bool kBent>
STEREONAV_INLINE Eye<kBent> makeEyeAt(const GroundData& ground, const CasterView& view, double x, double y) {
    const int baseI = clampInt(x, 0, ground.width - 2);
    const int baseJ = clampInt(y, 0, ground.height - 2);
    // Heights enter as (eye - sample) + rest + t * slope, and in differences of samples. Each term is rounded
    // once and is at most as large as the largest of them; 2^-21 of that covers the few roundings of 2^-24.
    const float height = static_cast<float>(view.originZ);
    const auto size = [](double z) { return static_cast<float>(z < 0 ? -z : z); };
    float largest = ground.maxHeight - ground.minHeight;
    if (size(view.originZ - ground.minHeight) > largest) largest = size(view.originZ - ground.minHeight);
    if (size(view.originZ - ground.maxHeight) > largest) largest = size(view.originZ - ground.maxHeight);
    EyeBend<kBent> bend;
    if constexpr (kBent) {
        bend.bendX = view.fall * ground.spacingX * ground.spacingX;
        bend.bendY = view.fall * ground.spacingY * ground.spacingY;
        // The factor of the bend alone has a relative error of 2^-22.
        largest += 4 * static_cast<float>(largestRise(ground, view.fall, x, y));
    }
    return {&ground,
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
            view.nearDepth,
            bend};
}

// Returns the eye over the view's own ground.
template <bool kBent>
STEREONAV_INLINE Eye<kBent> makeEye(const GroundData& ground, const CasterView& view) {
    return makeEyeAt<kBent>(ground, view, view.originX, view.originY);
}

STEREONAV_INLINE F infinity() {
    return F(__builtin_inff());
}

// Returns a direction component that is safe to divide by: its magnitude is at least 1e-18.
STEREONAV_INLINE F divisible(F d) {
    return select(abs(d) < F(1e-18f), select(d < F(0.0f), F(-1e-18f), F(1e-18f)), d);
}

// A ray's height over level ground is z + t dz + t^2 sink metres, least at t = `lowest`.
template <bool kBent>
struct WalkBend {};
template <>
struct WalkBend<true> {
    F sink, lowest;
};

// A packet of rays on their way over a ground.
template <bool kBent>
struct Walk : WalkBend<kBent> {
    Rays rays;
    F inverseX, inverseY;  // 1 / direction, with components from divisible()
    M eastward, northward, downward;
    F t;  // view depth that the walk has reached, metres
    // Metres; hits before it do not count: the near distance, or where the ray came to this ground.
    F floor;
    I i, j, level;  // cell, and level of the pyramid
    M active;       // still over the ground, without a hit
    M risen;        // above all ground and rising: can not hit any more
    F over;         // height of the eye over the highest sample, metres, and the margin
};

// Returns the height in metres of a ray at t over a place that lies `eye` metres below the eye.
template <bool kBent>
STEREONAV_INLINE F heightAt(const Walk<kBent>& w, F t, F eye) {
    if constexpr (kBent)
        return mulAdd(t, mulAdd(t, w.sink, w.rays.z), eye);
    else
        return mulAdd(t, w.rays.z, eye);
}

// Returns the slope of a ray at t, metres per unit of t.
template <bool kBent>
STEREONAV_INLINE F riseAt(const Walk<kBent>& w, F t) {
    if constexpr (kBent)
        return mulAdd(t, w.sink + w.sink, w.rays.z);
    else
        return w.rays.z;
}

// Returns the t between the present one and `end` at which a ray is lowest.
template <bool kBent>
STEREONAV_INLINE F lowestUntil(const Walk<kBent>& w, F end) {
    if constexpr (kBent)
        return max(w.t, min(end, w.lowest));
    else
        return select(w.downward, end, w.t);
}

// Returns the rays that are above all ground at t and stay so.
template <bool kBent>
STEREONAV_INLINE M hasRisenAt(const Walk<kBent>& w, F t) {
    if constexpr (kBent)
        return (t >= w.lowest) & (heightAt(w, t, w.over) > F(0.0f));
    else
        return andNot(heightAt(w, t, w.over) > F(0.0f), w.downward);
}

// Sets the rays' slope at t = 0, metres per unit of t, and values derived from it.
template <bool kBent>
STEREONAV_INLINE void takeSlope(Walk<kBent>& w, F z) {
    w.rays.z = z;
    w.downward = z < F(0.0f);
    if constexpr (kBent) w.lowest = (F(0.0f) - z) * approxReciprocal(max(w.sink + w.sink, F(1e-30f)));
}

}  // namespace stereonav::STEREONAV_ISA
