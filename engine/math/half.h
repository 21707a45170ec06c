// IEEE half floats for storage, converted without the instructions that not every processor has. Rounds to
// nearest, ties to even; no branches, so that loops over it vectorise.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

namespace stereonav {

constexpr float kLargestHalf = 65504.0f;

// Beyond the largest: the largest; infinities and NaN: 0.
constexpr std::uint16_t halfFromFloat(float value) {
    const std::uint32_t sign = std::bit_cast<std::uint32_t>(value) >> 16 & 0x8000u;
    const float positive = value < 0.0f ? -value : value;
    const float finite = positive <= std::numeric_limits<float>::max() ? positive : 0.0f;
    const float v = finite < kLargestHalf ? finite : kLargestHalf;
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(v);
    const std::uint32_t normal = (bits + 0xfffu + (bits >> 13 & 1u) - (112u << 23)) >> 13;
    // Below 2^-14 halves are multiples of 2^-24, as floats from 0.5 on are: the addition rounds.
    const std::uint32_t tiny = std::bit_cast<std::uint32_t>(v + 0.5f) - 0x3f000000u;
    return static_cast<std::uint16_t>(sign | (v < 0x1p-14f ? tiny : normal));
}

// What would be infinite or NaN becomes 65536 and more: finite, and never written here.
constexpr float floatFromHalf(std::uint16_t half) {
    const std::uint32_t bits = half & 0x7fffu;
    const float tiny = static_cast<float>(static_cast<std::int32_t>(bits)) * 0x1p-24f;
    const float normal = std::bit_cast<float>((bits << 13) + (112u << 23));
    const float positive = bits < 0x400u ? tiny : normal;
    return half & 0x8000u ? -positive : positive;
}

}  // namespace stereonav
