// Spreads scattered light while a tile of the light's buffer passes a slab (V8, V9 and V11 of
// docs/volume_light.md). Included by kernels only.
#pragma once

#include "engine/medium/sweep/kernel_arriving.h"

namespace stereonav::STEREONAV_ISA {

// The texels' rays in the middle of a slab.
struct TexelPlaces {
    V3 place;
    V3 way;     // way along the ray per metre along the sweep's axis
    F length;   // length of `way`
    F size;     // metres across a texel there
    M crosses;  // rays that cross slabs
    M valid;    // those that cross in front of the lamp; all of parallel light
};
// Returns right x + up y of the light's fan.
STEREONAV_INLINE V3 alongFan(const SweepLight& light, F x, F y) {
    const auto axis = [&](int k) { return mulAdd(F(light.right[k]), x, mulAdd(F(light.up[k]), y, F(0.0f))); };
    return {axis(0), axis(1), axis(2)};
}
STEREONAV_INLINE TexelPlaces texelPlaces(const SweepLight& light, float middle, F x, F y) {
    const F u = mulAdd(x, F(light.perX), F(light.xMin)), v = mulAdd(y, F(-light.perY), F(light.yMax));
    const F zero(0.0f);
    const V3 aside = alongFan(light, u, v);
    const F asideAxis = mulAdd(F(light.axis[0]), u, F(light.axis[1]) * v);
    TexelPlaces p;
    if (light.parallel) {  // the way starts in the plane of the fan's origins
        const F way = (F(middle) - asideAxis) * F(light.length);
        p.place = {mulAdd(way, F(light.forward[0]), aside.x), mulAdd(way, F(light.forward[1]), aside.y),
                   mulAdd(way, F(light.forward[2]), aside.z)};
        const auto along = [&](int k) { return F(light.forward[k] * light.length); };
        p.way = {along(0), along(1), along(2)};
        p.length = F(light.length);
        p.size = F(light.perX);
        p.crosses = p.valid = zero < F(1.0f);
        return p;
    }
    const V3 d{aside.x + F(light.forward[0]), aside.y + F(light.forward[1]), aside.z + F(light.forward[2])};
    const F c = asideAxis + F(light.axis[2]), length = lengthOf(d);
    p.crosses = c > F(1e-4f) * length;
    const F per = F(1.0f) / select(p.crosses, c, F(1.0f)), depth = (F(middle) - F(light.start)) * per;
    p.place = {mulAdd(depth, d.x, F(light.origin[0])), mulAdd(depth, d.y, F(light.origin[1])),
               mulAdd(depth, d.z, F(light.origin[2]))};
    p.way = {per * d.x, per * d.y, per * d.z};
    p.length = length * per;
    p.size = depth * F(light.perX);
    p.valid = p.crosses & (depth > zero);
    return p;
}

// Sine and cosine of 0 .. pi / 2, errors below 4e-6.
struct Turn {
    F cosine, sine;
};
STEREONAV_INLINE Turn turnBy(F a) {
    const F s = a * a, one(1.0f);
    F sine = mulAdd(s, F(1.0f / 362880), F(-1.0f / 5040));
    sine = mulAdd(sine, s, F(1.0f / 120));
    sine = mulAdd(sine, s, F(-1.0f / 6));
    F cosine = mulAdd(s, F(-1.0f / 3628800), F(1.0f / 40320));
    cosine = mulAdd(cosine, s, F(-1.0f / 720));
    cosine = mulAdd(cosine, s, F(1.0f / 24));
    cosine = mulAdd(cosine, s, F(-0.5f));
    return {mulAdd(cosine, s, one), mulAdd(sine, s, one) * a};
}
template <int kBits>
STEREONAV_INLINE I logicalRight(I a) {
    return shiftRight<kBits>(a) & I(static_cast<int>(0xFFFFFFFFu >> kBits));
}
STEREONAV_INLINE I wholeNumber(std::uint32_t bitsOf) {
    return I(static_cast<int>(bitsOf));
}
// Returns the rotation of the taps on a circle, radians, by a hash of texel and slab: tapTurn() of
// tests/oracle/sweep_formulas.h.
STEREONAV_INLINE F turnOf(I x, I y, int slab) {
    I h = (x * wholeNumber(0x8da6b343u)) ^ (y * wholeNumber(0xd8163841u)) ^
          wholeNumber(static_cast<std::uint32_t>(slab) * 0xcb1ab31fu);
    h = (h ^ logicalRight<16>(h)) * wholeNumber(0x7feb352du);
    h = (h ^ logicalRight<15>(h)) * wholeNumber(0x846ca68bu);
    h = h ^ logicalRight<16>(h);
    return toFloat(logicalRight<8>(h)) * F(1.57079633f / 16777216);
}

// Returns a plane of light at continuous coordinates, bilinear.
STEREONAV_INLINE F readPlane(const SweepLight& light, const float* plane, F u, F v, M m) {
    const F half(0.5f), least(-1.0f), one(1.0f);
    const F x = clamp(u - half, least, F(static_cast<float>(light.width)));
    const F y = clamp(v - half, least, F(static_cast<float>(light.height)));
    const I i = floorToInt(x), j = floorToInt(y);
    const F s = x - toFloat(i), t = y - toFloat(j);
    const I index = j * I(light.stride) + i;
    const FPair above = gatherPair(plane, index, m), below = gatherPair(plane + light.stride, index, m);
    return lerp(lerp(above.first, above.second, s), lerp(below.first, below.second, s), t);
}

// Delay in metres with which the texels to the right and below meet a slab that leans (V11): tapLags() of
// tests/oracle.
struct Lags {
    F right, below;
};
STEREONAV_INLINE Lags lagsOf(const SweepLight& light, float middle, F x, F y) {
    const F right(light.axis[0] * light.perX), below(-light.axis[1] * light.perY);
    if (light.parallel) {
        const F scale(-light.leaning * light.length);
        return {scale * right, scale * below};
    }
    const F u = mulAdd(x, F(light.perX), F(light.xMin)), v = mulAdd(y, F(-light.perY), F(light.yMax));
    const F c = max(mulAdd(F(light.axis[0]), u, mulAdd(F(light.axis[1]), v, F(light.axis[2]))), F(1e-4f));
    const F length = sqrt(mulAdd(u, u, mulAdd(v, v, F(1.0f)))), per = F(1.0f) / length;
    const F scale = F(light.leaning * (middle - light.start)) / c, along = length / c;
    return {scale * (u * per * F(light.perX) - along * right),
            scale * (v * per * F(-light.perY) - along * below)};
}

// A packet of texels in a row: everything that does not depend on the plane.
struct TexelRow {
    std::int64_t index;  // index of the first texel in a plane
    F x, y;              // centres
    F offsetSquare;      // square of the blur's offset, texels
    I column, line;
    int slab;
    Lags lags;  // where slabs lean
};
// Returns a tap's light with the factor of V11: a tap that meets its ray later than the texel itself has been
// weakened more, and counts for more. depth: tau_i at the tap, per metre; later: metres (Lags).
STEREONAV_INLINE F leveled(F light, F depth, F later) {
    return mulAdd(light, clamp(depth * later, F(-1.0f), F(1.0f)), light);
}
// Returns the depth of the texel that contains a place; 0 beyond the edge.
STEREONAV_INLINE F depthAt(const SweepLight& light, const float* depths, F u, F v, M m) {
    const F least(-1.0f);
    const I i = floorToInt(clamp(u, least, F(static_cast<float>(light.width)))),
            j = floorToInt(clamp(v, least, F(static_cast<float>(light.height))));
    return gather(depths, j * I(light.stride) + i, m, F(0.0f));
}
// Returns the sum of four taps on a circle. depths: null where slabs do not lean.
[[gnu::noinline]] inline F circleTaps(const SweepLight& light, const float* plane, const float* depths,
                                      const TexelRow& row, M m) {
    const F radius = sqrt(max(min(row.offsetSquare, F(1e12f)) - F(1.0f / 3), F(1.0f)));
    const Turn turn = turnBy(turnOf(row.column, row.line, row.slab));
    const F c = radius * turn.cosine, s = radius * turn.sine, zero(0.0f);
    const auto tap = [&](F right, F below) {
        const F u = row.x + right, v = row.y + below, at = readPlane(light, plane, u, v, m);
        if (!depths) return at;
        return leveled(at, depthAt(light, depths, u, v, m),
                       mulAdd(right, row.lags.right, below * row.lags.below));
    };
    return (tap(c, s) + tap(zero - s, c)) + (tap(zero - c, zero - s) + tap(s, zero - c));
}
// Returns the sum of the four neighbours, each leveled() where slabs lean.
STEREONAV_INLINE F fourTaps(const SweepLight& light, const float* plane, const float* depths,
                            const TexelRow& row) {
    const float* p = plane + row.index;
    if (!depths) return (loadF(p - 1) + loadF(p + 1)) + (loadF(p - light.stride) + loadF(p + light.stride));
    const float* d = depths + row.index;
    const F zero(0.0f);
    const auto tap = [&](std::int64_t to, F later) { return leveled(loadF(p + to), loadF(d + to), later); };
    return (tap(-1, zero - row.lags.right) + tap(1, row.lags.right)) +
           (tap(-light.stride, zero - row.lags.below) + tap(light.stride, row.lags.below));
}
// Returns a plane's light, 0 to 1, after it has spread over the slab.
STEREONAV_INLINE F blurred(const SweepLight& light, const float* plane, const float* depths,
                           const TexelRow& row, M m) {
    const F here = loadF(plane + row.index), quarter(0.25f), one(1.0f), wideFrom(4.0f / 3);
    const F share = min(row.offsetSquare, one);
    F four = fourTaps(light, plane, depths, row);
    const M wide = m & (row.offsetSquare > wideFrom);
    if (any(wide)) four = select(wide, circleTaps(light, plane, depths, row, wide), four);
    const F sum = mulAdd(share * quarter, four, here - share * here);
    return depths ? min(sum, one) : sum;
}

}  // namespace stereonav::STEREONAV_ISA
