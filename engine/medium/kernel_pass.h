// A tile of the light's buffer passes a slab (V8 of docs/volume_light.md): first what is there is packed for
// the eyes, then scattered light is spread and both are weakened. In grids, direct light passes a chunk of
// slabs at once and leaves behind where in the table it was: slab after slab is too far apart in memory.
// Included by kernels only.
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
STEREONAV_INLINE std::uint32_t* packedAt(const SweepLight& light, int inChunk, int x, int y) {
    return light.packed + 2 * inChunk * light.packedPlane +
           static_cast<std::int64_t>(y + 1) * light.packedStride + x + 1;
}
STEREONAV_INLINE void packDirect(const SweepLight& light, int inChunk, int x, int y, F direct, M lanes) {
    store(packedAt(light, inChunk, x, y), inFifteenBits(direct), lanes);
}
// Direct light is there.
STEREONAV_INLINE void packIndirect(const SweepLight& light, int inChunk, int x, int y, const F (&indirect)[3],
                                   M lanes) {
    std::uint32_t* first = packedAt(light, inChunk, x, y);
    store(first, loadI(first) | shiftLeft<16>(inFifteenBits(indirect[0])), lanes);
    store(first + light.packedPlane, inFifteenBits(indirect[1]) | shiftLeft<16>(inFifteenBits(indirect[2])),
          lanes);
}

STEREONAV_INLINE F weakened(F light, F depth) {
    const F left = light * decayOf(depth).passes;
    return select(left < F(kNothing), F(0.0f), left);
}

// Where nothing is: scattered light is spread.
STEREONAV_INLINE void spreadRow(const SweepLight& light, const LightPass& pass, int x, TexelRow& row, F way,
                                F size, M crossed, F (&indirect)[3]) {
    const F offset = F(light.blur) / max(size, F(1e-30f));
    row.offsetSquare = way * offset * offset;
    row.column = laneIndex() + I(x);
    row.slab = pass.slab;
    for (int k = 0; k < 3; ++k)
        indirect[k] = select(crossed, blurred(light, pass.before[k], row, crossed), indirect[k]);
}

// Patches of 4 x kLanes / 4 texels: what lies near in the buffer lies near in the grid.
constexpr int kPatchRows = kLanes / 4;
struct Patch {
    int x, y, width, height;  // texels of it that are in the buffer
};
template <typename T>
STEREONAV_INLINE void storePatch(T* to, std::int64_t stride, const T* numbers, const Patch& patch) {
    for (int row = 0; row < patch.height; ++row)
        if (patch.width == 4)
            __builtin_memcpy(to + row * stride, numbers + 4 * row, 4 * sizeof(T));
        else
            for (int column = 0; column < patch.width; ++column)
                to[row * stride + column] = numbers[4 * row + column];
}
STEREONAV_INLINE F loadPatch(const float* from, std::int64_t stride) {
    float numbers[kLanes];
    for (int row = 0; row < kPatchRows; ++row)
        for (int column = 0; column < 4; ++column) numbers[4 * row + column] = from[row * stride + column];
    return loadF(numbers);
}

// A patch through the slabs of a chunk: direct light, which needs no neighbours, and where in the table it
// was.
STEREONAV_INLINE void findTexels(const SweepScene& scene, const LightColumns& at, const Patch& patch) {
    const SweepLight& light = scene.light;
    const SweepTable& table = scene.grid.table;
    const F zero(0.0f), none(-1.0f);
    const I lane = laneIndex();
    const F u = toFloat(lane & I(3)) + F(static_cast<float>(patch.x) + 0.5f),
            v = toFloat(shiftRight<2>(lane)) + F(static_cast<float>(patch.y) + 0.5f);
    const M lanes = (u < F(static_cast<float>(light.width))) & (v < F(static_cast<float>(light.height)));
    float* direct = light.direct + static_cast<std::int64_t>(patch.y) * light.stride + patch.x;
    F left = loadPatch(direct, light.stride);
    float numbers[kLanes];
    std::uint32_t words[kLanes];
    const int strip = (patch.y - at.y0) / LightTile::kStrip;
    for (int n = 0; n < at.count; ++n) {
        if (!(at.strips[n] >> strip & 1u)) continue;
        store(words, inFifteenBits(left));
        storePatch(packedAt(light, n, patch.x, patch.y), light.packedStride, words, patch);
        const TexelPlaces texels = texelPlaces(light, static_cast<float>(at.middle[n]), u, v);
        const V3 voxel = voxelOf(scene.grid, texels.place);
        const M in = lanes & texels.valid & insideGrid(scene.grid, voxel);
        F column = none;
        if (any(in)) {
            const Column place = columnOf(table, gridValue(scene.grid, voxel, in));
            const F extinction = entryOf(table.extinction, place.entry, place.share, in);
            const M there = in & (extinction > zero);
            if (any(there)) {
                column = select(there, toFloat(place.entry) + place.share, none);
                left = select(there, weakened(left, extinction * F(at.thickness[n]) * texels.length), left);
            }
        }
        store(numbers, column);
        storePatch(at.columns + n * at.next + (patch.y - at.y0) * LightTile::kSide + patch.x - at.x0,
                   LightTile::kSide, numbers, patch);
    }
    store(numbers, left);
    storePatch(direct, light.stride, numbers, patch);
}
inline void findColumns(const SweepScene& scene, const LightColumns& at) {
    const int right = at.x0 + LightTile::kSide, below = at.y0 + LightTile::kSide;
    for (int y = at.y0; y < below && y < scene.light.height; y += kPatchRows)
        for (int x = at.x0; x < right && x < scene.light.width; x += 4) {
            const int width = scene.light.width - x, height = scene.light.height - y;
            if (width >= 4 && height >= kPatchRows)
                findTexels(scene, at, {x, y, 4, kPatchRows});
            else
                findTexels(scene, at,
                           {x, y, width < 4 ? width : 4, height < kPatchRows ? height : kPatchRows});
        }
}

// What weakens scattered light: optical depths of a metre along the axis. Without columns direct light passes
// here too. Gives the lanes where something is.
template <bool kIndirect, bool kGridAlone>
STEREONAV_INLINE M passedThere(const SweepScene& scene, const LightTile& tile, const TexelPlaces& at, int x,
                               int y, F way, M crossed, Properties& p) {
    if constexpr (kGridAlone) {
        const F column = loadF(tile.columns + (y - tile.y0) * LightTile::kSide + x - tile.x0);
        const M there = crossed & (column >= F(0.0f));
        if (!any(there)) return there;
        const F place = max(column, F(0.0f));
        const I entry = min(truncateToInt(place), I(SweepTable::kColumns - 2));
        readIndirectAlone(scene.grid.table, {entry, place - toFloat(entry), I(0), F(0.0f)}, there, p);
        return there;
    } else {
        const SweepLight& light = scene.light;
        sampleAny(scene, at.place, at.size, crossed, p);
        const M there = crossed & (p.extinction > F(0.0f));
        float* direct = light.direct + static_cast<std::int64_t>(y) * light.stride + x;
        if (any(there)) store(direct, weakened(loadF(direct), p.extinction * way), there);
        return there;
    }
}

// A packet of texels from (x, y) on; gives the lanes whose scattered light differs from 1.
template <bool kIndirect, bool kGridAlone>
STEREONAV_INLINE M passTexels(const SweepScene& scene, const LightPass& pass, const LightTile& tile, int x,
                              int y, bool sample) {
    const SweepLight& light = scene.light;
    const M lanes = firstLanes(light.width - x);
    TexelRow row;
    row.index = static_cast<std::int64_t>(y) * light.stride + x;
    row.x = laneIndexF() + F(static_cast<float>(x) + 0.5f);
    row.y = F(static_cast<float>(y) + 0.5f);
    row.line = I(y);
    const TexelPlaces at = texelPlaces(light, static_cast<float>(pass.middle), row.x, row.y);
    const M crossed = lanes & at.valid;
    const F way = F(pass.thickness) * at.length;
    F indirect[3];
    if constexpr (kIndirect)
        for (int k = 0; k < 3; ++k) indirect[k] = loadF(pass.before[k] + row.index);
    if (sample) {
        if constexpr (!kGridAlone)
            packDirect(light, pass.inChunk, x, y, loadF(light.direct + row.index), lanes);
        if constexpr (kIndirect) packIndirect(light, pass.inChunk, x, y, indirect, lanes);
    }
    if constexpr (kIndirect) spreadRow(light, pass, x, row, way, at.size, crossed, indirect);
    if (sample) {
        Properties p;
        const M there = passedThere<kIndirect, kGridAlone>(scene, tile, at, x, y, way, crossed, p);
        if (kIndirect && any(there))
            for (int k = 0; k < 3; ++k)
                indirect[k] = select(there, weakened(indirect[k], p.indirect[k] * way), indirect[k]);
    }
    M changed = maskFromBits(0);
    if constexpr (kIndirect)
        for (int k = 0; k < 3; ++k) {
            store(pass.after[k] + row.index, indirect[k], lanes);
            changed = changed | (lanes & (indirect[k] < F(1.0f)));
        }
    return changed;
}

template <bool kIndirect, bool kGridAlone>
bool passTile(const SweepScene& scene, const LightPass& pass, const LightTile& tile) {
    const SweepLight& light = scene.light;
    M changed = maskFromBits(0);
    for (int line = 0; line < LightTile::kSide && tile.y0 + line < light.height; ++line) {
        const bool sample = tile.strips >> line / LightTile::kStrip & 1u;
        if (!kIndirect && !sample) continue;
        for (int x = tile.x0; x < tile.x0 + LightTile::kSide && x < light.width; x += kLanes)
            changed =
                changed | passTexels<kIndirect, kGridAlone>(scene, pass, tile, x, tile.y0 + line, sample);
    }
    return any(changed);
}

}  // namespace stereonav::STEREONAV_ISA
