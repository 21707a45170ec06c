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
    const std::int16_t* full = nullptr;     // plane n at full + n * planeSize
    const std::int16_t* bounced = nullptr;  // likewise
    std::size_t planeSize = 0;
    int harmonics = 0;                       // 0: openness alone
    const std::uint8_t* openness = nullptr;  // 255: all of the sky
    const std::uint8_t* horizon[2] = {};     // sines times 255, at azimuths before and after the sun's
    const float* normal[3] = {};             // unit: planes x, y, z
    // Light, linear, irradiance / pi; units of the planes are taken in.
    float sky[21][3] = {};
    float sunHarmonics[21] = {};  // for a sun of strength 1
    float level[3] = {};          // the sky's on open level ground, for openness alone
    float sun[3] = {};            // on a surface that faces it
    float toSun[3] = {};          // unit
    float horizonWeight[2] = {};  // weights of the two azimuths' bytes, 1/255 in all
    float inverseSoftness = 1;    // 1 / the sine that the sun's disc spans
    float sunUp = 1;              // share of the disc above the horizontal
    float* sunShown = nullptr;    // where not null: the share of the disc above each sample's horizon
    float* light = nullptr;       // three planes of `lightPlane` floats: red, green, blue
    std::size_t lightPlane = 0;
};

// One row of texels: colours times light.
struct LitTexels {
    int width = 0;
    const std::uint32_t* albedo = nullptr;  // texels as PackedColor
    const float* root[3] = {};              // square roots of the factor by baked sample
    const std::int32_t* sample = nullptr;   // by texel: the sample before it
    const float* next = nullptr;            // likewise: the share of the one after, 0 to 1
    std::uint32_t* lit = nullptr;           // out: PackedColor
};

// One instruction set's kernels.
struct RelightKernels {
    const char* name;
    void (*relight)(const RelightRow&);
    // Sets roots[c][i] = sqrt(factor) for the mix of two rows of light, linear: 1 + share * (exposure * light
    // - 1). weight: of the northern row, 0 to 1.
    void (*mixRows)(const float* const south[3], const float* const north[3], float weight, int count,
                    float exposure, float share, float* const roots[3]);
    void (*lightTexels)(const LitTexels&);
};

STEREONAV_EACH_SET(extern const RelightKernels kRelightKernels;)

}  // namespace stereonav
