#include "terrain/scene/part_colors.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/base/memory.h"
#include "terrain/scene/terrain_illumination.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {
namespace {

// Texels of a part, as fine as one flies over: a ring of 1000 x 1000 samples has up to 1.4 texels a sample
// each way, one of 300 x 300 up to 4.8. Little of the memory: it is the samples that come first.
double mostTexelsOfPart() {
    constexpr double kMost = 1 << 21, kShare = 1.0 / 64, kBytes = 4 * 4.0 / 3;
    return std::min(kMost, kShare * availableMemory() / kBytes);
}

PartColors picturedParts(const TerrainScene& scene) {
    PartColors colors;
    const glm::dvec2 finest = scene.pictured->picture->density(scene.ground) *
                              scene.tiled->levels->spacing(0) / scene.ground.spacing();
    colors.texelsASample = finest.x * finest.y;
    colors.mostTexels = mostTexelsOfPart();
    colors.make = [&scene, most = colors.mostTexels](const Heightfield& part) {
        return picturedPart(part, scene.ground, *scene.pictured, most);
    };
    return colors;
}

}  // namespace

double PartColors::texels(double samples, int level) const {
    return std::max(samples, std::min(mostTexels, samples * texelsASample * std::ldexp(1.0, 2 * level)));
}

PartColors partColorsOf(const TerrainScene& scene, GroundPaint paint, const SunAngles& sun) {
    if (!scene.tiled) return {};
    if (scene.pictured && paint == GroundPaint::None) return picturedParts(scene);
    if (!scene.colorSource) return {};
    PartColors colors;
    colors.make = [&scene, paint, sun](const Heightfield& part) {
        return colorsOfPart(part, scene.ground, paint, *scene.colorSource, sun);
    };
    return colors;
}

PartColors partColorsOf(const TerrainScene& scene) {
    const GroundPaint paint = scene.colorSource ? scene.colorSource->paint : GroundPaint::None;
    return partColorsOf(scene, paint, {scene.look.sunAzimuth, scene.look.sunElevation});
}

PartColors litParts(const PartColors& colors, const TerrainScene& scene, const TerrainIllumination& light) {
    if (!colors) return {};
    PartColors lit = colors;
    const auto by = std::make_shared<const PartLight>(light.partLight(scene.ground, scene.look));
    lit.bytesMeanwhile += by->bytesASample();
    lit.make = [make = colors.make, by](const Heightfield& part) {
        ColorTexture texture = make(part);
        by->apply(part, texture);
        return texture;
    };
    return lit;
}

}  // namespace stereonav
