// What the relighting kernels read: plain structs and pointers only, since kernels are compiled for wider
// instruction sets and must not share inline code with the rest (see cmake/rooms.cmake).
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/simd/kernel_sets.h"

namespace stereonav {

// One row of baked samples under the present light. Pointers are to the row's first sample.
struct RelightRow {
    int width = 0;
    const std::int16_t* full = nullptr;  // plane n at full + n * planeSize
    const std::int16_t* bounced = nullptr;
    std::size_t planeSize = 0;
    int harmonics = 0;  // 0: openness alone
    const std::uint8_t* openness = nullptr;
    const std::uint8_t* horizon[2] = {};  // azimuths before and after the sun's
    const float* normal[3] = {};
    // Light, units of the planes taken in.
    float sky[21][3] = {};
    float sunHarmonics[21] = {};
    float level[3] = {};  // the sky's, for openness alone
    float sun[3] = {};
    float toSun[3] = {};
    float horizonWeight[2] = {};  // of the two azimuths' bytes
    float inverseSoftness = 1;    // a sine
    float sunUp = 1;              // share of the disc above the horizontal
    float* sunShown = nullptr;    // where not null: the share of the disc above each sample's horizon
    float* light = nullptr;       // three planes of `lightPlane` floats: red, green, blue
    std::size_t lightPlane = 0;
};

// One row of texels: colours times light.
struct LitTexels {
    int width = 0;
    const std::uint32_t* albedo = nullptr;  // as PackedColor
    const float* root[3] = {};              // square roots of the factor by baked sample, of this row
    const std::int32_t* sample = nullptr;   // of each texel: the sample before it
    const float* next = nullptr;            // and the share of the one after
    std::uint32_t* lit = nullptr;
};

struct RelightKernels {
    const char* name;
    void (*relight)(const RelightRow&);
    // roots[c][i] = sqrt(factor) of the mix of two rows of light: 1 + share * (exposure * light - 1).
    void (*mixRows)(const float* const south[3], const float* const north[3], float weight, int count,
                    float exposure, float share, float* const roots[3]);
    void (*lightTexels)(const LitTexels&);
};

STEREONAV_EACH_SET(extern const RelightKernels kRelightKernels;)

}  // namespace stereonav
