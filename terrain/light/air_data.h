// The air of a physical sky (atmosphere.h) as kernels read it: plain structs only. Heights are metres above
// the sea, light is that of a white level surface in the open (irradiance / pi), colours are red, green,
// blue.
#pragma once

namespace stereonav {

// Molecules dim green twice as much and blue five times as much as red: wavelengths 660, 555 and 441 nm, by
// their fourth power. So one exponential serves three colours. Haze is grey.
constexpr float kGreenOfRed = 2, kBlueOfRed = 5;

struct AirData {
    bool any = false;
    float seaLevel = 0;                       // of the world's heights
    float perHeight[2] = {};                  // 1 / scale height: molecules, haze
    float molecules = 0, haze = 0;            // extinction at the sea, per metre; of molecules red
    float hazeScatters = 0;                   // of the haze's extinction, what is scattered
    float sunDepth[2] = {};                   // of the way to the sun from the sea: red of molecules, haze
    float sunlight[3] = {};                   // above the air, times pi
    float ambient[3] = {};                    // light from everywhere
    float toSun[3] = {};                      // unit
    float phaseMolecules = 0, phaseHaze = 0;  // factors of (1 + cos^2) ...
    float hazeTop = 0, hazePerCosine = 0;     // ... and of haze, over (top - perCosine cos)^(3/2)
};

// What is the same for all rays of an eye.
struct AirEye {
    float height = 0;  // above the sea, at most kTopOfAir
    float above = 0;   // metres of the eye above that
    float density[2] = {};
    float share[3] = {};                      // of molecules in the extinction there
    float sunDepth[2] = {}, sunLeft[2] = {};  // towards the sun: red of molecules, haze; and e^- of it
};

constexpr float kTopOfAir = 40e3f;  // air above it is left out: 0.7 % of the molecules

}  // namespace stereonav
