// Colours a packet: the ground's texture filtered by the ray's footprint, with fog, or the sky. Included by
// kernels only.
#pragma once

#include "engine/image/kernel_texture.h"
#include "engine/simd/simd.h"
#include "terrain/cast/caster_types.h"
#include "terrain/cast/kernel_cast.h"
#include "terrain/light/air_formula.h"

namespace stereonav::STEREONAV_ISA {

// Returns the base-2 logarithm within 0.01, for positive normal numbers.
STEREONAV_INLINE F approxLog2(F x) {
    const I bitsOfX = asInt(x);
    const F exponent = toFloat(shiftRight<23>(bitsOfX) - I(127));
    const F mantissa = asFloat((bitsOfX & I(0x7FFFFF)) | I(0x3F800000));
    return exponent + mulAdd(mulAdd(F(-0.33333f), mantissa, F(2.0f)), mantissa, F(-1.66667f));
}

// Returns the level of the texture, 0 or more. The footprint of a pixel on the ground is t * pixelWidth
// across; along the ray it is longer, the more the flatter the ray meets the ground. The level fits the
// geometric mean of the two sides: a compromise between shimmer and blur (docs/decisions).
STEREONAV_INLINE F mipLevel(const TextureData& texture, const CasterView& view, F length, F t, F approach) {
    const F side = t * F(texture.texelsPerMetre);
    const F area = side * side * F(view.pixelWidth * view.pixelHeight) * length *
                   approxReciprocal(max(abs(approach), F(1e-6f)));
    const F level = F(0.5f) * approxLog2(clamp(area, F(1e-6f), F(1e18f)));
    return clamp(level, F(0.0f), F(static_cast<float>(texture.levels - 1)));
}

// Returns the sky's colours in directions (x, y, z) of any length.
STEREONAV_INLINE ColorHalves skyColor(const SkyData& sky, F x, F y, F z, M m) {
    const F scale = approxReciprocal(max(abs(x) + abs(y) + abs(z), F(1e-30f)));
    const F px = x * scale, py = y * scale;
    const M below = z < F(0.0f);
    const F foldedX = select(px < F(0.0f), abs(py) - F(1.0f), F(1.0f) - abs(py));
    const F foldedY = select(py < F(0.0f), abs(px) - F(1.0f), F(1.0f) - abs(px));
    const float half = 0.5f * static_cast<float>(sky.size);
    const F tx = mulAdd(select(below, foldedX, px), F(half), F(half - 0.5f));
    const F ty = mulAdd(select(below, foldedY, py), F(half), F(half - 0.5f));
    const I last(sky.size - 2);
    const I i = clamp(floorToInt(tx), I(0), last), j = clamp(floorToInt(ty), I(0), last);
    const F fx = clamp(tx - toFloat(i), F(0.0f), F(1.0f)), fy = clamp(ty - toFloat(j), F(0.0f), F(1.0f));
    return bilinearColor(sky.texels, j * I(sky.stride) + i, I(sky.stride), fx, fy, m);
}

// Returns e^-x for x >= 0, relative error below 1e-5: a power of two times the square of a series of degree
// five for half of the remainder (at most ln 2 / 2, so that the error of the series is below 2.5e-6).
STEREONAV_INLINE F expMinus(F x) {
    const F y = min(x, F(80.0f)) * F(1.44269504f);
    const I whole = truncateToInt(y);
    const F h = (y - toFloat(whole)) * F(-0.34657359f);
    F half = mulAdd(h, F(1.0f / 120), F(1.0f / 24));
    half = mulAdd(h, half, F(1.0f / 6));
    half = mulAdd(h, half, F(0.5f));
    half = mulAdd(h, mulAdd(h, half, F(1.0f)), F(1.0f));
    return half * half * asFloat(shiftLeft<23>(I(127) - whole));
}

// Returns a channel (14-bit square root of linear light) seen through fog of the given linear colour;
// through: transmittance of the fog.
STEREONAV_INLINE I fogChannel(I root, float fog, F through) {
    constexpr float kFull = 1023.0f * 16;
    const F value = toFloat(root) * F(1 / kFull);
    const F linear = lerp(F(fog), value * value, through);
    return truncateToInt(mulAdd(sqrt(clamp(linear, F(0.0f), F(1.0f))), F(kFull), F(0.5f)));
}

// Fog is mixed in linear light. Texels are not: they hardly differ from their neighbours.
STEREONAV_INLINE ColorHalves fogged(const FogData& fog, ColorHalves c, F through) {
    const I low(0xFFFF);
    const I red = fogChannel(c.redBlue & low, fog.linear[0], through);
    const I green = fogChannel(c.green & low, fog.linear[1], through);
    const I blue = fogChannel(shiftRight<16>(c.redBlue) & low, fog.linear[2], through);
    return {red | shiftLeft<16>(blue), green};
}

// Functions for air_formula.h. airExp: e^-x with an error below 3e-7 for x from -12 to 80; x is clamped to
// that range.
STEREONAV_INLINE F airExp(F x) {
    const F y = clamp(x, F(-12.0f), F(80.0f)) * F(-1.44269504f);
    const I whole = floorToInt(y + F(0.5f));
    const F f = y - toFloat(whole);
    F p = mulAdd(f, F(1.5353362e-4f), F(1.3398874e-3f));
    p = mulAdd(f, p, F(9.6184374e-3f));
    p = mulAdd(f, p, F(5.5503325e-2f));
    p = mulAdd(f, p, F(2.4022648e-1f));
    p = mulAdd(f, p, F(6.9314720e-1f));
    p = mulAdd(f, p, F(1.0f));
    return p * asFloat(shiftLeft<23>(whole + I(127)));
}
STEREONAV_INLINE F airReciprocal(F x) {
    return approxReciprocal(x);
}
STEREONAV_INLINE F airLog(F x) {
    return approxLog2(x) * F(0.69314718f);
}
STEREONAV_INLINE F airRsqrt(F x) {
    return approxRsqrt(x);
}

// Returns a channel (14-bit square root of linear light) seen through air; through: transmittance; light:
// linear light that the air adds.
STEREONAV_INLINE I airChannel(I root, F through, F light) {
    constexpr float kFull = 1023.0f * 16;
    const F value = toFloat(root) * F(1 / kFull);
    const F linear = mulAdd(value * value, through, light);
    return truncateToInt(mulAdd(sqrt(clamp(linear, F(0.0f), F(1.0f))), F(kFull), F(0.5f)));
}

// Returns colours seen through the air of a physical sky. (x, y, z): a ray in metres per unit of view depth,
// with its length; t: view depth of the ground.
STEREONAV_INLINE ColorHalves aired(const AirData& air, const AirEye& eye, ColorHalves c, F x, F y, F z,
                                   F length, F t) {
    const F perMetre = approxReciprocal(length);
    const F cosSun = mulAdd(x, F(air.toSun[0]), mulAdd(y, F(air.toSun[1]), z * F(air.toSun[2]))) * perMetre;
    const AirAlong<F> along = airAlong(air, eye, t * length, z * perMetre, cosSun);
    const I low(0xFFFF);
    const I red = airChannel(c.redBlue & low, along.through[0], along.light[0]);
    const I green = airChannel(c.green & low, along.through[1], along.light[1]);
    const I blue = airChannel(shiftRight<16>(c.redBlue) & low, along.through[2], along.light[2]);
    return {red | shiftLeft<16>(blue), green};
}

// Returns the longer side of a pixel's footprint on the ground, metres.
STEREONAV_INLINE F longerSide(const CasterView& view, F length, F t, F approach) {
    const F along = F(view.pixelHeight) * length * approxReciprocal(max(abs(approach), F(1e-6f)));
    return t * max(along, F(view.pixelWidth));
}

// Returns how steep the ground is at hits, 0 to 1, as its detail has it.
STEREONAV_INLINE F roughnessAt(const DetailData& detail, const Hits& hits, M m) {
    const I index = hits.j * I(detail.roughPitch) + hits.i;
    const FPair south = gatherPair(detail.rough, index, m);
    const FPair north = gatherPair(detail.rough + detail.roughPitch, index, m);
    return lerp(lerp(south.first, south.second, hits.u), lerp(north.first, north.second, hits.u), hits.v);
}

// Returns how far an octave has faded in, 0 to 1. inverse: 1 / cells of the ground that a pixel covers.
STEREONAV_INLINE F octaveWeight(const DetailOctave& octave, F inverse) {
    return clamp(F(octave.cell / kDetailPixels) * inverse - F(1.0f), F(0.0f), F(1.0f));
}

// A place on an octave's lattice, which repeats itself.
struct LatticePlace {
    I south, north;  // index of the corner to the lower left, and of that above it
    F p, q;          // place between the corners, 0 to 1
};
template <int side, int pitch>
STEREONAV_INLINE LatticePlace latticePlace(const DetailOctave& octave, const Hits& hits) {
    const F a(static_cast<float>(octave.a)), b(static_cast<float>(octave.b));
    const F x = a * hits.u - b * hits.v, y = b * hits.u + a * hits.v;
    const I wholeX = floorToInt(x), wholeY = floorToInt(y), last(side - 1);
    const I column = (I(octave.a) * hits.i - I(octave.b) * hits.j + wholeX) & last;
    const I row = I(octave.b) * hits.i + I(octave.a) * hits.j + wholeY;
    return {(row & last) * I(pitch) + column, ((row + I(1)) & last) * I(pitch) + column, x - toFloat(wholeX),
            y - toFloat(wholeY)};
}

// Returns weatheredAt() of tests/oracle/plain_detail.h for the lanes m: kDarkestDetail to kBrightestDetail.
STEREONAV_INLINE F weatheredOf(const DetailData& detail, const Hits& hits, F footprint, M m) {
    const F inverse = approxReciprocal(max(footprint * F(detail.perMetre), F(1e-9f)));
    F light(0.0f), tone(0.0f);
    for (int k = 0; k < detail.octaves; ++k) {
        const DetailOctave& o = detail.octave[k];
        const F weight = octaveWeight(o, inverse);
        const M on = m & (weight > F(0.0f));
        if (!any(on)) break;
        const auto [southern, northern, p, q] = latticePlace<kReliefSide, kReliefPitch>(o, hits);
        const IPair south = gatherPair(detail.relief, southern, on);
        const IPair north = gatherPair(detail.relief, northern, on);
        const auto between = [&](auto part) {
            return lerp(lerp(part(south.first), part(south.second), p),
                        lerp(part(north.first), part(north.second), p), q);
        };
        const F alongX = between([](I word) { return toFloat(word & I(0x7FF)); }) - F(1024.0f);
        const F alongY =
            between([](I word) { return toFloat(shiftRight<11>(word) & I(0x7FF)); }) - F(1024.0f);
        const F high = between([](I word) { return toFloat(shiftRight<22>(word) & I(0x3FF)); }) - F(512.0f);
        light = mulAdd(weight, F(o.lightX) * alongX + F(o.lightY) * alongY, light);
        tone = mulAdd(weight * F(o.tone), high, tone);
    }
    const F rough = roughnessAt(detail, hits, m);
    const F all = mulAdd(rough, light, min(F(4.0f) * rough, F(1.0f)) * tone);
    return clamp(all, F(kDarkestDetail), F(kBrightestDetail));
}

// Returns what detailAt() of tests/oracle/plain_detail.h does, for the lanes m: kDarkestDetail to
// kBrightestDetail.
STEREONAV_INLINE F detailOf(const DetailData& detail, const Hits& hits, F footprint, M m) {
    const F inverse = approxReciprocal(max(footprint * F(detail.perMetre), F(1e-9f)));
    F light(0.0f);
    for (int k = 0; k < detail.octaves; ++k) {
        const DetailOctave& o = detail.octave[k];
        const F weight = octaveWeight(o, inverse);
        const M on = m & (weight > F(0.0f));
        if (!any(on)) break;
        const auto [southern, northern, p, q] = latticePlace<kDetailSide, kDetailPitch>(o, hits);
        const FPair south = gatherPair(detail.values, southern, on);
        const FPair north = gatherPair(detail.values, northern, on);
        const auto fade = [](F t) { return t * t * t * mulAdd(t, mulAdd(t, F(6.0f), F(-15.0f)), F(10.0f)); };
        const auto rise = [](F t) {
            const F s = t * (F(1.0f) - t);
            return F(30.0f) * s * s;
        };
        const F overSouth = south.second - south.first, overNorth = north.second - north.first;
        const F overWest = north.first - south.first, overEast = north.second - south.second;
        const F alongX = rise(p) * lerp(overSouth, overNorth, fade(q));
        const F alongY = rise(q) * lerp(overWest, overEast, fade(p));
        light = mulAdd(weight, F(o.lightX) * alongX + F(o.lightY) * alongY, light);
    }
    return clamp(roughnessAt(detail, hits, m) * light, F(kDarkestDetail), F(kBrightestDetail));
}

// Returns colours whose linear light is 1 + brighter times as strong.
STEREONAV_INLINE ColorHalves brightened(ColorHalves c, F brighter) {
    constexpr float kFull = 1023.0f * 16;
    const F scale = sqrt(F(1.0f) + brighter);
    const auto channel = [&](I root) {
        return truncateToInt(min(mulAdd(toFloat(root), scale, F(0.5f)), F(kFull)));
    };
    const I low(0xFFFF);
    const I red = channel(c.redBlue & low), blue = channel(shiftRight<16>(c.redBlue) & low);
    return {red | shiftLeft<16>(blue), channel(c.green & low)};
}

// Returns the PackedColors of rays `lanes`: of the ground where they hit it, through the air, else of the
// sky.
STEREONAV_INLINE I shadePacket(const CasterScene& scene, const CasterView& view, const Rays& rays,
                               const Hits& hits, M lanes) {
    const F x = rays.x * F(static_cast<float>(scene.ground.spacingX));
    const F y = rays.y * F(static_cast<float>(scene.ground.spacingY));
    const M ground = lanes & (hits.t < infinity());
    const M sky = andNot(lanes, ground);
    ColorHalves color{I(0), I(0)};
    if (any(ground)) {
        const F square = mulAdd(x, x, mulAdd(y, y, rays.z * rays.z));
        const F length = square * approxRsqrt(square);
        const F t = select(ground, hits.t, F(1.0f));
        const F level = mipLevel(scene.texture, view, length, t, hits.approach);
        color =
            textureColor(scene.texture, toFloat(hits.i) + hits.u, toFloat(hits.j) + hits.v, level, ground);
        if (scene.detail.octaves > 0) {
            const F footprint = longerSide(view, length, t, hits.approach);
            const M near = ground & (footprint * F(scene.detail.perMetre) <
                                     F(scene.detail.octave[0].cell / kDetailPixels));
            if (any(near)) {
                const F brighter = scene.detail.relief ? weatheredOf(scene.detail, hits, footprint, near)
                                                       : detailOf(scene.detail, hits, footprint, near);
                color = brightened(color, select(near, brighter, F(0.0f)));
            }
        }
        if (scene.fog.perMetre > 0) {
            color = fogged(scene.fog, color, expMinus(t * length * F(scene.fog.perMetre)));
        }
        if (scene.air.any) {
            // The air is that up to the place seen (EarthBend::wayToPlace).
            F z = rays.z;
            if (view.fall > 0) z = mulAdd(F(static_cast<float>(view.fall)) * mulAdd(x, x, y * y), t, z);
            color = aired(scene.air, view.air, color, x, y, z, length, t);
        }
    }
    I packed = closeColor(color);
    if (any(sky)) packed = select(sky, closeColor(skyColor(scene.sky, x, y, rays.z, sky)), packed);
    return packed;
}

}  // namespace stereonav::STEREONAV_ISA
