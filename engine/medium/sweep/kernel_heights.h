// Heights of a layer for packets (HeightLayer::heightAt in float). What the lanes have in common is found
// once: the mip level, its size, whether heights change at all. Included by kernels only.
#pragma once

#include "engine/medium/sweep/sweep_kernel_types.h"
#include "engine/volume/kernel_light.h"

namespace stereonav::STEREONAV_ISA {

// Returns metres above the layer's base; NaN where unknown. u, v: samples of level 0. Lanes may have
// different levels; samples with weight 0 are ignored.
[[gnu::noinline]] inline F heightInAny(const SweepLayer& layer, F u, F v, I level, M m) {
    const F zero(0.0f), one(1.0f), half(0.5f);
    const F perSize = asFloat(shiftLeft<23>(I(127) - level));
    const I width = gather(layer.width, level, m), height = gather(layer.height, level, m);
    const F x = clamp(mulAdd(u + half, perSize, -half), zero, toFloat(width - I(1)));
    const F y = clamp(mulAdd(v + half, perSize, -half), zero, toFloat(height - I(1)));
    const I i = truncateToInt(x), j = truncateToInt(y);
    const F s = x - toFloat(i), t = y - toFloat(j);
    const I first = gather(layer.start, level, m) + j * width + i;
    F sum = zero;
    for (int corner = 0; corner < 4; ++corner) {
        const F weight = (corner & 1 ? s : one - s) * (corner & 2 ? t : one - t);
        const M counts = m & (weight > zero);
        const I index = first + (corner & 1 ? I(1) : I(0)) + (corner & 2 ? width : I(0));
        sum = sum + select(counts, weight * gather(layer.heights, index, counts, zero), zero);
    }
    return sum;
}
// Returns the same for lanes with one level without holes: neighbours along x come from one load. In a level
// one sample wide the second of them is an unrelated number with weight 0.
STEREONAV_INLINE F heightIn(const SweepLayer& layer, F u, F v, int level, M m) {
    const F zero(0.0f), half(0.5f);
    const int width = static_cast<int>(layer.width[level]), height = static_cast<int>(layer.height[level]);
    const F perSize = asFloat(I((127 - level) << 23));
    const F x = clamp(mulAdd(u + half, perSize, -half), zero, F(static_cast<float>(width - 1)));
    const F y = clamp(mulAdd(v + half, perSize, -half), zero, F(static_cast<float>(height - 1)));
    const I i = min(truncateToInt(x), I(width > 1 ? width - 2 : 0)),
            j = min(truncateToInt(y), I(height > 1 ? height - 2 : 0));
    const float* row = layer.heights + layer.start[level];
    const float* next = row + (height > 1 ? width : 0);
    const I index = j * I(width) + i;
    const FPair below = gatherPair(row, index, m), above = gatherPair(next, index, m);
    const F s = x - toFloat(i), t = y - toFloat(j);
    return lerp(lerp(below.first, below.second, s), lerp(above.first, above.second, s), t);
}
STEREONAV_INLINE int firstOf(I a, M m) {
    std::int32_t lanes[kLanes];
    store(lanes, a);
    return lanes[__builtin_ctz(bits(m))];
}
// Returns heights interpolated between the levels for the footprint, for lanes m, at least one. size:
// footprint in samples.
[[gnu::noinline]] inline F heightOfFootprint(const SweepLayer& layer, F u, F v, F size, M m) {
    const F zero(0.0f), one(1.0f), coarsest(static_cast<float>(layer.levels - 1));
    const F level = select(size > one, min(log2(max(size, one)), coarsest), zero);
    const I fine = truncateToInt(level);
    const F share = level - toFloat(fine);
    const M between = m & (share > zero);
    const int first = firstOf(fine, m);
    if (layer.holes || any(m & ~(fine == I(first)))) {
        const F height = heightInAny(layer, u, v, fine, m);
        if (!any(between)) return height;
        return select(between, lerp(height, heightInAny(layer, u, v, fine + I(1), between), share), height);
    }
    const F height = heightIn(layer, u, v, first, m);
    if (!any(between)) return height;
    return lerp(height, heightIn(layer, u, v, first + 1, between), share);
}
// Returns heights at places; NaN beyond the edge and where unknown. footprint: metres.
[[gnu::noinline]] inline F heightAt(const SweepLayer& layer, const V3& place, F footprint, M m) {
    const F zero(0.0f), none(__builtin_nanf(""));
    const F u = mulAdd(place.x, F(layer.perMetre), F(layer.zero[0])),
            v = mulAdd(place.y, F(layer.perMetre), F(layer.zero[1]));
    const M in = m & (u >= zero) & (v >= zero) & (u <= F(static_cast<float>(layer.width[0]) - 1)) &
                 (v <= F(static_cast<float>(layer.height[0]) - 1));
    if (layer.flat) return select(in, F(layer.heights[0]), none);
    if (!any(in)) return none;
    const F size = footprint * F(layer.perMetre);
    if (!layer.holes && !any(in & (size > F(1.0f)))) return select(in, heightIn(layer, u, v, 0, in), none);
    return select(in, heightOfFootprint(layer, u, v, size, in), none);
}

}  // namespace stereonav::STEREONAV_ISA
