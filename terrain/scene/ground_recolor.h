// The colours of ground without a picture: its own, or those of a paint. The loader makes them, and so does
// code that exchanges them later; both get the same colours.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "terrain/built_in/built_in_terrain.h"
#include "terrain/scene/ground_color.h"

namespace stereonav {

// The generated terrain, with the heights that it was generated with: it has colours of its own.
struct BuiltInOrigin {
    std::uint64_t seed = 1;
    int size = 0;  // samples a side
};

// What the ground's colours are made of, in addition to the ground itself.
struct GroundColorSource {
    TerrainLook look;                       // the look that the scene was loaded with
    bool alone = false;                     // colours without the sun's light, for callers that light them
    double verticalScale = 1;               // factor from the file's heights to the ground's
    GroundPaint paint = GroundPaint::None;  // the paint that the scene was loaded with
    std::optional<BuiltInOrigin> builtIn;
    TintPlace tint;
};

// Returns the palette of a paint that is one; nothing for others.
std::optional<GroundPalette> paletteOf(GroundPaint paint);

// Takes what was lit out of the words for colours, where somebody else lights them.
void leaveOutLit(std::string& source);

// Returns the generated terrain under a look, from the cache where possible. Throws Error, Cancelled.
BuiltInTerrain builtInUnder(const BuiltInOrigin& origin, const TerrainLook& look, bool alone,
                            Progress& progress);
// Lays the colours of the generated terrain over its ground.
GroundColor colorsOfBuiltIn(const Heightfield& ground, const BuiltInTerrain& built);

// A position of the sun.
struct SunAngles {
    double azimuth = 0, elevation = 0;  // radians, TerrainLook's
    bool operator==(const SunAngles&) const = default;
};
// Returns whether ground in that paint has to be coloured again when the sun turns.
bool turnsWithSun(GroundPaint paint, const GroundColorSource& source);
// Returns the colours in that paint. sun: for the paint; the ground's own colours are lit by the sun of
// source.look. Throws Error, Cancelled.
GroundColor groundColorsAs(GroundPaint paint, const Heightfield& ground, const GroundColorSource& source,
                           const SunAngles& sun, Progress& progress);

// Returns the same for a part of the ground, coarser or finer than the whole, with one texel per sample in
// each direction: as much as can be made during flight. Not for ground that was generated with colours of its
// own.
ColorTexture colorsOfPart(const Heightfield& part, const Heightfield& whole, GroundPaint paint,
                          const GroundColorSource& source, const SunAngles& sun);

}  // namespace stereonav
