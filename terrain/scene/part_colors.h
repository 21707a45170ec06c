// Colours for the parts of a tiled ground that are finer than what is in memory of the whole.
#pragma once

#include <functional>

#include "engine/image/color_texture.h"
#include "terrain/ground/heightfield.h"
#include "terrain/scene/ground_recolor.h"

namespace stereonav {

struct TerrainScene;

// Of a part of the ground by its own samples; those within 8 of its edge are not as in the whole. From any
// thread.
using PartColors = std::function<ColorTexture(const Heightfield& part)>;

// As the whole ground is coloured in that paint, under that sun; null where parts have no colours of their
// own: the ground is not tiled, wears a picture, or light that was baked for the whole. scene must outlive
// it, and not move.
PartColors partColorsOf(const TerrainScene& scene, GroundPaint paint, const SunAngles& sun);
// As it was loaded.
PartColors partColorsOf(const TerrainScene& scene);

}  // namespace stereonav
