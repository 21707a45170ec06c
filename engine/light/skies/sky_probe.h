// Skies as light probes, for scenes without a picture of one: a clear day (Preetham, Shirley and Smits 1999)
// and an overcast one (CIE standard overcast sky, Moon and Spencer 1942).
#pragma once

#include <glm/vec3.hpp>

#include "engine/light/skies/light_probe.h"

namespace stereonav {

// Parameters of a clear sky. Both skies are scaled so that a white horizontal surface in the open has the
// luminance 1; the proportions of sun, sky and colours stay. Below the horizon is even grey ground lit by
// this sky.
struct ClearSky {
    glm::dvec3 sun{0.35, -0.6, 0.72};  // towards it, of any length; at or above the horizon
    double turbidity = 3.0;  // haze: 2 very clear, 3 clear, 6 hazy, 10 thick; the model holds from 1.8 to 10
    // Includes the sun itself, 0.533 degrees across; false: only the light of the sky.
    bool disc = true;
    double groundAlbedo = 0.2;  // 0..1, linear
    int height = 128;           // rows, even, 2..4096; twice as many columns
};
// Throws Error for values out of these ranges.
LightProbe clearSkyProbe(const ClearSky& sky);

// Returns a sky three times as bright at the zenith as at the horizon. Throws Error as clearSkyProbe() does.
LightProbe overcastSkyProbe(double groundAlbedo = 0.2, int height = 128);

}  // namespace stereonav
