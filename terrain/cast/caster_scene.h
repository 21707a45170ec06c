// Ground and colours in the form that the casting kernels read.
#pragma once

#include "engine/image/color_texture.h"
#include "terrain/cast/caster_types.h"
#include "terrain/ground/height_pyramid.h"

namespace stereonav {

struct GroundFilter;  // defined in terrain_renderer.h

// Returns a ground in the kernels' form. ground and pyramid must outlive the result.
GroundData groundData(const Heightfield& ground, const HeightPyramid& pyramid);

// Returns colours in the kernels' form, addressed by grid coordinates of a ground. spacing: metres between
// the ground's samples. `color` must outlive the result.
TextureData textureData(const ColorTexture& color, const glm::dvec2& spacing, const GroundFilter& filter);

}  // namespace stereonav
