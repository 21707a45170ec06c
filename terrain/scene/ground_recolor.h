// The colours of ground that no picture lies on: its own, or those of a paint. The loader makes them, and so
// does who exchanges them later; both make the same.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "terrain/built_in/built_in_terrain.h"
#include "terrain/scene/ground_color.h"

namespace stereonav {

// The generated terrain, in the heights that it was generated with: it has colours of its own.
struct BuiltInOrigin {
    std::uint64_t seed = 1;
    int size = 0;  // samples a side
};

// The sources of the ground's colours, beside the ground itself.
struct GroundColorSource {
    TerrainLook look;                       // the look that the scene was loaded with
    bool alone = false;                     // without the sun's light: whoever shows them lights them
    double verticalScale = 1;               // heights over those of the file
    GroundPaint paint = GroundPaint::None;  // the paint that the scene was loaded with
    std::optional<BuiltInOrigin> builtIn;
    TintPlace tint;
};

// Takes what was lit out of the words for colours, where somebody else lights them.
void leaveOutLit(std::string& source);

// Returns the generated terrain under a look, from the cache where it is there. Throws Error, Cancelled.
BuiltInTerrain builtInUnder(const BuiltInOrigin& origin, const TerrainLook& look, bool alone,
                            Progress& progress);
// Lays the colours of the generated terrain over its ground.
GroundColor colorsOfBuiltIn(const Heightfield& ground, const BuiltInTerrain& built);

// A place of the sun.
struct SunAngles {
    double azimuth = 0, elevation = 0;  // radians, TerrainLook's
    bool operator==(const SunAngles&) const = default;
};
// Returns whether ground in that paint is to be made again where the sun turns.
bool turnsWithSun(GroundPaint paint, const GroundColorSource& source);
// Returns the colours in that paint. sun: for the paint; the ground's own colours are under that of
// source.look. Throws Error, Cancelled.
GroundColor groundColorsAs(GroundPaint paint, const Heightfield& ground, const GroundColorSource& source,
                           const SunAngles& sun, Progress& progress);

// Returns the same for a part of the ground, coarser or finer than that, with a texel a sample each way: as
// much as can be made while one flies towards it. Not for ground that was generated in colours of its own.
ColorTexture colorsOfPart(const Heightfield& part, const Heightfield& whole, GroundPaint paint,
                          const GroundColorSource& source, const SunAngles& sun);

}  // namespace stereonav
