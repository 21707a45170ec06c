// 8-bit sRGB levels of packed channels as real numbers. They are not rounded to whole levels: metrics compare
// differences of levels with each other, and rounding would be a large part of the result.
#pragma once

#include <array>

#include "engine/image/packed_color.h"

namespace stereonav {

// The level, 0 to 255, of each packed channel (0..1023).
const std::array<float, 1024>& srgbLevelFromPacked();

inline glm::vec3 srgbLevels(PackedColor color) {
    const auto& level = srgbLevelFromPacked();
    return {level[color & 1023], level[color >> 10 & 1023], level[color >> 20 & 1023]};
}

}  // namespace stereonav
