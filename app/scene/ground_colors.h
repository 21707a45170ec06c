// Which colours a terrain that is shown has: those that it was loaded with, or others in their place, under
// its baked light where it has some. All is called between frames.
#pragma once

#include <memory>

#include "engine/image/color_texture.h"
#include "engine/scene/capabilities.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

class GroundColors {
public:
    // terrain, renderer: outlive it.
    GroundColors(TerrainScene& terrain, TerrainRenderer& renderer);

    // texture: as a scene would be loaded with it, null: as this one was. painted: it is paint in the place
    // of the ground's own colours. parts: as TerrainRenderer::showColors() has them.
    void wear(std::shared_ptr<const ColorTexture> texture, bool painted, PartColors parts);
    bool painted() const { return mPainted; }
    // What the terrain was loaded with, or what it wears.
    std::shared_ptr<const ColorTexture> texture() const;

    SunPlace sun() const { return {mTerrain.look.sunAzimuth, mTerrain.look.sunElevation}; }
    // Baked light follows; and the plain sun's sky and highlights.
    void turnSun(const SunPlace& to);

private:
    TerrainScene& mTerrain;
    TerrainRenderer& mRenderer;
    std::shared_ptr<const ColorTexture> mWorn;  // null: as loaded
    ColorTexture mLit;                          // what is worn, under baked light
    bool mPainted = false;
};

}  // namespace stereonav
