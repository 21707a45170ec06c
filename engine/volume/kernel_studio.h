// A sky that the object hides in part, a key light and the lamp (studio_look.h), looked up on a coarse grid.
// skySeenAt() and studioLight() are the oracle. Included by kernels only.
#pragma once

#include "engine/volume/kernel_normal.h"

namespace stereonav::STEREONAV_ISA {

// What surfaces see: of the sky and of the key light, 0..1.
struct SkySeenBy {
    F sky, key;
};

// Both words of a cell, mixed.
struct SkyWords {
    Channels towards, shares;
};
STEREONAV_INLINE SkyWords mix(const SkyWords& a, const SkyWords& b, I t) {
    return {mix(a.towards, b.towards, t), mix(a.shares, b.shares, t)};
}
STEREONAV_INLINE SkyWords skyWords(const StudioData& data, I cell, M m) {
    const IPair words = gatherPair(data.words, shiftLeft<1>(cell), m);
    return {openChannels(words.first), openChannels(words.second)};
}

STEREONAV_INLINE F shareOf(I fourteenBits) {
    return toFloat(fourteenBits & I(0x3FFF)) * F(1.0f / (1023 * 16));
}

// voxel: any finite numbers; n: unit, or shorter.
STEREONAV_INLINE SkySeenBy skySeenBy(const StudioData& data, const V3& voxel, const V3& n, M m) {
    const auto face = [&](int k) {
        return mulAdd(n.x, F(data.face[k][0]), mulAdd(n.y, F(data.face[k][1]), n.z * F(data.face[k][2])));
    };
    const V3 across{face(0), face(1), face(2)};
    const F lift = approxRsqrt(max(dot(across, across), F(1e-12f))) * F(data.lift);
    const auto place = [&](int k, F at, F side) {
        const F cell = mulAdd(side, lift, (at - F(data.offset[k])) * F(data.perVoxel[k]));
        return clamp(cell, F(0.0f), F(static_cast<float>(data.last[k])));
    };
    const V3 at{place(0, voxel.x, across.x), place(1, voxel.y, across.y), place(2, voxel.z, across.z)};
    const auto low = [&](F a, int k) { return min(truncateToInt(a), I(data.last[k] - 1)); };
    const I x = low(at.x, 0), y = low(at.y, 1), z = low(at.z, 2);
    const I first = z * I(data.slice) + y * I(data.row) + x;
    const I u = weightOf(at.x - toFloat(x));
    SkyWords edges[4];
    for (int k = 0; k < 4; ++k) {
        const I cell = first + I((k & 1 ? data.row : 0) + (k & 2 ? data.slice : 0));
        edges[k] = mix(skyWords(data, cell, m), skyWords(data, cell + I(1), m), u);
    }
    const I v = weightOf(at.y - toFloat(y)), w = weightOf(at.z - toFloat(z));
    const SkyWords words = mix(mix(edges[0], edges[1], v), mix(edges[2], edges[3], v), w);
    const F sky = mulAdd(dot(directionOf(words.towards), n), F(0.5f), shareOf(words.shares.xz));
    return {clamp(sky, F(0.0f), F(1.0f)), shareOf(words.shares.y)};
}

}  // namespace stereonav::STEREONAV_ISA
