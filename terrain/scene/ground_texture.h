// From a colour for each place of the ground to the texture that it is shown in.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/base/progress.h"
#include "engine/image/color_texture.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

constexpr double kMostGroundTexels = 1 << 26;  // texels: 256 MiB, a third more with the mip levels
constexpr double kLitDensity = 2.0;            // texels a sample each way where light is baked in

struct GroundTextureSize {
    int width, height;  // texels
};

// Returns the size at `density` texels a sample, less where that were more than kMostGroundTexels.
GroundTextureSize groundTextureSize(const Heightfield& ground, glm::dvec2 density);

// Returns the linear colour at column and row (0 northernmost) and at the grid position of a texel's centre.
using GroundColorAt = std::function<glm::vec3(int column, int row, const glm::dvec2& grid)>;
// Makes a texture over the extent of the samples' own squares: half a sample beyond the outer ones. Throws
// Cancelled.
ColorTexture groundTexture(const Heightfield& ground, const GroundTextureSize& size,
                           const GroundColorAt& colorAt, Progress& progress);

}  // namespace stereonav
