// Makes the ground's texture from a function that gives the colour at each place.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/base/progress.h"
#include "engine/image/color_texture.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

constexpr double kMostGroundTexels = 1 << 26;  // texels: 256 MiB, a third more with the mip levels
constexpr double kLitDensity = 2.0;            // texels per sample in each direction where light is baked in

struct GroundTextureSize {
    int width, height;  // texels
};

// Returns the size at `density` texels per sample, reduced so that it is at most kMostGroundTexels.
GroundTextureSize groundTextureSize(const Heightfield& ground, glm::dvec2 density);

// Returns the linear colour at column and row (0 northernmost) and at the grid position of a texel's centre.
using GroundColorAt = std::function<glm::vec3(int column, int row, const glm::dvec2& grid)>;
// Makes a texture over the extent of the samples' squares: half a sample beyond the outermost ones. Throws
// Cancelled.
ColorTexture groundTexture(const Heightfield& ground, const GroundTextureSize& size,
                           const GroundColorAt& colorAt, Progress& progress);

}  // namespace stereonav
