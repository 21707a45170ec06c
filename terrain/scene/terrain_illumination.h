// A terrain under baked light: what its scene keeps beside the lit texture so that the sun can move.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "terrain/light/cast_shadow.h"
#include "terrain/light/terrain_relight.h"
#include "terrain/scene/part_light.h"

namespace stereonav {

struct TerrainScene;

class TerrainIllumination {
public:
    // How much of the light's variation is laid over a photo, which holds the light of its own day: half, so
    // that the sun's place is seen without doubling every shadow.
    static constexpr float kPhotoShare = 0.5f;

    // albedo: colours without light; share: TerrainRelight::Display::share.
    TerrainIllumination(const Heightfield& ground, const ColorTexture& albedo, const SkyMap& sky,
                        TerrainLight light, float share, SimdTarget target = SimdTarget::Auto);

    // Writes the colours under the look's sun into `lit`, which has albedo's size.
    void apply(const TerrainLook& look, ColorTexture& lit) { applyTo(mAlbedo, look, lit); }
    // Lights other colours without light; `lit` has their size.
    void applyTo(const ColorTexture& albedo, const TerrainLook& look, ColorTexture& lit);

    // Lights colours `plain` by light that was baked at some samples alone. They are lit by a plain light
    // already, which is known at all samples: what is baked is laid over it as the quotient of both at the
    // baked samples, so that what lies between them keeps its shades. plainLight: by baked sample, the mean
    // of the samples around it.
    void applyOver(const TerrainLook& look, const ColorTexture& plain, const std::vector<float>& plainLight,
                   ColorTexture& lit);

    // Lets the ground cast the sun's shadow from the next apply() on, for light without horizons.
    void castShadowsOf(const Heightfield& ground) { mCaster.emplace(ground, light().grid); }
    bool castsShadows() const { return mCaster.has_value(); }
    // Takes openness at the same samples, which is shown after the next apply().
    void takeOpenness(std::vector<std::uint8_t> openness) { mRelight.takeOpenness(std::move(openness)); }

    // Takes light that was baked at finer samples, as a part of this: for parts of the ground. Null: there is
    // none.
    void takeFiner(std::shared_ptr<const FineLight> fine) { mFine = std::move(fine); }
    const FineLight* finer() const { return mFine.get(); }
    // Returns the light of the last apply(), for parts of the ground that are finer than it.
    PartLight partLight(const Heightfield& ground, const TerrainLook& look) const;

    // Returns the share of their strength that the sun's highlights have after the last apply(), by colour,
    // as the ground's own light is shown: 1 with the sun 45 degrees high. It does not know of shadows.
    const glm::vec3& highlightLight() const { return mHighlightLight; }
    // Returns the share of the sun's disc that is seen from the ground at a grid coordinate, 0..1. For a look
    // with highlights; 1 where no horizons were baked.
    float sunShownAt(const glm::dvec2& grid) const { return mRelight.sunShownAt(mBrightness, grid); }

    const TerrainLight& light() const { return mRelight.light(); }
    const ColorTexture& albedo() const { return mAlbedo; }              // does not change
    const GroundBrightness& brightness() const { return mBrightness; }  // after the last apply()
    std::size_t byteCount() const;

private:
    void relight(const SunAndSky& now, bool withSunShown);

    ColorTexture mAlbedo;
    SkyRadiance mSky;
    TerrainRelight mRelight;
    GroundBrightness mBrightness;
    glm::vec3 mHighlightLight{1.0f};  // shares, by colour
    float mShare;
    std::optional<ShadowCaster> mCaster;  // none: shadows are baked, or there are none
    std::vector<std::uint8_t> mHidden;    // what it says under mHiddenFrom
    glm::dvec3 mHiddenFrom{0.0};          // unit, to the sun
    std::shared_ptr<const FineLight> mFine;
};

// Turns the sun (radians, clockwise from north; above the horizon) of a scene under baked light: its ground
// and landmarks; renderers are told by TerrainRenderer::sunMoved(). No one may read the scene meanwhile.
void moveSun(TerrainScene& scene, double azimuth, double elevation);

}  // namespace stereonav
