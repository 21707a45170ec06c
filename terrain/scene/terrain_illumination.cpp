#include "terrain/scene/terrain_illumination.h"

#include "terrain/scene/landmark.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

TerrainIllumination::TerrainIllumination(const Heightfield& ground, const ColorTexture& albedo,
                                         const SkyMap& sky, TerrainLight light, float share,
                                         SimdTarget target)
    : mAlbedo(albedo), mSky(skyRadiance(sky)), mRelight(ground, std::move(light), target), mShare(share) {}

void TerrainIllumination::apply(const TerrainLook& look, ColorTexture& lit) {
    const SunAndSky now = sunAndSky(look, mSky);
    mRelight.relight(now, mBrightness, look.specular > 0);
    mHighlightLight = exposureOf(now) * now.sunThroughAir;
    mRelight.lightTexture(mAlbedo, mBrightness, {exposureOf(now), mShare}, lit);
}

std::size_t TerrainIllumination::byteCount() const {
    return mAlbedo.byteCount() + mRelight.light().byteCount() +
           (mBrightness.planes.size() + mBrightness.sunShown.size()) * sizeof(float);
}

void moveSun(TerrainScene& scene, double azimuth, double elevation) {
    scene.look.sunAzimuth = azimuth;
    scene.look.sunElevation = elevation;
    if (scene.illumination) scene.illumination->apply(scene.look, scene.color);
    if (scene.landmarks) scene.landmarks->setLook(scene.look);
}

}  // namespace stereonav
