// Light that was baked at finer samples than those of the ground in memory, for one position of the sun.
#pragma once

#include <memory>
#include <vector>

#include "terrain/ground/ground_levels.h"
#include "terrain/light/light_tiles.h"
#include "terrain/light/terrain_relight.h"

namespace stereonav {

class FineLight {
public:
    // levels: of the ground that the light was baked for.
    FineLight(std::shared_ptr<const GroundLevels> levels, LightTiles tiles, SimdTarget target);

    const GroundLevels& levels() const { return *mLevels; }
    const FineLightShape& shape() const { return mTiles.shape(); }
    std::uint64_t byteCount() const { return mTiles.byteCount(); }  // on disk
    // Returns the level whose light has about the spacing of a part with samples `spacing` metres apart;
    // empty where the light of the ground in memory is as fine.
    std::optional<int> levelFor(double spacing) const;

    // A lit tile: its ground, with one more sample on each side where the whole ground has one, and the
    // brightness of the tile's own samples, the first of which is `first` in that ground.
    struct LitTile {
        Heightfield ground;
        glm::ivec2 first{0};
        GroundBrightness brightness;
    };
    // Lights a tile; empty where none of its samples is known. From any thread. Throws Error where it can not
    // be read.
    std::optional<LitTile> lit(const LightTiles::Tile& tile, const SunAndSky& now) const;
    glm::ivec2 size(int level) const { return mTiles.size(level); }  // samples

private:
    std::shared_ptr<const GroundLevels> mLevels;
    LightTiles mTiles;
    SimdTarget mTarget;
};

}  // namespace stereonav
