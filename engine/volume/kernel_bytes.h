// Volumes of bytes, 0..255 for 0..1, trilinear between voxels: what opacity is multiplied with, and openness.
// Included by kernels only.
#pragma once

#include "engine/volume/kernel_rays.h"

namespace stereonav::STEREONAV_ISA {

// Returns base[index] and base[index + 1], which may be odd.
STEREONAV_INLINE IPair gatherBytePair(const std::uint8_t* base, I index, M m) {
    const I four = gatherHalves(base, shiftRight<1>(index), m);
    const I from = shiftRight(four, shiftLeft<3>(index & I(1)));
    return {from & I(255), shiftRight<8>(from) & I(255)};
}

// Returns 0..255. first: index of the cell's voxel nearest to the origin; p: place in the cell, 0..1.
STEREONAV_INLINE F bytesAt(const ByteData& data, I first, const V3& p, M m) {
    F edges[4];
    for (int n = 0; n < 4; ++n) {
        const IPair ends =
            gatherBytePair(data.values, first + I((n & 1 ? data.row : 0) + (n & 2 ? data.slice : 0)), m);
        edges[n] = lerp(toFloat(ends.first), toFloat(ends.second), p.x);
    }
    return lerp(lerp(edges[0], edges[1], p.y), lerp(edges[2], edges[3], p.y), p.z);
}

// Returns the same at points in voxel coordinates; beyond the faces the outermost voxels count on.
STEREONAV_INLINE F bytesAt(const ByteData& data, const V3& voxel, M m) {
    const auto low = [&](F at, int axis) { return min(truncateToInt(at), I(data.last[axis] - 1)); };
    const auto within = [&](F at, int axis) {
        return clamp(at, F(0.0f), F(static_cast<float>(data.last[axis])));
    };
    const V3 at{within(voxel.x, 0), within(voxel.y, 1), within(voxel.z, 2)};
    const I x = low(at.x, 0), y = low(at.y, 1), z = low(at.z, 2);
    return bytesAt(data, z * I(data.slice) + y * I(data.row) + x,
                   {at.x - toFloat(x), at.y - toFloat(y), at.z - toFloat(z)}, m);
}

}  // namespace stereonav::STEREONAV_ISA
