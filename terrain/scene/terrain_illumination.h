// A terrain under baked light: the data that its scene keeps in addition to the lit texture so that the sun
// can move.
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
    // Share of the light's variation that is applied to a photo, which already contains the light of its day:
    // half, so that the sun's position shows without doubling every shadow.
    static constexpr float kPhotoShare = 0.5f;

    // albedo: colours without light; share: TerrainRelight::Display::share.
    TerrainIllumination(const Heightfield& ground, const ColorTexture& albedo, const SkyMap& sky,
                        TerrainLight light, float share, SimdTarget target = SimdTarget::Auto);

    // Writes the colours under the look's sun into `lit`, which has albedo's size.
    void apply(const TerrainLook& look, ColorTexture& lit) { applyTo(mAlbedo, look, lit); }
    // Lights other colours without light; `lit` has their size.
    void applyTo(const ColorTexture& albedo, const TerrainLook& look, ColorTexture& lit);

    // Lights `plain`, colours that a plain light has lit already, by light that was baked at fewer samples.
    // The quotient of baked and plain light at the baked samples is laid over the colours, so that the shades
    // between those samples stay. plainLight: the plain light at each baked sample, averaged over the samples
    // around it.
    void applyOver(const TerrainLook& look, const ColorTexture& plain, const std::vector<float>& plainLight,
                   ColorTexture& lit);

    // Lets the ground cast the sun's shadow from the next apply() on; for light that was baked without
    // horizons.
    void castShadowsOf(const Heightfield& ground) { mCaster.emplace(ground, light().grid); }
    bool castsShadows() const { return mCaster.has_value(); }
    // Replaces the openness, at the same samples; it shows from the next apply() on.
    void takeOpenness(std::vector<std::uint8_t> openness) { mRelight.takeOpenness(std::move(openness)); }

    // Takes light that was baked at finer samples, for partLight() to hand to parts of the ground. Null:
    // none.
    void takeFiner(std::shared_ptr<const FineLight> fine) { mFine = std::move(fine); }
    const FineLight* finer() const { return mFine.get(); }
    // Returns the light of the last apply(), to light parts of the ground that have finer samples.
    PartLight partLight(const Heightfield& ground, const TerrainLook& look) const;

    // Returns the factor, by colour, on the sun's highlights after the last apply(): 1 with the sun 45
    // degrees high. It has the exposure at which the ground's light is shown, but no shadows.
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
    std::vector<std::uint8_t> mHidden;    // ShadowCaster::hidden() for mHiddenFrom
    glm::dvec3 mHiddenFrom{0.0};          // unit vector to the sun that mHidden was made for
    std::shared_ptr<const FineLight> mFine;
};

// Turns the sun (radians, clockwise from north; above the horizon) of a scene under baked light: its ground
// and landmarks; renderers are told by TerrainRenderer::sunMoved(). No one may read the scene meanwhile.
void moveSun(TerrainScene& scene, double azimuth, double elevation);

}  // namespace stereonav
