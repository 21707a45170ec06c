// Baked light looked up at hits: eight texels, weighted by place and by how much each is known (Wyman et al.
// 2006, section 4.2; Y5). IlluminationVolume::at is the oracle. Included by kernels only.
#pragma once

#include "engine/volume/kernel_rays.h"

namespace stereonav::STEREONAV_ISA {

struct BakedLight {
    F red, green, blue;  // irradiance / pi times the exposure, of the texels that are known
    F known;             // their weight, 0..1
};

// The two texels along an axis: their shares of the index, and the place between them.
struct TexelPair {
    I first, second;
    F between;
};
STEREONAV_INLINE TexelPair texelsAt(const BakedData& data, int axis, F voxel) {
    const int last = data.last[axis];
    const F at =
        clamp((voxel - F(data.offset[axis])) * F(data.perVoxel[axis]), F(0.0f), F(static_cast<float>(last)));
    const I low = min(truncateToInt(at), I(last > 0 ? last - 1 : 0));
    const I high = min(low + I(1), I(last));
    const auto index = [&](I i) {
        return shiftRight<3>(i) * I(data.brickStride[axis]) + (i & I(7)) * I(1 << 3 * axis);
    };
    return {index(low), index(high), at - toFloat(low)};
}

// A half float that is not negative, times 2^-112: as a float's bits.
STEREONAV_INLINE F lowHalf(I word) {
    return asFloat(shiftLeft<13>(word) & I(0x0FFFE000));
}
STEREONAV_INLINE F highHalf(I word) {
    return asFloat(shiftRight<3>(word) & I(0x0FFFE000));
}

// voxel: points in voxel coordinates.
STEREONAV_INLINE BakedLight bakedAt(const BakedData& data, const V3& voxel, M m) {
    constexpr float kHalfScale = 0x1p112f;
    const TexelPair x = texelsAt(data, 0, voxel.x), y = texelsAt(data, 1, voxel.y),
                    z = texelsAt(data, 2, voxel.z);
    const F zero(0.0f), one(1.0f);
    BakedLight sum{zero, zero, zero, zero};
    for (int corner = 0; corner < 8; ++corner) {
        const bool right = corner & 1, back = corner & 2, top = corner & 4;
        const I index =
            (right ? x.second : x.first) + (back ? y.second : y.first) + (top ? z.second : z.first);
        const F place = (right ? x.between : one - x.between) * (back ? y.between : one - y.between) *
                        (top ? z.between : one - z.between);
        const IPair texel = gatherPair(data.texels, shiftLeft<1>(index), m);
        const F weight = place * (highHalf(texel.second) * F(kHalfScale));
        sum.red = mulAdd(weight, lowHalf(texel.first), sum.red);
        sum.green = mulAdd(weight, highHalf(texel.first), sum.green);
        sum.blue = mulAdd(weight, lowHalf(texel.second), sum.blue);
        sum.known = sum.known + weight;
    }
    const F scale = approxReciprocal(max(sum.known, F(1e-6f))) * F(kHalfScale) * F(data.exposure);
    return {sum.red * scale, sum.green * scale, sum.blue * scale, sum.known};
}

}  // namespace stereonav::STEREONAV_ISA
