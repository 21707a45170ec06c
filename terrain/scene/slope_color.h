// Colours of the ground by its orientation instead of its tints: slope, aspect, or a hillshade.
//
// slope: nine classes in the sequential scheme YlOrRd of ColorBrewer (Harrower and Brewer 2003), by the
// steepness of the file's heights, central differences as GroundPlace tells it.
// aspect: the scheme of Brewer and Marlow 1993 (Color Representation of Aspect and Slope Simultaneously): a
// hue for each eighth of the compass that the ground falls to, lighter to the north-west, more saturated
// where it is steeper (5, 20 and 40 %), grey where it is nearly level. hillshade: the light of the look's sun
// on a white ground (Lambert) by the differences over eight neighbours of Horn 1981 (Hill Shading and the
// Reflectance Map, equation for p and q), 0 to 1 taken as sRGB, as usual. It is light itself, so no other
// falls on it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/render/paint_legend.h"
#include "terrain/read/scene_file.h"
#include "terrain/scene/ground_color.h"
#include "terrain/scene/ground_texture.h"

namespace stereonav {

// Returns the paint of "slope", "aspect", "hillshade", "natural", "hypsometric", "swiss", "grey"; nothing for
// other words.
std::optional<GroundPaint> groundPaintNamed(const std::string& word);

// Paints the ground. paint: Slope, Aspect or Hillshade. look: its light falls on slope and aspect. density:
// texels a sample each way. Throws Cancelled.
GroundColor paintedGround(const Heightfield& ground, double verticalScale, GroundPaint paint,
                          const TerrainLook& look, Progress& progress, double density = kLitDensity);

// Returns what the colours mean; nothing for others than Slope and Aspect.
Legend legendOfPaint(GroundPaint paint);

// Return the colour for the slope or aspect of the file's heights: linear, without light. gradient: metres
// per metre.
glm::vec3 slopeColor(const glm::dvec2& gradient);
glm::vec3 aspectColor(const glm::dvec2& gradient);
// Returns Horn's differences at a sample, metres per metre; an unknown neighbour counts as equal to the
// sample, and an unknown sample as level.
glm::dvec2 hornGradient(const Heightfield& ground, int i, int j);

}  // namespace stereonav
