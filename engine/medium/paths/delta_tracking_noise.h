// Bounds of the perturbation within a box of the world at one moment: displacement, and factor on extinction.
// They come from the noise's texels there and are tighter than its amplitude.
#pragma once

#include <vector>

#include "engine/medium/model/medium.h"

namespace stereonav {

struct NoiseBounds {
    glm::dvec3 low{0.0}, high{0.0};          // displacement, metres, world axes
    double leastFactor = 1, mostFactor = 1;  // on extinction
};

// Bounds the noise within the box at `time` seconds. noise: null without a perturbation.
NoiseBounds boundNoise(const Perturbation& perturbation, const NoiseVolume* noise, const WorldBox& box,
                       double time);

}  // namespace stereonav
