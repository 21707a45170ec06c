// Baked light on the parts of a tiled ground that are finer than the samples of the bake.
#pragma once

#include <algorithm>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "engine/image/color_texture.h"
#include "engine/image/plane.h"
#include "terrain/ground/heightfield.h"
#include "terrain/light/terrain_light.h"
#include "terrain/light/terrain_relight.h"
#include "terrain/read/scene_file.h"
#include "terrain/scene/fine_light.h"

namespace stereonav {

// Limits for the quotient of baked light and plain light at the same place, both linear. Smaller plain light
// counts as the first, since a quotient of two dark places means nothing; larger quotients than the second
// come from the sun's edge at a single sample.
constexpr float kDarkestPlainLight = 0.05f, kLargestLightQuotient = 2.5f;
inline float lightQuotient(float baked, float plain) {
    return std::min(baked / std::max(plain, kDarkestPlainLight), kLargestLightQuotient);
}

// Light of parts for one position of the sun. Baked light is applied as a quotient over the plain light of
// the part's own samples:
//     baked / plain at the baked samples, interpolated, times plain at the texel,
// so that the finer relief keeps its shades, and ground that is no finer has exactly the baked light.
// Immutable: parts may be lit from any thread while the sun moves on.
class PartLight {
public:
    // whole: ground whose light was baked, at the samples of the grid. shown: exposure and share for
    // TerrainRelight.
    PartLight(const Heightfield& whole, const LightGrid& grid, const GroundBrightness& brightness,
              const TerrainLook& look, const TerrainRelight::Display& shown);

    // Takes light at finer samples under the same sun and sky, which replaces the coarser light where it
    // exists.
    void takeFiner(std::shared_ptr<const FineLight> fine, const SunAndSky& now);

    // Lights the colours of a part, which must be without light. Throws Error where finer light can not be
    // read.
    void apply(const Heightfield& part, ColorTexture& colors) const;
    // Returns the bytes per sample of a part that apply() takes while it runs.
    double bytesASample() const { return mFine ? sizeof(glm::vec3) : 0; }

private:
    // Quotients at the samples of a level, from `low` on.
    struct FineQuotients {
        int level = 0;
        glm::ivec2 low{0};
        Plane<glm::vec3> quotients;
    };
    glm::vec3 quotientAt(const glm::dvec2& world) const;
    glm::vec3 quotientAt(const FineQuotients& fine, const glm::dvec2& world) const;
    std::optional<FineQuotients> finerOver(const Heightfield& part, const ColorTexture& colors) const;
    void takeTile(const LightTiles::Tile& tile, FineQuotients& fine) const;

    LightGrid mGrid;
    TerrainLook mLook;
    TerrainRelight::Display mShown;
    glm::dvec2 mOrigin, mSpacing;            // grid of the whole ground: world, metres
    std::vector<float> mQuotients;           // three planes of the grid
    std::shared_ptr<const FineLight> mFine;  // null: there is no finer light
    SunAndSky mNow;                          // sun and sky for the finer light
};

}  // namespace stereonav
