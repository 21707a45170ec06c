// The light's pass through grids without layers or noise, where a tile's texels are alike: packets go down
// the tile row by row and keep the rows above, here and below in registers, and values that are the same for
// all texels are found once per tile. Results equal those of passTexels() in kernel_pass.h, which is used for
// lamps, farther taps and leaning slabs. Included by kernels only.
#pragma once

#include "engine/medium/sweep/kernel_blur.h"
#include "engine/medium/sweep/kernel_eye.h"

namespace stereonav::STEREONAV_ISA {

// Returns shares of light, 0 to 1, as 0..32767.
STEREONAV_INLINE I inFifteenBits(F v) {
    return truncateToInt(mulAdd(v, F(32767.0f), F(0.5f)));
}
// Returns the word of a texel among those that eyes read.
STEREONAV_INLINE std::uint32_t* packedAt(const SweepLight& light, int inChunk, int x, int y) {
    return light.packed + 2 * inChunk * light.packedPlane +
           static_cast<std::int64_t>(y + 1) * light.packedStride + x + 1;
}
// Adds scattered light to words that hold direct light already.
STEREONAV_INLINE void packIndirect(std::uint32_t* first, std::int64_t plane, const F (&indirect)[3],
                                   M lanes) {
    store(first, loadI(first) | shiftLeft<16>(inFifteenBits(indirect[0])), lanes);
    store(first + plane, inFifteenBits(indirect[1]) | shiftLeft<16>(inFifteenBits(indirect[2])), lanes);
}

// Returns the light after an optical depth; 0 where less than kNothing is left.
STEREONAV_INLINE F weakened(F light, F depth) {
    const F left = light * decayOf(depth).passes;
    return select(left < F(kNothing), F(0.0f), left);
}
// Weakens three colours of lanes m in the same way; tests once whether any depth is large.
STEREONAV_INLINE void weakenAll(F (&light)[3], const F (&depth)[3], M m) {
    const F limit(0.5f), zero(0.0f);
    F passes[3];
    for (int k = 0; k < 3; ++k) passes[k] = thinlyPassed(min(depth[k], limit));
    const M thick = m & ((depth[0] > limit) | (depth[1] > limit) | (depth[2] > limit));
    if (any(thick))
        for (int k = 0; k < 3; ++k)
            passes[k] = select(depth[k] > limit, exp2(depth[k] * F(-1.44269504f)), passes[k]);
    for (int k = 0; k < 3; ++k) {
        const F left = light[k] * passes[k];
        light[k] = select(m, select(left < F(kNothing), zero, left), light[k]);
    }
}

// Returns the column of the table for places from 0 on.
STEREONAV_INLINE Column columnAt(F place) {
    const I entry = min(truncateToInt(place), I(SweepTable::kColumns - 2));
    return {entry, place - toFloat(entry), I(0), F(0.0f)};
}

// A packet's texels in the rows of a tile, from top to bottom.
struct ColumnRows {
    const float* from[3];  // light before the slab
    float* to[3];          // light after the slab
    F above[3], here[3];
    std::int64_t stride;

    STEREONAV_INLINE ColumnRows(const SweepLight& light, const LightPass& pass, int x, int y)
        : stride(light.stride) {
        const std::int64_t first = y * stride + x;
        for (int k = 0; k < 3; ++k) {
            from[k] = pass.before[k] + first;
            to[k] = pass.after[k] + first;
            above[k] = loadF(from[k] - stride);
            here[k] = loadF(from[k]);
        }
    }
    // Spreads the row to its neighbours and advances, so that `here` becomes the next row. share: 0 to 1;
    // quarter: a fourth of it.
    STEREONAV_INLINE void spread(F share, F quarter, F (&spread)[3]) {
        for (int k = 0; k < 3; ++k) {
            const F below = loadF(from[k] + stride);
            const F four = (loadF(from[k] - 1) + loadF(from[k] + 1)) + (above[k] + below);
            spread[k] = mulAdd(quarter, four, here[k] - share * here[k]);
            above[k] = here[k];
            here[k] = below;
            from[k] += stride;
        }
    }
    STEREONAV_INLINE void keep(const F (&light)[3], M lanes) {
        for (int k = 0; k < 3; ++k) {
            store(to[k], light[k], lanes);
            to[k] += stride;
        }
    }
};

// Returns whether passEvenTile() can pass the tile: parallel light, with taps at the four neighbours.
STEREONAV_INLINE bool passesEvenly(const SweepLight& light, const LightPass& pass) {
    const float offset = light.blur / (light.perX > 1e-30f ? light.perX : 1e-30f);
    return light.parallel && pass.thickness * light.length * offset * offset <= 4.0f / 3;
}
// Passes a tile; returns whether its scattered light differs from 1 afterwards.
inline bool passEvenTile(const SweepScene& scene, const LightPass& pass, const LightTile& tile) {
    const SweepLight& light = scene.light;
    const F way = F(pass.thickness) * F(light.length), one(1.0f), zero(0.0f);
    const F offset = F(light.blur) / max(F(light.perX), F(1e-30f));
    const F share = min(way * offset * offset, one), quarter = share * F(0.25f);
    const int bottom = tile.y0 + LightTile::kSide < light.height ? tile.y0 + LightTile::kSide : light.height;
    M changed = maskFromBits(0);
    for (int x = tile.x0; x < tile.x0 + LightTile::kSide && x < light.width; x += kLanes) {
        const M lanes = firstLanes(light.width - x);
        ColumnRows rows(light, pass, x, tile.y0);
        std::uint32_t* packed = packedAt(light, pass.inChunk, x, tile.y0);
        const float* columns = tile.columns + (x - tile.x0);
        for (int y = tile.y0; y < bottom; ++y, packed += light.packedStride, columns += LightTile::kSide) {
            const bool sample = tile.strips >> (y - tile.y0) / LightTile::kStrip & 1u;
            if (sample) packIndirect(packed, light.packedPlane, rows.here, lanes);
            F indirect[3];
            rows.spread(share, quarter, indirect);
            if (sample) {
                const F column = loadF(columns);
                const M there = lanes & (column >= zero);
                if (any(there)) {
                    Properties p;
                    readIndirectAlone(scene.grid.table, columnAt(max(column, zero)), there, p);
                    const F depths[3] = {p.indirect[0] * way, p.indirect[1] * way, p.indirect[2] * way};
                    weakenAll(indirect, depths, there);
                }
            }
            rows.keep(indirect, lanes);
            changed = changed | (lanes & ((indirect[0] < one) | (indirect[1] < one) | (indirect[2] < one)));
        }
    }
    return any(changed);
}

}  // namespace stereonav::STEREONAV_ISA
