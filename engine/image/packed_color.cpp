#include "engine/image/packed_color.h"

#include <algorithm>

namespace stereonav {

float linearFromSrgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float srgbFromLinear(float linear) {
    return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

const std::array<std::uint8_t, 1024>& srgbByteFromPacked() {
    static const auto table = [] {
        std::array<std::uint8_t, 1024> t{};
        for (int i = 0; i < 1024; ++i) {
            const float root = static_cast<float>(i) / 1023.0f;
            t[i] = static_cast<std::uint8_t>(srgbFromLinear(root * root) * 255.0f + 0.5f);
        }
        return t;
    }();
    return table;
}

const std::array<std::uint16_t, 256>& packedFromSrgbByte() {
    static const auto table = [] {
        std::array<std::uint16_t, 256> t{};
        for (int i = 0; i < 256; ++i)
            t[i] = static_cast<std::uint16_t>(
                std::sqrt(linearFromSrgb(static_cast<float>(i) / 255.0f)) * 1023.0f + 0.5f);
        return t;
    }();
    return table;
}

}  // namespace stereonav
