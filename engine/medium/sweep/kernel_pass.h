// Passes a tile of the light's buffer through a slab (V8 of docs/volume_light.md): the light before the slab
// is packed for the eyes, then scattered light is spread, and both are weakened. In grids, direct light
// passes a chunk of slabs at once and stores its columns in the table, since memory for slab after slab would
// be too far apart. Included by kernels only.
#pragma once

#include "engine/medium/sweep/kernel_columns.h"

namespace stereonav::STEREONAV_ISA {

// Stores direct light of a row, 0 to 1, for the eyes.
STEREONAV_INLINE void packDirect(const SweepLight& light, int inChunk, int x, int y, F direct, M lanes) {
    store(packedAt(light, inChunk, x, y), inFifteenBits(direct), lanes);
}

// Spreads a row of scattered light; used also where the slab is empty. way: metres; size: metres across a
// texel.
template <bool kLeans>
STEREONAV_INLINE void spreadRow(const SweepLight& light, const LightPass& pass, int x, TexelRow& row, F way,
                                F size, M crossed, F (&indirect)[3]) {
    const F offset = F(light.blur) / max(size, F(1e-30f));
    row.offsetSquare = way * offset * offset;
    row.column = laneIndex() + I(x);
    row.slab = pass.slab;
    if constexpr (kLeans) row.lags = lagsOf(light, static_cast<float>(pass.middle), row.x, row.y);
    for (int k = 0; k < 3; ++k)
        indirect[k] =
            select(crossed, blurred(light, pass.before[k], kLeans ? pass.depths[k] : nullptr, row, crossed),
                   indirect[k]);
}

// Patches of 4 x kLanes / 4 texels: texels that are near in the buffer are near in the grid.
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

// The texels' rays in voxel coordinates: voxel + t way, at t from a plane on.
struct PatchRays {
    V3 voxel, way;
    F length;  // TexelPlaces::length
    M valid;   // past the lamp
};
STEREONAV_INLINE PatchRays patchRays(const SweepScene& scene, float plane, F x, F y) {
    const SweepLight& light = scene.light;
    const TexelPlaces at = texelPlaces(light, plane, x, y);
    PatchRays rays;
    rays.voxel = voxelOf(scene.grid, at.place);
    rays.length = at.length;
    rays.valid = at.crosses;
    const auto along = [&](int k) { return dotWith(at.way, scene.grid.fromPlace[k]); };
    rays.way = {along(0), along(1), along(2)};
    return rays;
}

// Takes a patch through the slabs of a chunk: direct light, which needs no neighbours, and the columns of the
// table that it met.
STEREONAV_INLINE void findTexels(const SweepScene& scene, const LightColumns& at, const Patch& patch) {
    const SweepLight& light = scene.light;
    const SweepTable& table = scene.grid.table;
    const F zero(0.0f), none(-1.0f);
    const I lane = laneIndex();
    const F u = toFloat(lane & I(3)) + F(static_cast<float>(patch.x) + 0.5f),
            v = toFloat(shiftRight<2>(lane)) + F(static_cast<float>(patch.y) + 0.5f);
    const M lanes = (u < F(static_cast<float>(light.width))) & (v < F(static_cast<float>(light.height)));
    const PatchRays rays = patchRays(scene, static_cast<float>(at.middle[0]), u, v);
    float* direct = light.direct + static_cast<std::int64_t>(patch.y) * light.stride + patch.x;
    F left = loadPatch(direct, light.stride);
    float numbers[kLanes];
    std::uint32_t words[kLanes];
    const int strip = (patch.y - at.y0) / LightTile::kStrip;
    for (int n = 0; n < at.count; ++n) {
        if (!(at.strips[n] >> strip & 1u)) continue;
        store(words, inFifteenBits(left));
        storePatch(packedAt(light, n, patch.x, patch.y), light.packedStride, words, patch);
        const F t(static_cast<float>(at.middle[n] - at.middle[0]));
        const V3 voxel{mulAdd(t, rays.way.x, rays.voxel.x), mulAdd(t, rays.way.y, rays.voxel.y),
                       mulAdd(t, rays.way.z, rays.voxel.z)};
        const M in = lanes & rays.valid & insideGrid(scene.grid, voxel);
        F column = none;
        if (any(in)) {
            const Column place = columnOf(table, valueNearby(scene.grid, voxel, in));
            const F extinction = TablePlaces(place, in).readOne(table.extinction);
            const M there = in & (extinction > zero);
            if (any(there)) {
                column = select(there, toFloat(place.entry) + place.share, none);
                left = select(there, weakened(left, extinction * F(at.thickness[n]) * rays.length), left);
            }
        }
        store(numbers, column);
        storePatch(at.columns + n * at.next + (patch.y - at.y0) * LightTile::kSide + patch.x - at.x0,
                   LightTile::kSide, numbers, patch);
    }
    store(numbers, left);
    storePatch(direct, light.stride, numbers, patch);
}
// Finds the columns of a tile, patch by patch.
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

// Finds the optical depths per metre along the axis for scattered light. Without stored columns direct light
// passes here too. Returns the lanes where the medium is not empty.
template <bool kIndirect, bool kGridAlone>
STEREONAV_INLINE M passedThere(const SweepScene& scene, const LightTile& tile, const TexelPlaces& at, int x,
                               int y, F way, M crossed, Properties& p) {
    if constexpr (kGridAlone) {
        const F column = loadF(tile.columns + (y - tile.y0) * LightTile::kSide + x - tile.x0);
        const M there = crossed & (column >= F(0.0f));
        if (!any(there)) return there;
        readIndirectAlone(scene.grid.table, columnAt(max(column, F(0.0f))), there, p);
        return there;
    } else {
        const SweepLight& light = scene.light;
        float* direct = light.direct + static_cast<std::int64_t>(y) * light.stride + x;
        sampleAny<false, kIndirect>(scene, at.place, at.size, crossed, p);
        const M there = crossed & (p.extinction > F(0.0f));
        if (any(there)) store(direct, weakened(loadF(direct), p.extinction * way), there);
        return there;
    }
}

// Returns the packet of texels from (x, y) on.
STEREONAV_INLINE TexelRow rowOf(const SweepLight& light, int x, int y) {
    TexelRow row;
    row.index = static_cast<std::int64_t>(y) * light.stride + x;
    row.x = laneIndexF() + F(static_cast<float>(x) + 0.5f);
    row.y = F(static_cast<float>(y) + 0.5f);
    row.line = I(y);
    return row;
}
// Where slabs lean: finds tau_i of the slab before scattered light passes it. Direct light passes here too.
template <bool kGridAlone>
STEREONAV_INLINE void findDepths(const SweepScene& scene, const LightPass& pass, const LightTile& tile, int x,
                                 int y, bool sample) {
    const SweepLight& light = scene.light;
    const M lanes = firstLanes(light.width - x);
    const TexelRow row = rowOf(light, x, y);
    const F zero(0.0f);
    F depths[3] = {zero, zero, zero};
    if (sample) {
        const TexelPlaces at = texelPlaces(light, static_cast<float>(pass.middle), row.x, row.y);
        if constexpr (!kGridAlone)
            packDirect(light, pass.inChunk, x, y, loadF(light.direct + row.index), lanes);
        Properties p;
        const M there = passedThere<true, kGridAlone>(scene, tile, at, x, y, F(pass.thickness) * at.length,
                                                      lanes & at.valid, p);
        if (any(there))
            for (int k = 0; k < 3; ++k) depths[k] = select(there, p.indirect[k], zero);
    }
    for (int k = 0; k < 3; ++k) store(pass.depths[k] + row.index, depths[k], lanes);
}
template <bool kGridAlone>
void findTileDepths(const SweepScene& scene, const LightPass& pass, const LightTile& tile) {
    const SweepLight& light = scene.light;
    for (int line = 0; line < LightTile::kSide && tile.y0 + line < light.height; ++line) {
        const bool sample = tile.strips >> line / LightTile::kStrip & 1u;
        for (int x = tile.x0; x < tile.x0 + LightTile::kSide && x < light.width; x += kLanes)
            findDepths<kGridAlone>(scene, pass, tile, x, tile.y0 + line, sample);
    }
}

// Finds the optical depths for scattered light of a packet. Returns the lanes where the medium is not empty.
template <bool kIndirect, bool kGridAlone, bool kLeans>
STEREONAV_INLINE M depthsThere(const SweepScene& scene, const LightPass& pass, const LightTile& tile,
                               const TexelPlaces& at, int x, int y, F way, M crossed, const F (&indirect)[3],
                               Properties& p) {
    if constexpr (kLeans) {
        const std::int64_t index = static_cast<std::int64_t>(y) * scene.light.stride + x;
        for (int k = 0; k < 3; ++k) p.indirect[k] = loadF(pass.depths[k] + index);
        return crossed & (p.indirect[0] + p.indirect[1] + p.indirect[2] > F(0.0f));
    } else {
        if constexpr (!kGridAlone) {  // lanes without light need not be weakened
            M lit =
                loadF(scene.light.direct + static_cast<std::int64_t>(y) * scene.light.stride + x) > F(0.0f);
            if constexpr (kIndirect)
                for (int k = 0; k < 3; ++k) lit = lit | (indirect[k] > F(0.0f));
            crossed = crossed & lit;
            if (!any(crossed)) return crossed;
        }
        return passedThere<kIndirect, kGridAlone>(scene, tile, at, x, y, way, crossed, p);
    }
}

// Passes a packet of texels from (x, y) on; returns the lanes whose scattered light differs from 1.
template <bool kIndirect, bool kGridAlone, bool kLeans>
STEREONAV_INLINE M passTexels(const SweepScene& scene, const LightPass& pass, const LightTile& tile, int x,
                              int y, bool sample) {
    const SweepLight& light = scene.light;
    const M lanes = firstLanes(light.width - x);
    TexelRow row = rowOf(light, x, y);
    const TexelPlaces at = texelPlaces(light, static_cast<float>(pass.middle), row.x, row.y);
    const M crossed = lanes & at.valid;
    const F way = F(pass.thickness) * at.length;
    F indirect[3];
    if constexpr (kIndirect)
        for (int k = 0; k < 3; ++k) indirect[k] = loadF(pass.before[k] + row.index);
    if (sample) {
        if constexpr (!kGridAlone && !kLeans)
            packDirect(light, pass.inChunk, x, y, loadF(light.direct + row.index), lanes);
        if constexpr (kIndirect)
            packIndirect(packedAt(light, pass.inChunk, x, y), light.packedPlane, indirect, lanes);
    }
    if constexpr (kIndirect) spreadRow<kLeans>(light, pass, x, row, way, at.size, crossed, indirect);
    if (sample) {
        Properties p;
        const M there = depthsThere<kIndirect, kGridAlone, kLeans>(scene, pass, tile, at, x, y, way, crossed,
                                                                   indirect, p);
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

template <bool kIndirect, bool kGridAlone, bool kLeans>
bool passTile(const SweepScene& scene, const LightPass& pass, const LightTile& tile) {
    if constexpr (kGridAlone && !kLeans)
        if (passesEvenly(scene.light, pass)) return passEvenTile(scene, pass, tile);
    const SweepLight& light = scene.light;
    M changed = maskFromBits(0);
    for (int line = 0; line < LightTile::kSide && tile.y0 + line < light.height; ++line) {
        const bool sample = tile.strips >> line / LightTile::kStrip & 1u;
        if (!kIndirect && !sample) continue;
        for (int x = tile.x0; x < tile.x0 + LightTile::kSide && x < light.width; x += kLanes)
            changed = changed |
                      passTexels<kIndirect, kGridAlone, kLeans>(scene, pass, tile, x, tile.y0 + line, sample);
    }
    return any(changed);
}

}  // namespace stereonav::STEREONAV_ISA
