// A terrain under baked light: what its scene keeps beside the lit texture so that the sun can move.
#pragma once

#include "terrain/terrain_relight.h"

namespace stereonav {

struct TerrainScene;

class TerrainIllumination {
public:
    // How much of the light's variation is laid over a photo, which holds the light of its own day: half, so
    // that the sun's place is seen without doubling every shadow.
    static constexpr float kPhotoShare = 0.5f;

    // albedo: colours without light; share: as TerrainRelight::Display.
    TerrainIllumination(const Heightfield& ground, const ColorTexture& albedo, const SkyMap& sky,
                        TerrainLight light, float share, SimdTarget target = SimdTarget::Auto);

    // Writes the colours under the look's sun into `lit`, which is of albedo's size.
    void apply(const TerrainLook& look, ColorTexture& lit);

    const TerrainLight& light() const { return mRelight.light(); }
    const GroundBrightness& brightness() const { return mBrightness; }  // of the last apply()
    std::size_t byteCount() const;

private:
    ColorTexture mAlbedo;
    SkyRadiance mSky;
    TerrainRelight mRelight;
    GroundBrightness mBrightness;
    float mShare;
};

// Turns the sun (radians, clockwise from north; above the horizon) of a scene under baked light: its ground
// and landmarks; renderers are told by TerrainRenderer::sunMoved(). No one may read the scene meanwhile.
void moveSun(TerrainScene& scene, double azimuth, double elevation);

}  // namespace stereonav
