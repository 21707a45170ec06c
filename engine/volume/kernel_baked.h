// Baked light looked up at hits: eight texels, weighted by place and by how much each is known (Wyman et al.
// 2006, section 4.2; Y5 of docs/ledger.md). IlluminationVolume::at is the oracle. Included by kernels only.
#pragma once

#include "engine/volume/kernel_rays.h"

namespace stereonav::STEREONAV_ISA {

// Light that is known, finite in all lanes: weights are at most 1, texels at most 65536, the exposure at most
// kMostExposure, and what is divided by is at least kLeastKnown.
struct BakedLight {
    F red, green, blue;  // linear RGB: irradiance / pi times the exposure, of the texels that are known
    F known;  // weight of the known texels, 0..1; less than kLeastKnown counts as 0, kWhollyKnown as 1
};
constexpr float kWhollyKnown = 0.999f;  // weight

// The two texels along an axis: their shares of the index, and the place between them.
struct TexelPair {
    I first, second;
    F between;  // 0 to 1
};
STEREONAV_INLINE TexelPair texelsAt(const TexelGrid& grid, int axis, F voxel) {
    const int last = grid.last[axis];
    const F at =
        clamp((voxel - F(grid.offset[axis])) * F(grid.perVoxel[axis]), F(0.0f), F(static_cast<float>(last)));
    const I low = min(truncateToInt(at), I(last > 0 ? last - 1 : 0));
    const I high = min(low + I(1), I(last));
    const auto index = [&](I i) {
        return shiftRight<3>(i) * I(grid.brickStride[axis]) + (i & I(7)) * I(1 << 3 * axis);
    };
    return {index(low), index(high), at - toFloat(low)};
}

// Returns a half float that is not negative, times 2^-112: as a float's bits.
STEREONAV_INLINE F lowHalf(I word) {
    return asFloat(shiftLeft<13>(word) & I(0x0FFFE000));
}
STEREONAV_INLINE F highHalf(I word) {
    return asFloat(shiftRight<3>(word) & I(0x0FFFE000));
}

// Returns light of the texels that are known, times the factor; lanes outside m: 0. voxel: any numbers.
STEREONAV_INLINE BakedLight texelsAround(const TexelGrid& grid, const V3& voxel, F factor, M m) {
    constexpr float kHalfScale = 0x1p112f;
    // Weights are raised by so much that light of 2^-112 times a small weight is still a normal number.
    constexpr float kRaised = 0x1p56f, kLowered = 0x1p-56f;
    const TexelPair x = texelsAt(grid, 0, voxel.x), y = texelsAt(grid, 1, voxel.y),
                    z = texelsAt(grid, 2, voxel.z);
    const F zero(0.0f), one(1.0f);
    const F below = (one - z.between) * F(kRaised), above = z.between * F(kRaised);
    BakedLight sum{zero, zero, zero, zero};
    for (int corner = 0; corner < 8; ++corner) {
        const bool right = corner & 1, back = corner & 2, top = corner & 4;
        const I index =
            (right ? x.second : x.first) + (back ? y.second : y.first) + (top ? z.second : z.first);
        const F place = (right ? x.between : one - x.between) * (back ? y.between : one - y.between) *
                        (top ? above : below);
        const IPair texel = gatherPair(grid.texels, shiftLeft<1>(index), m);
        const F weight = place * (highHalf(texel.second) * F(kHalfScale));
        sum.red = mulAdd(weight, lowHalf(texel.first), sum.red);
        sum.green = mulAdd(weight, highHalf(texel.first), sum.green);
        sum.blue = mulAdd(weight, lowHalf(texel.second), sum.blue);
        sum.known = sum.known + weight;
    }
    const F known = sum.known * F(kLowered), least(kLeastKnown);
    const F scale = approxReciprocal(max(known, least)) * factor;
    const auto light = [&](F channel) { return channel * F(kHalfScale * kLowered) * scale; };
    return {light(sum.red), light(sum.green), light(sum.blue),
            select(known < least, zero, select(known < F(kWhollyKnown), known, one))};
}

// Mixes in light of BakedData::beyond where `near` is not wholly known. A function of its own: seldom needed,
// and as long as all the rest. What a lane gets does not depend on what the others need.
[[gnu::noinline]] inline BakedLight withBeyond(const BakedData& data, const V3& voxel, const BakedLight& near,
                                               M m) {
    const BakedLight far = texelsAround(data.beyond, voxel, F(data.exposure), m);
    const M wholly = near.known >= F(1.0f);
    const auto mixed = [&](F n, F f) { return select(wholly, n, lerp(f, n, near.known)); };
    return {mixed(near.red, far.red), mixed(near.green, far.green), mixed(near.blue, far.blue), far.known};
}

// Returns light times the exposure. voxel: points in voxel coordinates.
STEREONAV_INLINE BakedLight bakedAt(const BakedData& data, const V3& voxel, M m) {
    const BakedLight near = texelsAround(data, voxel, F(data.exposure), m);
    if (!data.beyond.texels || !any(m & (near.known < F(1.0f)))) return near;
    return withBeyond(data, voxel, near, m);
}

}  // namespace stereonav::STEREONAV_ISA
