// Normals from the corners of cells, of the side that the eye sees. Included by kernels only.
//
// Flesh may be thinner than a voxel: masks have septa of one. Then a corner is in the middle of it, and its
// own normal leads to the one side or the other, or nowhere. The trilinear values themselves know the side:
// they rise along a ray where it meets the surface first. Where a cell's corners do not agree their normals
// count by how far they follow the slope of the values, turned around where they are against it. plainNormal
// is the oracle.
#pragma once

#include "engine/volume/kernel_cell.h"

namespace stereonav::STEREONAV_ISA {

// A normal as three channels of 10 bits, spread so that all three can be mixed in 16-bit halves, with four
// more bits of fraction.
struct Channels {
    I xz, y;
};
STEREONAV_INLINE Channels openChannels(I packed) {
    return {(shiftLeft<4>(packed) & I(0x3FF0)) | (packed & I(0x3FF00000)), shiftRight<6>(packed) & I(0x3FF0)};
}
STEREONAV_INLINE I closeChannels(Channels c) {
    const I x = shiftRight<4>(c.xz + I(8)) & I(0x3FF);
    const I y = shiftLeft<6>(c.y + I(8)) & I(0xFFC00);
    return x | y | ((c.xz + I(0x80000)) & I(0x3FF00000));
}
STEREONAV_INLINE Channels mix(Channels a, Channels b, I t) {
    return {lerpHalves(a.xz, b.xz, t), lerpHalves(a.y, b.y, t)};
}
// Returns a weight, 0 to 1, for lerpHalves in both halves.
STEREONAV_INLINE I weightOf(F t) {
    const I w = truncateToInt(min(t, F(0.99996f)) * F(32768.0f));
    return w | shiftLeft<16>(w);
}

// Return channels of 14 bits as -1..1; fourteenBits() and channelsOf() do the reverse.
STEREONAV_INLINE F signedChannel(I fourteenBits) {
    return mulAdd(toFloat(fourteenBits & I(0x3FFF)), F(1.0f / (511.5f * 16)), F(-1.0f));
}
STEREONAV_INLINE V3 directionOf(Channels c) {
    return {signedChannel(c.xz), signedChannel(c.y), signedChannel(shiftRight<16>(c.xz))};
}

STEREONAV_INLINE I fourteenBits(F signedValue) {
    return truncateToInt(
        mulAdd(clamp(signedValue, F(-1.0f), F(1.0f)), F(511.5f * 16), F(511.5f * 16 + 0.5f)));
}
STEREONAV_INLINE Channels channelsOf(const V3& unit) {
    return {fourteenBits(unit.x) | shiftLeft<16>(fourteenBits(unit.z)), fourteenBits(unit.y)};
}

// The packed normals of a cell's corners: pairs along x, by y + 2 z.
struct CornerNormals {
    IPair pairs[4];
    // word: Places::word.
    STEREONAV_INLINE CornerNormals(const CellData& cells, I word, M m) {
        const M dense = cells.normals ? m & isDense(word) : maskFromBits(0);
        const bool all = !any(dense);
        const M sparse = andNot(m, dense);
        for (int n = 0; n < 4; ++n) {
            pairs[n] = gatherPair(cells.records + 4 + 2 * n, word, sparse);
            if (all) continue;
            const IPair corner = gatherPair(cells.normals + (n & 1 ? kSide : 0) + (n & 2 ? kSide * kSide : 0),
                                            word & I(kNotDense), dense);
            pairs[n] = {select(dense, corner.first, pairs[n].first),
                        select(dense, corner.second, pairs[n].second)};
        }
    }
};

// Returns the direction towards smaller values at a place in a cell, unit world; 0 where the values are all
// the same.
STEREONAV_INLINE V3 downOf(const CellData& cells, const Corners& c, const V3& p) {
    const auto along = [&](int k, F s, F t, int a, int b) {
        const F low = lerp(c.v[k] - c.v[0], c.v[a + k] - c.v[a], s);
        const F high = lerp(c.v[b + k] - c.v[b], c.v[a + b + k] - c.v[a + b], s);
        return lerp(low, high, t);
    };
    const F x = along(1, p.y, p.z, 2, 4), y = along(2, p.x, p.z, 1, 4), z = along(4, p.x, p.y, 1, 2);
    const auto world = [&](int k) {
        return mulAdd(x, F(cells.downX[k]), mulAdd(y, F(cells.downY[k]), z * F(cells.downZ[k])));
    };
    const V3 down{world(0), world(1), world(2)};
    const F square = dot(down, down);
    const F inverse = select(square > F(1e-12f), approxRsqrt(max(square, F(1e-12f))), F(0.0f));
    return {down.x * inverse, down.y * inverse, down.z * inverse};
}

// Returns the lanes' normals where the corners do not agree; agree: how far they do, as kAgree has it. A
// function of its own: seldom needed.
[[gnu::noinline]] inline V3 normalOfSide(const CellData& cells, const CornerNormals& normals,
                                         const Corners& values, const V3& local, const V3& mean, F agree) {
    const F zero(0.0f), one(1.0f), small(kLeastOfSlope);
    const V3 down = downOf(cells, values, local);
    V3 sum{down.x * small, down.y * small, down.z * small};
    for (int n = 0; n < 4; ++n) {
        const IPair ends = normals.pairs[n];
        const F edge = (n & 1 ? local.y : one - local.y) * (n & 2 ? local.z : one - local.z);
        for (int end = 0; end < 2; ++end) {
            const V3 corner = directionOf(openChannels(end ? ends.second : ends.first));
            const F weight = edge * (end ? local.x : one - local.x) * dot(corner, down);
            sum = {mulAdd(weight, corner.x, sum.x), mulAdd(weight, corner.y, sum.y),
                   mulAdd(weight, corner.z, sum.z)};
        }
    }
    // Where nothing tells a side the normal points up.
    sum.z = select(dot(sum, sum) > F(1e-12f), sum.z, one);
    const F agreeing = clamp((agree - F(kApart)) * F(1 / (kAgree - kApart)), zero, one);
    // Not where the mix is of the other side.
    const F share = agreeing * clamp(dot(mean, down) * F(kOtherSide), zero, one);
    const F bySum = (one - share) * approxRsqrt(max(dot(sum, sum), F(1e-12f)));
    const F byMean = share * approxRsqrt(max(dot(mean, mean), F(1e-12f)));
    const V3 normal{mulAdd(sum.x, bySum, mean.x * byMean), mulAdd(sum.y, bySum, mean.y * byMean),
                    mulAdd(sum.z, bySum, mean.z * byMean)};
    const F inverse = approxRsqrt(max(dot(normal, normal), F(1e-12f)));
    return {normal.x * inverse, normal.y * inverse, normal.z * inverse};
}

// Returns the normal at a place in a cell, 0..1: its corners' normals, mixed. valuesOf(): the values at its
// corners.
template <typename ValuesOf>
STEREONAV_INLINE Channels normalAmong(const CellData& cells, const CornerNormals& normals,
                                      const ValuesOf& valuesOf, const V3& local, M m) {
    const I x = weightOf(local.x), y = weightOf(local.y), z = weightOf(local.z), half = weightOf(F(0.5f));
    Channels edges[4], even[4];
    for (int n = 0; n < 4; ++n) {
        const Channels first = openChannels(normals.pairs[n].first),
                       second = openChannels(normals.pairs[n].second);
        edges[n] = mix(first, second, x);
        even[n] = mix(first, second, half);
    }
    const Channels mixed = mix(mix(edges[0], edges[1], y), mix(edges[2], edges[3], y), z);
    const V3 mean = directionOf(mixed),
             flat = directionOf(mix(mix(even[0], even[1], half), mix(even[2], even[3], half), half));
    const F agree = min(dot(flat, flat), dot(mean, mean));
    const M apart = m & (agree < F(kAgree));
    if (!any(apart)) return mixed;
    const Channels turned = channelsOf(normalOfSide(cells, normals, valuesOf(), local, mean, agree));
    return {select(apart, turned.xz, mixed.xz), select(apart, turned.y, mixed.y)};
}

// Returns the same of cells whose corners are not read yet. word: Places::word.
template <typename ValuesOf>
STEREONAV_INLINE Channels normalIn(const CellData& cells, I word, const ValuesOf& valuesOf, const V3& local,
                                   M m) {
    return normalAmong(cells, CornerNormals(cells, word, m), valuesOf, local, m);
}

}  // namespace stereonav::STEREONAV_ISA
