#include "terrain/scene/ground_recolor.h"

#include <string_view>
#include <utility>

#include "terrain/scene/slope_color.h"

namespace stereonav {

std::optional<GroundPalette> paletteOf(GroundPaint paint) {
    switch (paint) {
        case GroundPaint::Natural:
            return GroundPalette::Natural;
        case GroundPaint::Hypsometric:
            return GroundPalette::Hypsometric;
        case GroundPaint::Swiss:
            return GroundPalette::Swiss;
        case GroundPaint::Grey:
            return GroundPalette::Grey;
        default:
            return std::nullopt;
    }
}

void leaveOutLit(std::string& source) {
    constexpr std::string_view kLit = ", lit";
    if (source.ends_with(kLit)) source.resize(source.size() - kLit.size());
}

BuiltInTerrain builtInUnder(const BuiltInOrigin& origin, const TerrainLook& look, bool alone,
                            Progress& progress) {
    const TerrainLook usual;
    const bool usualSun = look.sunAzimuth == usual.sunAzimuth && look.sunElevation == usual.sunElevation;
    if (usualSun && !alone) return builtInTerrain(origin.seed, origin.size, progress);
    return generateBuiltInTerrain(origin.seed, origin.size, progress,
                                  alone ? std::nullopt : std::optional(look));
}

GroundColor colorsOfBuiltIn(const Heightfield& ground, const BuiltInTerrain& built) {
    const glm::dvec2 cells(ground.width() - 1, ground.height() - 1);
    const Plane<PackedColor>& texels = built.color;
    return {ColorTexture(texels, glm::dvec2(0.0), cells / glm::dvec2(texels.width(), texels.height())),
            "generated, lit", true};
}

bool turnsWithSun(GroundPaint paint, const GroundColorSource& source) {
    const bool lit = !source.alone && source.look.ambient < 1;
    return paint == GroundPaint::Hillshade || (paint != GroundPaint::None && lit);
}

namespace {

TerrainLook lookUnder(const SunAngles& sun, GroundPaint paint, const GroundColorSource& source) {
    TerrainLook look = source.look;
    if (paint != GroundPaint::None) {
        look.sunAzimuth = sun.azimuth;
        look.sunElevation = sun.elevation;
    }
    if (source.alone) look.ambient = 1;
    return look;
}

// The source's tint, in the palette of a paint that is one.
TintPlace tintIn(GroundPaint paint, const GroundColorSource& source) {
    TintPlace tint = source.tint;
    tint.palette = paletteOf(paint).value_or(tint.palette);
    return tint;
}

}  // namespace

GroundColor groundColorsAs(GroundPaint paint, const Heightfield& ground, const GroundColorSource& source,
                           const SunAngles& sun, Progress& progress) {
    const TerrainLook look = lookUnder(sun, paint, source);
    GroundColor color;
    if (paletteOf(paint) || (paint == GroundPaint::None && !source.builtIn))
        color = tintedGround(ground, look, tintIn(paint, source), progress);
    else if (paint == GroundPaint::None)
        color = colorsOfBuiltIn(ground, builtInUnder(*source.builtIn, look, source.alone, progress));
    else
        color = paintedGround(ground, source.verticalScale, paint, look, progress);
    return color;
}

ColorTexture colorsOfPart(const Heightfield& part, const Heightfield& whole, GroundPaint paint,
                          const GroundColorSource& source, const SunAngles& sun) {
    const TerrainLook look = lookUnder(sun, paint, source);
    constexpr double kDensity = 1;
    Progress progress;
    if (paint == GroundPaint::None || paletteOf(paint))
        return tintedPart(part, whole, look, tintIn(paint, source), kDensity, progress);
    return paintedGround(part, source.verticalScale, paint, look, progress, kDensity).texture;
}

}  // namespace stereonav
