// Colours for the parts of a tiled ground that are finer than what is in memory of the whole.
#pragma once

#include <functional>

#include "engine/image/color_texture.h"
#include "terrain/ground/heightfield.h"
#include "terrain/scene/ground_recolor.h"

namespace stereonav {

struct TerrainScene;
class TerrainIllumination;

// Colours of a part of the ground by its own samples; those within 8 of its edge are not as in the whole.
// From any thread. Throws Error where a picture can not be read any more.
struct PartColors {
    std::function<ColorTexture(const Heightfield& part)> make;  // null: parts have no colours of their own
    double texelsASample = 1;    // texels a finest sample: what the picture has there
    double mostTexels = 0;       // texels of a part at most; but one for each of its samples
    double bytesMeanwhile = 24;  // bytes a texel, while a part is made

    explicit operator bool() const { return make != nullptr; }
    // Returns the most texels that a part of that level with `samples` samples has.
    double texels(double samples, int level) const;
};

// Returns the colours of parts as the whole ground has them in that paint, under that sun; null where parts
// have no colours of their own: the ground is not tiled. Under baked light they are without light. scene must
// outlive them, and not move.
PartColors partColorsOf(const TerrainScene& scene, GroundPaint paint, const SunAngles& sun);
// Returns the colours of parts of the ground as it was loaded.
PartColors partColorsOf(const TerrainScene& scene);

// Returns the same colours, lit by what was baked for the whole, as it was applied last. Does not change with
// it.
PartColors litParts(const PartColors& colors, const TerrainScene& scene, const TerrainIllumination& light);

}  // namespace stereonav
