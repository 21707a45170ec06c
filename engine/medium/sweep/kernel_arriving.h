// The light that arrives at packets of places: from the light's buffer and a lamp's cone and falloff, and how
// much of it a surface sends on. Included by kernels only.
#pragma once

#include "engine/medium/sweep/kernel_medium.h"

namespace stereonav::STEREONAV_ISA {

STEREONAV_INLINE F dotWith(const V3& v, const float (&a)[3]) {
    return mulAdd(v.x, F(a[0]), mulAdd(v.y, F(a[1]), v.z * F(a[2])));
}

// Light in the buffer at continuous coordinates, bilinear, 0 to 1; outside the buffer that of the ring around
// it.
struct Buffered {
    F direct, indirect[3];
};
template <bool kIndirect>
STEREONAV_INLINE Buffered readBuffer(const SweepLight& light, int inChunk, F u, F v, M m) {
    const F half(0.5f), least(-1.0f);
    const F x = clamp(u - half, least, F(static_cast<float>(light.width)));
    const F y = clamp(v - half, least, F(static_cast<float>(light.height)));
    const I i = floorToInt(x), j = floorToInt(y), one(1);
    const I s = weightOf(x - toFloat(i)), t = weightOf(y - toFloat(j));
    const I word = (j + one) * I(light.packedStride) + i + one;
    const std::uint32_t* plane = light.packed + 2 * inChunk * light.packedPlane;
    std::int64_t corner = 0;
    I index;
    const bool near = lightBlock(light, i, j, m, corner, index);
    const auto mixed = [&](const std::uint32_t* first) {
        if (near) {
            const WordBlock block = wordsAt(first + corner, light.packedStride);
            const I above = lerpHalves(block.at(index), block.at(index + one), s);
            return lerpHalves(above, lerpHalves(block.at(index + I(4)), block.at(index + I(5)), s), t);
        }
        const IPair above = gatherPair(first, word, m),
                    below = gatherPair(first + light.packedStride, word, m);
        return lerpHalves(lerpHalves(above.first, above.second, s), lerpHalves(below.first, below.second, s),
                          t);
    };
    const F unit(1.0f / 32767);
    Buffered b;
    const I first = mixed(plane);
    b.direct = toFloat(first & I(0xFFFF)) * unit;
    if constexpr (kIndirect) {
        const I second = mixed(plane + light.packedPlane);
        b.indirect[0] = toFloat(shiftRight<16>(first)) * unit;
        b.indirect[1] = toFloat(second & I(0xFFFF)) * unit;
        b.indirect[2] = toFloat(shiftRight<16>(second)) * unit;
    }
    return b;
}

// The light's direction at places, and the share of it that would arrive through empty space.
struct Arriving {
    V3 way;           // unit
    F share, length;  // 0 to 1, by the falloff; metres along the ray per metre along the axis
    F u, v;           // place in the buffer, texels
    M lit;            // places past the lamp; all for parallel light
    M inCone;         // within a lamp's cone, where direct light is
};
// Returns a lamp's light; along: metres along the axis at which the places lie.
[[gnu::noinline]] inline Arriving lampAt(const SweepLight& light, const V3& place, F along, M m) {
    const F zero(0.0f), one(1.0f), tiny(1e-30f);
    const V3 from{place.x - F(light.origin[0]), place.y - F(light.origin[1]), place.z - F(light.origin[2])};
    const F square = max(dot(from, from), tiny), distance = sqrt(square), inverse = one / distance;
    const F depth = dotWith(from, light.forward), past = along - F(light.start);
    Arriving a;
    a.way = {from.x * inverse, from.y * inverse, from.z * inverse};
    a.share = one / mulAdd(square, F(light.inverseFalloffSquared), one);
    a.lit = m & (past > F(1e-4f) * distance) & (depth > zero);
    a.inCone = a.lit & (depth * inverse >= F(light.lampCosine));
    const F perDepth = one / max(depth, tiny);
    a.u = (dotWith(from, light.right) * perDepth - F(light.xMin)) * F(1.0f / light.perX);
    a.v = (F(light.yMax) - dotWith(from, light.up) * perDepth) * F(1.0f / light.perY);
    a.length = distance / max(past, F(1e-4f) * distance);
    return a;
}
// Returns parallel light, which is the same everywhere.
STEREONAV_INLINE Arriving sunAt(const SweepLight& light, const V3& place, M m) {
    const V3 way{F(light.forward[0]), F(light.forward[1]), F(light.forward[2])};
    return {way,
            F(1.0f),
            F(light.length),
            (dotWith(place, light.right) - F(light.xMin)) * F(1.0f / light.perX),
            (F(light.yMax) - dotWith(place, light.up)) * F(1.0f / light.perY),
            m,
            m};
}

// Returns the share of the light by Blinn-Phong, the same on both sides; normal: any length; way, toEye:
// unit.
STEREONAV_INLINE F blinnPhong(const SweepLook& look, const V3& normal, const V3& way, const V3& toEye) {
    const F zero(0.0f), tiny(1e-30f);
    const F square = dot(normal, normal);
    const F inverse = approxRsqrt(max(square, tiny));
    const F facing = zero - dot(normal, way) * inverse, seen = dot(normal, toEye) * inverse;
    const V3 half{toEye.x - way.x, toEye.y - way.y, toEye.z - way.z};
    const F aligned = abs(dot(normal, half)) * inverse * approxRsqrt(max(dot(half, half), tiny));
    const F power = exp2(log2(clamp(aligned, F(1e-30f), F(1.0f))) * F(look.shininess));
    const F highlight = select(facing * seen > zero, power * F(look.specular), zero);
    const F sum = mulAdd(F(look.diffuse), abs(facing), F(look.ambient)) + highlight;
    return select(square > tiny, sum, zero);
}

// Returns (1 - S) + f_s S of V3 of docs/volume_light.md. place: not displaced; gradient: world axes.
[[gnu::noinline]] inline Colors surfaceFactor(const SweepScene& scene, F surface, const V3& place,
                                              const V3& gradient, const V3& way, const V3& toEye, M m) {
    const F one(1.0f);
    const F shaded = blinnPhong(scene.look, gradient, way, toEye);
    Colors f{{shaded, shaded, shaded}};
    const BakedData& baked = scene.look.baked;
    if (baked.texels) {
        const BakedLight light =
            bakedAt(baked, transformed(scene.look.texelFromPlace, scene.look.texelZero, place), m);
        const M known = m & (light.known > F(0.0f));
        const F own = baked.openness ? F(0.0f) : shaded * F(baked.lampShare);
        const F factor = baked.openness ? shaded : one;
        const F value[3] = {light.red, baked.openness ? light.red : light.green,
                            baked.openness ? light.red : light.blue};
        for (int k = 0; k < 3; ++k) f.c[k] = select(known, mulAdd(value[k], factor, own), f.c[k]);
    }
    for (int k = 0; k < 3; ++k) f.c[k] = mulAdd(surface, f.c[k], one - surface);
    return f;
}

}  // namespace stereonav::STEREONAV_ISA
