// The colours of a terrain that is shown: those it was loaded with, or others in their place, under its baked
// light where there is some. All functions are called between frames.
#pragma once

#include <memory>

#include "engine/image/color_texture.h"
#include "engine/scene/capabilities.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

class GroundColors {
public:
    // terrain and renderer must outlive this object.
    GroundColors(TerrainScene& terrain, TerrainRenderer& renderer);

    // texture: colours that take the place of the loaded ones; null: the loaded ones. painted: whether they
    // are paint in place of the ground's own colours. parts: see TerrainRenderer::showColors().
    void wear(std::shared_ptr<const ColorTexture> texture, bool painted, PartColors parts);
    bool painted() const { return mPainted; }
    // Returns the colours that the terrain was loaded with, or those that took their place.
    std::shared_ptr<const ColorTexture> texture() const;

    SunPlace sun() const { return {mTerrain.look.sunAzimuth, mTerrain.look.sunElevation}; }
    // Turns the sun: updates baked light, and the plain sun's sky and highlights.
    void turnSun(const SunPlace& to);

private:
    TerrainScene& mTerrain;
    TerrainRenderer& mRenderer;
    std::shared_ptr<const ColorTexture> mWorn;  // null: the loaded colours
    ColorTexture mLit;                          // mWorn under baked light
    bool mPainted = false;
};

}  // namespace stereonav
