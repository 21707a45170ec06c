// Colours for the parts of a tiled ground that are finer than the whole ground in memory.
#pragma once

#include <functional>

#include "engine/image/color_texture.h"
#include "terrain/ground/heightfield.h"
#include "terrain/scene/ground_recolor.h"

namespace stereonav {

struct TerrainScene;
class TerrainIllumination;

// Makes colours of a part of the ground from its own samples; within 8 samples of its edge they differ from
// those of the whole. From any thread. Throws Error where a picture can not be read any more.
struct PartColors {
    std::function<ColorTexture(const Heightfield& part)> make;  // null: parts have no colours of their own
    double texelsASample = 1;    // texels per finest sample: resolution of the picture
    double mostTexels = 0;       // largest number of texels of a part, but at least one per sample
    double bytesMeanwhile = 24;  // bytes per texel while a part is being made

    explicit operator bool() const { return make != nullptr; }
    // Returns the largest number of texels of a part with `samples` samples at that level.
    double texels(double samples, int level) const;
};

// Returns the colours of parts as the whole ground has them in that paint, under that sun; null for ground
// that is not tiled. Under baked light the colours are without light. scene must outlive the result, and not
// move.
PartColors partColorsOf(const TerrainScene& scene, GroundPaint paint, const SunAngles& sun);
// Returns the colours of parts of the ground as loaded.
PartColors partColorsOf(const TerrainScene& scene);

// Returns the same colours, lit by the light that was baked for the whole ground, as of the last apply();
// later changes of the light have no effect.
PartColors litParts(const PartColors& colors, const TerrainScene& scene, const TerrainIllumination& light);

}  // namespace stereonav
