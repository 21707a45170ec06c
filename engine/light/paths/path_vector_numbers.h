// path_numbers.h in vectors, a sample a lane. Included by kernels only.
#pragma once

#include "engine/simd/simd.h"

namespace stereonav::STEREONAV_ISA {

constexpr std::uint32_t kGoldenStep = 0x9e3779b9u;  // equal to path_numbers.h, like the constants below

STEREONAV_INLINE I bitsOf(std::uint32_t x) {
    return I(static_cast<std::int32_t>(x));
}
template <int n>
STEREONAV_INLINE I shiftDown(I a) {  // zeros come in
    return shiftRight<n>(a) & bitsOf(0xffffffffu >> n);
}

STEREONAV_INLINE I mixBits(I x) {
    x = x ^ shiftDown<16>(x);
    x = x * bitsOf(0x7feb352du);
    x = x ^ shiftDown<15>(x);
    x = x * bitsOf(0x846ca68bu);
    return x ^ shiftDown<16>(x);
}

STEREONAV_INLINE I pairKey(I key, std::uint32_t pair) {
    return mixBits(key + bitsOf((pair + 1) * kGoldenStep));
}

template <int n>
STEREONAV_INLINE I swapGroups(I x, std::uint32_t low) {
    return shiftLeft<n>(x & bitsOf(low)) | (shiftRight<n>(x) & bitsOf(low));
}
STEREONAV_INLINE I reverseBits(I x) {
    x = shiftLeft<16>(x) | shiftDown<16>(x);
    x = swapGroups<8>(x, 0x00ff00ffu);
    x = swapGroups<4>(x, 0x0f0f0f0fu);
    x = swapGroups<2>(x, 0x33333333u);
    return swapGroups<1>(x, 0x55555555u);
}

STEREONAV_INLINE I scrambleReversed(I x, I seed) {
    x = x ^ x * bitsOf(0x3d20adeau);
    x = x + seed;
    x = x * (shiftDown<16>(seed) | I(1));
    x = x ^ x * bitsOf(0x05526c56u);
    return x ^ x * bitsOf(0x53a22864u);
}

STEREONAV_INLINE I secondDimensionReversed(I x) {
    x = x ^ shiftDown<16>(x);
    x = x ^ (shiftRight<8>(x) & bitsOf(0x00ff00ffu));
    x = x ^ (shiftRight<4>(x) & bitsOf(0x0f0f0f0fu));
    x = x ^ (shiftRight<2>(x) & bitsOf(0x33333333u));
    return x ^ (shiftRight<1>(x) & bitsOf(0x55555555u));
}

STEREONAV_INLINE F unitNumber(I x) {
    return toFloat(shiftDown<8>(x)) * F(0x1p-24f);
}

struct F2 {
    F x, y;
};

STEREONAV_INLINE F2 independentPair(I key, std::uint32_t pair, I sample) {
    const I first = mixBits(sample ^ pairKey(key, pair));
    return {unitNumber(first), unitNumber(mixBits(first ^ bitsOf(0x68bc21ebu)))};
}

STEREONAV_INLINE F2 sobolPair(I key, std::uint32_t pair, I sample) {
    const I seed = pairKey(key, pair);
    const I index = reverseBits(scrambleReversed(reverseBits(sample), seed));
    const I x = scrambleReversed(index, mixBits(seed ^ bitsOf(0x68bc21ebu)));
    const I y = scrambleReversed(secondDimensionReversed(index), mixBits(seed ^ bitsOf(0x02e5be93u)));
    return {unitNumber(reverseBits(x)), unitNumber(reverseBits(y))};
}

STEREONAV_INLINE F2 numberPair(bool lowDiscrepancy, I key, std::uint32_t pair, I sample) {
    return lowDiscrepancy ? sobolPair(key, pair, sample) : independentPair(key, pair, sample);
}

}  // namespace stereonav::STEREONAV_ISA
