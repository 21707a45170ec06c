// A row of pixels that one eye saw through fog, as the other sees it through its own: what kernels read.
#pragma once

#include <cstdint>

#include "engine/simd/kernel_sets.h"

namespace stereonav {

struct FogRow {
    std::uint32_t* color = nullptr;  // a row of PackedColor
    // Metres along the view, of the eye that sees the row now; 0: nothing is known, infinite: sky. Both stay
    // as they are. Rows may be read up to the end of their last 16 pixels.
    const float* depth = nullptr;
    int width = 0;  // pixels
    // Metres at a view depth of 1 m, along the picture's axes: the first pixel's centre, and from one to the
    // next.
    float firstX = 0, perX = 0, y = 0;
    float offset[3] = {};  // metres from the eye that saw it to this one: right, up, forward
    float perMetre = 0;    // extinction, 1/metre
    float linear[3] = {};  // the fog's colour, linear, 0 to 1
};

// More difference than that counts as so much: the colour behind the fog is divided by what the fog left of
// it, which shows the steps of 10 bits.
constexpr float kMostFogBetweenEyes = 1.5f;  // optical depth

// Changes the colours of a row; one for each instruction set.
using FogRowFunction = void (*)(const FogRow&);
STEREONAV_EACH_SET(void changeFog(const FogRow&);)

}  // namespace stereonav
