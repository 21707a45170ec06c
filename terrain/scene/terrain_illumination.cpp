#include "terrain/scene/terrain_illumination.h"

#include <algorithm>

#include "terrain/scene/landmark.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

TerrainIllumination::TerrainIllumination(const Heightfield& ground, const ColorTexture& albedo,
                                         const SkyMap& sky, TerrainLight light, float share,
                                         SimdTarget target)
    : mAlbedo(albedo), mSky(skyRadiance(sky)), mRelight(ground, std::move(light), target), mShare(share) {}

void TerrainIllumination::applyTo(const ColorTexture& albedo, const TerrainLook& look, ColorTexture& lit) {
    const SunAndSky now = sunAndSky(look, mSky);
    relight(now, look.specular > 0);
    mHighlightLight = exposureOf(now) * now.sunThroughAir;
    mRelight.lightTexture(albedo, mBrightness, {exposureOf(now), mShare}, lit);
}

void TerrainIllumination::applyOver(const TerrainLook& look, const ColorTexture& plain,
                                    const std::vector<float>& plainLight, ColorTexture& lit) {
    const SunAndSky now = sunAndSky(look, mSky);
    relight(now, look.specular > 0);
    mHighlightLight = exposureOf(now) * now.sunThroughAir;
    GroundBrightness quotient = mBrightness;
    const float exposure = exposureOf(now);
    const std::size_t count = quotient.planeSize();
    for (int c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < count; ++k) {
            float& q = quotient.planes[c * count + k];
            q = lightQuotient(exposure * q, plainLight[k]);
        }
    mRelight.lightTexture(plain, quotient, {1.0f, mShare}, lit);
}

void TerrainIllumination::relight(const SunAndSky& now, bool withSunShown) {
    if (mCaster && now.toSun != mHiddenFrom) {
        mHidden = mCaster->hidden(now.toSun);
        mHiddenFrom = now.toSun;
    }
    mRelight.relight(now, mBrightness, withSunShown, mCaster ? &mHidden : nullptr);
}

PartLight TerrainIllumination::partLight(const Heightfield& ground, const TerrainLook& look) const {
    const SunAndSky now = sunAndSky(look, mSky);
    PartLight part(ground, light().grid, mBrightness, look, {exposureOf(now), mShare});
    if (mFine) part.takeFiner(mFine, now);
    return part;
}

std::size_t TerrainIllumination::byteCount() const {
    return mAlbedo.byteCount() + mRelight.light().byteCount() + mHidden.size() +
           (mCaster ? mCaster->byteCount() : 0) +
           (mBrightness.planes.size() + mBrightness.sunShown.size()) * sizeof(float);
}

void moveSun(TerrainScene& scene, double azimuth, double elevation) {
    scene.look.sunAzimuth = azimuth;
    scene.look.sunElevation = elevation;
    if (scene.illumination) scene.illumination->apply(scene.look, scene.color);
    if (scene.landmarks) scene.landmarks->setLook(scene.look);
}

}  // namespace stereonav
