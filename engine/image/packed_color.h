// The colour of one pixel or texel in 32 bits: three channels of 10 bits, each the square root of a
// linear RGB value in [0, 1] (gamma 2). r is in bits 0..9, g in 10..19, b in 20..29; bits 30 and 31
// are zero. The layout is OpenGL's UNSIGNED_INT_2_10_10_10_REV. Square roots spend the bits where
// the eye needs them: a step is finer than four tenths of an 8-bit sRGB step everywhere.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

namespace stereonav {

using PackedColor = std::uint32_t;

// linear: any values; below 0 and NaN become 0, above 1 become 1.
inline PackedColor packColor(const glm::vec3& linear) {
    const auto channel = [](float v) -> std::uint32_t {
        if (!(v > 0.0f)) return 0u;
        return v >= 1.0f ? 1023u : static_cast<std::uint32_t>(std::sqrt(v) * 1023.0f + 0.5f);
    };
    return channel(linear.x) | channel(linear.y) << 10 | channel(linear.z) << 20;
}

// Returns linear RGB, each in [0, 1].
inline glm::vec3 unpackColor(PackedColor c) {
    constexpr float kScale = 1.0f / 1023.0f;
    const glm::vec3 root(static_cast<float>(c & 1023u) * kScale, static_cast<float>(c >> 10 & 1023u) * kScale,
                         static_cast<float>(c >> 20 & 1023u) * kScale);
    return root * root;
}

// Transfer functions of IEC 61966-2-1, from and to [0, 1].
float linearFromSrgb(float encoded);
float srgbFromLinear(float linear);

// The sRGB byte of each packed channel (0..1023), rounded to nearest; for files and displays.
const std::array<std::uint8_t, 1024>& srgbByteFromPacked();
// The packed channel (0..1023) of each sRGB byte.
const std::array<std::uint16_t, 256>& packedFromSrgbByte();

}  // namespace stereonav
