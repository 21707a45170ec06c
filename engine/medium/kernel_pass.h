// A tile of the light's buffer passes a slab (V8 of docs/volume_light.md): first what is there is packed for
// the eyes, then scattered light is spread and both are weakened. Included by kernels only.
#pragma once

#include "engine/medium/kernel_arriving.h"
#include "engine/medium/kernel_eye.h"

namespace stereonav::STEREONAV_ISA {

// Texels' rays in the middle of a slab.
struct TexelPlaces {
    V3 place;
    F length;  // of way for one along the axis
    F size;    // of a texel there, metres
    M valid;
};
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
    if (light.parallel) {  // from the fan's plane on
        const F way = (F(middle) - asideAxis) * F(light.length);
        p.place = {mulAdd(way, F(light.forward[0]), aside.x), mulAdd(way, F(light.forward[1]), aside.y),
                   mulAdd(way, F(light.forward[2]), aside.z)};
        p.length = F(light.length);
        p.size = F(light.perX);
        p.valid = zero < F(1.0f);
        return p;
    }
    const V3 d{aside.x + F(light.forward[0]), aside.y + F(light.forward[1]), aside.z + F(light.forward[2])};
    const F c = asideAxis + F(light.axis[2]), length = lengthOf(d);
    p.valid = c > F(1e-4f) * length;
    const F per = F(1.0f) / select(p.valid, c, F(1.0f)), depth = (F(middle) - F(light.start)) * per;
    p.place = {mulAdd(depth, d.x, F(light.origin[0])), mulAdd(depth, d.y, F(light.origin[1])),
               mulAdd(depth, d.z, F(light.origin[2]))};
    p.length = length * per;
    p.size = depth * F(light.perX);
    p.valid = p.valid & (depth > zero);
    return p;
}

// sin and cos of 0 .. pi / 2, errors below 4e-6.
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
// As tapTurn().
STEREONAV_INLINE F turnOf(I x, I y, int slab) {
    I h = (x * wholeNumber(0x8da6b343u)) ^ (y * wholeNumber(0xd8163841u)) ^
          wholeNumber(static_cast<std::uint32_t>(slab) * 0xcb1ab31fu);
    h = (h ^ logicalRight<16>(h)) * wholeNumber(0x7feb352du);
    h = (h ^ logicalRight<15>(h)) * wholeNumber(0x846ca68bu);
    h = h ^ logicalRight<16>(h);
    return toFloat(logicalRight<8>(h)) * F(1.57079633f / 16777216);
}

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

// Row of texels: everything of a packet that does not depend on the plane.
struct TexelRow {
    std::int64_t index;  // of the first texel in a plane
    F x, y;              // centres
    F offsetSquare;      // of the blur, in texels
    I column, line;
    int slab;
};
// The sum of four taps on a circle.
[[gnu::noinline]] inline F circleTaps(const SweepLight& light, const float* plane, const TexelRow& row, M m) {
    const F radius = sqrt(max(min(row.offsetSquare, F(1e12f)) - F(1.0f / 3), F(1.0f)));
    const Turn turn = turnBy(turnOf(row.column, row.line, row.slab));
    const F c = radius * turn.cosine, s = radius * turn.sine;
    return (readPlane(light, plane, row.x + c, row.y + s, m) +
            readPlane(light, plane, row.x - s, row.y + c, m)) +
           (readPlane(light, plane, row.x - c, row.y - s, m) +
            readPlane(light, plane, row.x + s, row.y - c, m));
}
STEREONAV_INLINE F blurred(const SweepLight& light, const float* plane, const TexelRow& row, M m) {
    const float* p = plane + row.index;
    const F here = loadF(p), quarter(0.25f), one(1.0f), wideFrom(4.0f / 3);
    const F share = min(row.offsetSquare, one);
    F four = (loadF(p - 1) + loadF(p + 1)) + (loadF(p - light.stride) + loadF(p + light.stride));
    const M wide = m & (row.offsetSquare > wideFrom);
    if (any(wide)) four = select(wide, circleTaps(light, plane, row, wide), four);
    return mulAdd(share * quarter, four, here - share * here);
}

STEREONAV_INLINE I inFifteenBits(F v) {
    return truncateToInt(mulAdd(v, F(32767.0f), F(0.5f)));
}
template <bool kIndirect>
STEREONAV_INLINE void packTexels(const SweepLight& light, const LightPass& pass, int x, int y, F direct,
                                 const F (&indirect)[3], M lanes) {
    std::uint32_t* first = light.packed + 2 * pass.inChunk * light.packedPlane +
                           static_cast<std::int64_t>(y + 1) * light.packedStride + x + 1;
    if constexpr (!kIndirect) {
        store(first, inFifteenBits(direct), lanes);
    } else {
        store(first, inFifteenBits(direct) | shiftLeft<16>(inFifteenBits(indirect[0])), lanes);
        store(first + light.packedPlane,
              inFifteenBits(indirect[1]) | shiftLeft<16>(inFifteenBits(indirect[2])), lanes);
    }
}

template <bool kGridAlone>
STEREONAV_INLINE void sampleLight(const SweepScene& scene, const TexelPlaces& at, bool indirect, M m,
                                  Properties& p) {
    if constexpr (kGridAlone) {
        const V3 v = voxelOf(scene.grid, at.place);
        const M in = m & insideGrid(scene.grid, v);
        const F zero(0.0f);
        p.extinction = p.indirect[0] = p.indirect[1] = p.indirect[2] = zero;
        if (!any(in)) return;
        const SweepTable& table = scene.grid.table;
        const Column column = columnOf(table, gridValue(scene.grid, v, in));
        p.extinction = entryOf(table.extinction, column.entry, column.share, in);
        const M seen = in & (p.extinction > zero);
        if (indirect && any(seen)) readIndirect(table, column, seen, p);
    } else {
        sampleAny(scene, at.place, at.size, m, p);
    }
}

STEREONAV_INLINE F weakened(F light, F depth) {
    const F left = light * decayOf(depth).passes;
    return select(left < F(kNothing), F(0.0f), left);
}

template <bool kIndirect, bool kGridAlone>
bool passTile(const SweepScene& scene, const LightPass& pass, const LightTile& tile) {
    const SweepLight& light = scene.light;
    const float middle = static_cast<float>(pass.middle);
    M changed = maskFromBits(0);
    const int yEnd = tile.y0 + LightTile::kSide < light.height ? tile.y0 + LightTile::kSide : light.height;
    for (int y = tile.y0; y < yEnd; ++y)
        for (int x = tile.x0; x < tile.x0 + LightTile::kSide && x < light.width; x += kLanes) {
            const M lanes = firstLanes(light.width - x);
            const I column = laneIndex() + I(x);
            TexelRow row;
            row.index = static_cast<std::int64_t>(y) * light.stride + x;
            row.x = toFloat(column) + F(0.5f);
            row.y = F(static_cast<float>(y) + 0.5f);
            const TexelPlaces at = texelPlaces(light, middle, row.x, row.y);
            F direct = loadF(light.direct + row.index), indirect[3];
            if constexpr (kIndirect)
                for (int k = 0; k < 3; ++k) indirect[k] = loadF(pass.before[k] + row.index);
            if (tile.sample) packTexels<kIndirect>(light, pass, x, y, direct, indirect, lanes);
            const M crossed = lanes & at.valid;
            const F way = F(pass.thickness) * at.length;
            if constexpr (kIndirect) {
                const F offset = F(light.blur) / max(at.size, F(1e-30f));
                row.offsetSquare = way * offset * offset;
                row.column = column;
                row.line = I(y);
                row.slab = pass.slab;
                for (int k = 0; k < 3; ++k)
                    indirect[k] = select(crossed, blurred(light, pass.before[k], row, crossed), indirect[k]);
            }
            if (tile.sample) {
                Properties p;
                sampleLight<kGridAlone>(scene, at, kIndirect, crossed, p);
                const M there = crossed & (p.extinction > F(0.0f));
                if (any(there)) {
                    direct = select(there, weakened(direct, p.extinction * way), direct);
                    if constexpr (kIndirect)
                        for (int k = 0; k < 3; ++k)
                            indirect[k] =
                                select(there, weakened(indirect[k], p.indirect[k] * way), indirect[k]);
                }
                store(light.direct + row.index, direct, lanes);
            }
            if constexpr (kIndirect)
                for (int k = 0; k < 3; ++k) {
                    store(pass.after[k] + row.index, indirect[k], lanes);
                    changed = changed | (lanes & (indirect[k] < F(1.0f)));
                }
        }
    return any(changed);
}

}  // namespace stereonav::STEREONAV_ISA
