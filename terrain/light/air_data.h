// The air of a physical sky (atmosphere.h) as kernels read it: plain structs only. Heights are metres above
// the sea, light is that of a white level surface in the open (irradiance / pi), colours are red, green,
// blue.
#pragma once

namespace stereonav {

// Molecules dim green twice as much and blue five times as much as red: wavelengths 660, 555 and 441 nm, by
// their fourth power. So one exponential serves three colours. Haze is grey.
constexpr float kGreenOfRed = 2, kBlueOfRed = 5;

// The air, and the light in it.
struct AirData {
    bool any = false;
    float seaLevel = 0;             // world height, metres
    float perHeight[2] = {};        // 1/metre: of molecules, of haze, over a scale height
    float molecules = 0, haze = 0;  // extinction at the sea, 1/metre; of molecules red
    float hazeScatters = 0;         // share of the haze's extinction that is scattered
    float sunDepth[2] = {};         // optical depths from the sea to the sun: red of molecules, haze
    float sunlight[3] = {};         // above the air, times pi, linear
    float ambient[3] = {};          // light from everywhere, linear
    float toSun[3] = {};            // unit
    float phaseMolecules = 0, phaseHaze = 0;  // factors of (1 + cos^2), 1/steradian ...
    float hazeTop = 0, hazePerCosine = 0;     // ... and of haze, over (top - perCosine cos)^(3/2)
};

// Values that are the same for all rays of an eye.
struct AirEye {
    float height = 0;                         // metres above the sea, at most kTopOfAir
    float above = 0;                          // metres of the eye above that
    float density[2] = {};                    // molecules, haze: 1 at the sea
    float share[3] = {};                      // share of molecules in the extinction there, by colour
    float sunDepth[2] = {}, sunLeft[2] = {};  // depths to the sun: red of molecules, haze; e^- of them
};

constexpr float kTopOfAir = 40e3f;  // metres; air above it is left out: 0.7 % of the molecules

}  // namespace stereonav
