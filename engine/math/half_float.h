// Half floats (IEEE 754 binary16) of either sign, without branches, so that loops over them become vector
// code.
#pragma once

#include <bit>
#include <cstdint>

namespace stereonav {

constexpr float kLargestHalf = 65504.0f;  // the largest finite one, without unit

// Rounds to nearest, ties to even. Values beyond 65504, infinities and NaN become 65504, never NaN.
inline std::uint16_t halfFromFloat(float v) {
    const std::uint32_t sign = std::bit_cast<std::uint32_t>(v) >> 16 & 0x8000u;
    const float positive = std::bit_cast<float>(std::bit_cast<std::uint32_t>(v) & 0x7fffffffu);
    const float size = positive < kLargestHalf ? positive : kLargestHalf;
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(size);
    const std::uint32_t normal = (bits + 0xfffu + (bits >> 13 & 1u) - (112u << 23)) >> 13;
    // Below 2^-14 halves are multiples of 2^-24, like floats from 0.5 on: the addition rounds to them.
    const std::uint32_t tiny = std::bit_cast<std::uint32_t>(size + 0.5f) - 0x3f000000u;
    return static_cast<std::uint16_t>(sign | (size < 0x1p-14f ? tiny : normal));
}

// Returns the half as a float. Infinities and NaN, which are never written here, would become finite: 65536
// and more.
inline float floatFromHalf(std::uint16_t half) {
    const std::uint32_t size = half & 0x7fffu;
    const float tiny = static_cast<float>(static_cast<std::int32_t>(size)) * 0x1p-24f;
    const float normal = std::bit_cast<float>((size << 13) + (112u << 23));
    const float positive = size < 0x400u ? tiny : normal;
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(positive) | (half & 0x8000u) << 16);
}

}  // namespace stereonav
