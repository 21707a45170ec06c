#include "terrain/scene/part_colors.h"

#include "terrain/scene/terrain_illumination.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

PartColors partColorsOf(const TerrainScene& scene, GroundPaint paint, const SunAngles& sun) {
    if (!scene.tiled || !scene.colorSource || scene.illumination) return {};
    return [&scene, paint, sun](const Heightfield& part) {
        return colorsOfPart(part, scene.ground, paint, *scene.colorSource, sun);
    };
}

PartColors partColorsOf(const TerrainScene& scene) {
    const GroundPaint paint = scene.colorSource ? scene.colorSource->paint : GroundPaint::None;
    return partColorsOf(scene, paint, {scene.look.sunAzimuth, scene.look.sunElevation});
}

}  // namespace stereonav
