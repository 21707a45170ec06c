// Blinn-Phong under a lamp at the head, baked light and openness. Included by kernels only.
#pragma once

#include "engine/volume/kernel_baked.h"
#include "engine/volume/kernel_bytes.h"
#include "engine/volume/kernel_normal.h"
#include "engine/volume/kernel_studio.h"

namespace stereonav::STEREONAV_ISA {

// Returns 2^x for |x| < 120: the fraction by a polynomial of the fifth degree, relative error below 3e-7 and
// 1.
STEREONAV_INLINE F exp2(F x) {
    const F bounded = clamp(x, F(-120.0f), F(120.0f));
    const I whole = floorToInt(bounded);
    const F f = bounded - toFloat(whole);
    F p = mulAdd(F(1.8775767e-3f), f, F(8.9893397e-3f));
    p = mulAdd(p, f, F(5.5826318e-2f));
    p = mulAdd(p, f, F(2.4015361e-1f));
    p = mulAdd(p, f, F(6.9315308e-1f));
    p = mulAdd(p, f, F(9.9999994e-1f));
    return p * asFloat(shiftLeft<23>(whole + I(127)));
}
// Returns log2 of positive normal numbers.
STEREONAV_INLINE F log2(F x) {
    const I bitsOfX = asInt(x);
    const F exponent = toFloat(shiftRight<23>(bitsOfX) - I(127));
    const F m = asFloat((bitsOfX & I(0x7FFFFF)) | I(0x3F800000));
    // (m - 1) / (m + 1) in the series of the inverse hyperbolic tangent; m in [1, 2).
    const F u = (m - F(1.0f)) * approxReciprocal(m + F(1.0f)), square = u * u;
    F p = mulAdd(square, F(2.0f / 9), F(2.0f / 7));
    p = mulAdd(p, square, F(2.0f / 5));
    p = mulAdd(p, square, F(2.0f / 3));
    p = mulAdd(p, square, F(2.0f));
    return mulAdd(u * p, F(1.44269504f), exponent);
}

// Returns x^n by squaring; n > 0.
STEREONAV_INLINE F wholePower(F x, int n) {
    F result(1.0f);
    for (F square = x;; square = square * square) {
        if (n & 1) result = result * square;
        n >>= 1;
        if (n == 0) return result;
    }
}

// Linear RGB.
struct Light {
    F red, green, blue;
};

// The lamp's share that reaches a point and what the surface sends to the eye: factor * (albedo * diffuse
// part + highlight), finite for every finite t and n. t: view depth, metres; n: normals of any length but 0;
// lit: share of the lamp that is seen.
struct Lit {
    F diffuse, highlight;  // linear
    V3 normal;             // unit
};
STEREONAV_INLINE Lit litBy(const VolumeData& data, const VolumeView& view, const Rays& r, F t, V3 n, F lit) {
    const auto world = [&](int k) {
        return mulAdd(r.windowX, F(view.right[k]), mulAdd(r.windowY, F(view.up[k]), F(view.forward[k])));
    };
    const V3 way{world(0), world(1), world(2)};
    const V3 lamp{F(view.head[0]) - t * way.x, F(view.head[1]) - t * way.y, F(view.head[2]) - t * way.z};
    // Times the falloff, at most kMostFalloff, still finite, and so is its reciprocal.
    const F square = clamp(dot(lamp, lamp), F(1e-20f), F(1e29f));
    const F inverse = approxRsqrt(square);
    const F normalSquare = max(dot(n, n), F(1e-12f));
    const F byLength = approxRsqrt(normalSquare);
    const V3 unit{n.x * byLength, n.y * byLength, n.z * byLength};
    const F cosine = dot(n, lamp) * inverse * byLength;
    const LightData& light = data.light;
    const F reaches = approxReciprocal(mulAdd(square, F(light.inverseFalloffSquared), F(1.0f)));
    const F up = n.z * byLength * F(light.varyingAmbient);
    const F ambient = mulAdd(F(light.ambient), up, F(light.ambient));
    F facing = max(cosine, F(0.0f));
    if (light.leastCosine4 > 0) {
        const F facing2 = facing * facing;
        facing = sqrt(sqrt(mulAdd(facing2, facing2, F(light.leastCosine4))));
    }
    const F diffuse = mulAdd(F(light.diffuse), facing * lit, ambient) * reaches;
    if (!(light.specular > 0)) return {diffuse, F(0.0f), unit};
    // Most of a wall that is seen along a tube: highlight_bound.h.
    const M shines = (cosine > F(0.0f)) & (mulAdd(F(view.lampAway), inverse, cosine) >= F(light.faintCosine));
    if (!any(shines)) return {diffuse, F(0.0f), unit};
    const F toEye = F(0.0f) - r.perMetre;
    const V3 half{mulAdd(lamp.x, inverse, way.x * toEye), mulAdd(lamp.y, inverse, way.y * toEye),
                  mulAdd(lamp.z, inverse, way.z * toEye)};
    // The cosine's square to half the exponent: one reciprocal in place of two square roots.
    const F along = max(dot(n, half), F(0.0f));
    const F aligned = along * along * approxReciprocal(normalSquare * max(dot(half, half), F(1e-12f)));
    const F bounded = clamp(aligned, F(1e-30f), F(1.0f));
    const F power = light.wholeHalf > 0 ? wholePower(bounded, light.wholeHalf)
                                        : exp2(log2(bounded) * F(0.5f * light.shininess));
    return {diffuse, select(shines, power * F(light.specular) * reaches * lit, F(0.0f)), unit};
}

// Returns a packed channel of linear light in one channel.
STEREONAV_INLINE I closeLinear(F v) {
    const F light = clamp(v, F(1e-12f), F(1.0f));
    return truncateToInt(mulAdd(light * approxRsqrt(light), F(1023.0f), F(0.5f)));
}
STEREONAV_INLINE I packLight(const Light& c) {
    return closeLinear(c.red) | shiftLeft<10>(closeLinear(c.green)) | shiftLeft<20>(closeLinear(c.blue));
}

STEREONAV_INLINE Light backgroundOf(const LightData& light) {
    return {F(light.background[0]), F(light.background[1]), F(light.background[2])};
}

// Light that falls onto a surface, by colour, and the highlight on it.
struct Falling {
    Light diffuse;
    F highlight;
};
STEREONAV_INLINE Falling ofLamp(const Lit& lamp, F share) {
    const F light = lamp.diffuse * share;
    return {{light, light, light}, lamp.highlight * share};
}

// Returns whether light is looked up where a surface is.
STEREONAV_INLINE bool looksUpLight(const VolumeData& data) {
    return data.baked.texels || data.occlusion.openness.values || data.studio.words;
}

// Returns k O, and beside it the lamp's direct light (Ruiz et al. 2010, eq. 5): the lamp's own ambient light
// is left out here. Known everywhere. lampAt as for fallingOn().
template <typename Lamp>
STEREONAV_INLINE Falling ofOpenness(const OcclusionData& data, const V3& voxel, M m, const Lamp& lampAt) {
    const F ambient = bytesAt(data.openness, voxel, m) * F(data.perByte);
    if (!(data.lampShare > 0)) return {{ambient, ambient, ambient}, F(0.0f)};
    const Lit lamp = lampAt();
    const F light = mulAdd(F(data.lampShare), lamp.diffuse, ambient);
    return {{light, light, light}, F(data.lampShare) * lamp.highlight};
}

// Returns light of sky and key light, and the lamp's share (studioLight()). lampAt as for fallingOn().
template <typename Lamp>
STEREONAV_INLINE Falling ofStudio(const StudioData& data, const V3& voxel, M m, const Lamp& lampAt) {
    const Lit lamp = lampAt();
    if (!any(m)) return ofLamp(lamp, F(0.0f));
    const SkySeenBy seen = skySeenBy(data, voxel, lamp.normal, m);
    const auto along = [&](const float(&to)[3]) {
        return dot(lamp.normal, V3{F(to[0]), F(to[1]), F(to[2])});
    };
    const F up = along(data.up), key = max(along(data.keyFrom), F(0.0f)) * seen.key;
    const F share = mulAdd(seen.sky, F(data.lampOpen), F(data.lampDeep)), direct = lamp.diffuse * share;
    const auto channel = [&](int k) {
        const F sky = mulAdd(up, F(data.skyChange[k]), F(data.skyMean[k]));
        return mulAdd(seen.sky, sky, mulAdd(key, F(data.key[k]), direct));
    };
    return {{channel(0), channel(1), channel(2)}, lamp.highlight * share};
}

// Returns the light that falls on places at view depths t. lampAt(): litBy of these points, asked for only
// where the lamp counts: its normals take as many loads as half a lookup of baked light, and its shadows
// rays. It does where less than `enough` of a lookup is known: 1 asks for what a neighbour may need, who
// knows nothing. t: finite, of all lanes; so is what comes back.
template <typename Lamp>
STEREONAV_INLINE Falling fallingOn(const VolumeData& data, const VolumeView& view, const Rays& r, F t, M m,
                                   float enough, const Lamp& lampAt) {
    const F one(1.0f), zero(0.0f);
    if (!looksUpLight(data)) return ofLamp(lampAt(), one);
    const auto voxel = [&](int k, F direction) {
        return mulAdd(t, direction, F(view.eye[k])) + F(static_cast<float>(view.base[k]));
    };
    const V3 place{voxel(0, r.direction.x), voxel(1, r.direction.y), voxel(2, r.direction.z)};
    if (data.studio.words) return ofStudio(data.studio, place, m, lampAt);
    if (!data.baked.texels) return ofOpenness(data.occlusion, place, m, lampAt);
    const BakedLight baked = bakedAt(data.baked, place, m);
    const M known = m & (baked.known > zero);
    if (data.baked.openness) return ofLamp(lampAt(), select(known, baked.red, one));
    if (!(data.baked.lampShare > 0) && !any(m & (baked.known < F(enough))))
        return {{baked.red, baked.green, baked.blue}, zero};
    const Lit lamp = lampAt();
    const F share = select(known, F(data.baked.lampShare), one);
    const auto both = [&](F light) { return mulAdd(share, lamp.diffuse, select(known, light, zero)); };
    return {{both(baked.red), both(baked.green), both(baked.blue)}, share * lamp.highlight};
}

// The background, which is shown where nothing is met.
STEREONAV_INLINE I packedBackground(const LightData& light) {
    return packLight(backgroundOf(light));
}

// Returns what the surface sends to the eye, through the fog; behind: packedBackground. t: finite, of all
// lanes.
STEREONAV_INLINE I sentColor(const LightData& light, const Rays& r, F t, M hit, const Falling& falling,
                             I behind) {
    Light sent{mulAdd(falling.diffuse.red, F(light.albedo[0]), falling.highlight),
               mulAdd(falling.diffuse.green, F(light.albedo[1]), falling.highlight),
               mulAdd(falling.diffuse.blue, F(light.albedo[2]), falling.highlight)};
    if (light.inverseFog > 0) {
        const Light far = backgroundOf(light);
        const F through = exp2(t * approxReciprocal(r.perMetre) * F(-1.44269504f * light.inverseFog));
        sent = {lerp(far.red, sent.red, through), lerp(far.green, sent.green, through),
                lerp(far.blue, sent.blue, through)};
    }
    return select(hit, packLight(sent), behind);
}

// Returns the colour of a surface at a view depth; lampAt(t): as for fallingOn().
template <typename Lamp>
STEREONAV_INLINE I surfaceColor(const VolumeData& data, const VolumeView& view, const Rays& r, F depth, M hit,
                                I behind, const Lamp& lampAt) {
    const F t = select(hit, depth, F(1.0f));
    const Falling falling = fallingOn(data, view, r, t, hit, 1.0f, [&] { return lampAt(t); });
    return sentColor(data.light, r, t, hit, falling, behind);
}

}  // namespace stereonav::STEREONAV_ISA
