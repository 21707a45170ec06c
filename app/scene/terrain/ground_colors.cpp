#include "app/scene/terrain/ground_colors.h"

#include <utility>

#include "terrain/scene/ground_recolor.h"
#include "terrain/scene/landmark.h"
#include "terrain/scene/terrain_illumination.h"

namespace stereonav {

GroundColors::GroundColors(TerrainScene& terrain, TerrainRenderer& renderer)
    : mTerrain(terrain),
      mRenderer(renderer),
      mPainted(terrain.colorSource && terrain.colorSource->paint != GroundPaint::None) {}

std::shared_ptr<const ColorTexture> GroundColors::texture() const {
    return mWorn ? mWorn : std::shared_ptr<const ColorTexture>(std::shared_ptr<void>(), &mTerrain.color);
}

void GroundColors::wear(std::shared_ptr<const ColorTexture> texture, bool painted, PartColors parts) {
    // The earlier texture is in use until the renderer has the new one.
    const std::shared_ptr<const ColorTexture> before = std::exchange(mWorn, std::move(texture));
    const ColorTexture litBefore = std::exchange(mLit, ColorTexture());
    mPainted = painted;
    TerrainIllumination* const illumination = mTerrain.illumination.get();
    if (illumination && mWorn) {
        mLit = *mWorn;
        illumination->applyTo(*mWorn, mTerrain.look, mLit);
    } else if (illumination) {
        illumination->apply(mTerrain.look, mTerrain.color);
    }
    mRenderer.showColors(illumination && mWorn ? mLit : *this->texture(), illumination, std::move(parts));
}

void GroundColors::turnSun(const SunPlace& to) {
    if (mTerrain.illumination && mWorn) {
        mTerrain.look.sunAzimuth = to.azimuth;
        mTerrain.look.sunElevation = to.elevation;
        mTerrain.illumination->applyTo(*mWorn, mTerrain.look, mLit);
        if (mTerrain.landmarks) mTerrain.landmarks->setLook(mTerrain.look);
    } else {
        moveSun(mTerrain, to.azimuth, to.elevation);
    }
    mRenderer.sunMoved();
}

}  // namespace stereonav
