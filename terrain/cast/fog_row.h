// A row of pixels that one eye saw through fog, to be changed to what the other eye sees through its own fog;
// in the kernels' form.
#pragma once

#include <cstdint>

#include "engine/simd/kernel_sets.h"

namespace stereonav {

struct FogRow {
    std::uint32_t* color = nullptr;  // a row of PackedColor
    // View depths in metres for the eye that sees the row now; 0: unknown, infinite: sky. Pixels with either
    // stay as they are. Rows may be read up to the end of their last 16 pixels.
    const float* depth = nullptr;
    int width = 0;  // pixels
    // Coordinates along the picture's axes at a view depth of 1 m, in metres: centre of the first pixel, step
    // to the next, and the row.
    float firstX = 0, perX = 0, y = 0;
    float offset[3] = {};  // metres from the eye that saw it to this one: right, up, forward
    float perMetre = 0;    // extinction, 1/metre
    float linear[3] = {};  // the fog's colour, linear, 0 to 1
};

// Largest difference in fog between the eyes; larger ones are clamped to it. The colour behind the fog is
// divided by the fog's transmittance, which magnifies the steps of 10 bits.
constexpr float kMostFogBetweenEyes = 1.5f;  // optical depth

// Changes the colours of a row; one for each instruction set.
using FogRowFunction = void (*)(const FogRow&);
STEREONAV_EACH_SET(void changeFog(const FogRow&);)

}  // namespace stereonav
