// The light that `bake` works out, and for which surfaces; what is not given is chosen from the scene.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/options/scene_options.h"
#include "engine/light/bake/bake_sums.h"

namespace stereonav {

// Names of the options that gave the light, for messages.
struct LightWords {
    const char *light = "--light", *probe = "--probe";
};

struct BakeOptions {
    SceneOptions scene;
    Telling telling;
    std::optional<BakeKind> what;  // kind of light; empty: irradiance for volumes, transfer for terrains
    std::optional<int> samples;    // at most one of these three is given
    std::optional<double> error, minutes;
    // Texels a voxel, or baked samples a height sample in memory, along each axis.
    std::optional<double> resolution;
    std::string probe;             // file of a picture of the light from all directions
    std::optional<glm::vec3> sky;  // radiance of a sky that is the same everywhere
    std::vector<LampsAsked> lights;
    std::optional<int> bounces, order;
    std::optional<glm::dvec3> albedo;
    std::optional<ValueRange> isovalues;
    std::optional<double> reach_mm;  // how far rays look for distant light; none: a colon's mean radius
    bool full = false;               // every texel, for any isovalue
    LightWords words;
    std::string out;  // file for the result; "": in the cache
};

}  // namespace stereonav
