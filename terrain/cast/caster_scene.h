// Ground and colours as the casting kernels read them.
#pragma once

#include "engine/image/color_texture.h"
#include "terrain/cast/caster_types.h"
#include "terrain/ground/height_pyramid.h"

namespace stereonav {

struct GroundFilter;  // terrain_renderer.h

// Returns a ground as kernels read it; both must outlive that.
GroundData groundData(const Heightfield& ground, const HeightPyramid& pyramid);

// Returns colours as kernels read them, by grid coordinates of a ground of that spacing, metres; `color` must
// outlive that.
TextureData textureData(const ColorTexture& color, const glm::dvec2& spacing, const GroundFilter& filter);

}  // namespace stereonav
