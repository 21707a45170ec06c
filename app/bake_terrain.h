// `stereonav bake` of a terrain.
#pragma once

#include "app/commands.h"

namespace stereonav {

// What is 0 or empty is the default.
struct TerrainBakeOptions {
    SceneOptions scene;
    std::string what;       // "transfer", "openness"; "": transfer
    int samples = 0;        // rays a baked sample and bounce
    double resolution = 0;  // baked samples a height sample each way, 1 / n; 1 or less
    int order = 0;          // of the harmonics
    int bounces = -1;       // < 0: default
    double albedo = -1;
    std::string out;  // "": in the cache, where `--light auto` looks
};
int bakeTerrain(const TerrainBakeOptions& options);

}  // namespace stereonav
