// Casts rays at a terrain for any view: the engine's interface to a terrain scene.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "engine/render/eye_renderer.h"
#include "engine/simd/simd_target.h"
#include "terrain/cast/caster_types.h"
#include "terrain/ground/ground_rings.h"
#include "terrain/scene/part_colors.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

class Fog;  // terrain/light/fog.h

// How the ground's colour texture is read; values other than these defaults are for comparisons.
struct GroundFilter {
    bool mipLevels = true;  // false: the finest level alone
    double levelBias = 0;   // levels coarser (above 0) or finer than for the ray's footprint, -8 to 8
};

// Hits equal those of the plain cell walk (plain_caster.h), at any height of the ground, for eyes up to 4,000
// spacings away from it; from 400,000 spacings away one ray in a thousand misses a tip or an edge.
class TerrainRenderer final : public EyeRenderer {
public:
    // scene must outlive this object.
    explicit TerrainRenderer(const TerrainScene& scene, SimdTarget target = SimdTarget::Auto,
                             const GroundFilter& filter = {});
    ~TerrainRenderer() override;

    // Lets pictures take the ground from coarser samples where their error is at most this share of a pixel
    // (terrain/ground/ground_rings.h); 0: only from the ground's own samples. At first it is the scene's
    // share. Not to be called while a picture is cast.
    void takeCoarser(double share);
    // Returns the rings that are cast in the next pictures; null: the ground itself.
    const GroundRings* rings() const;
    // Sets whether pictures are made without waiting for tiles that are not read yet;
    // TerrainScene::ringsMayBeLate at first. Not to be called while a picture is cast.
    void ringsMayBeLate(bool may);
    // Returns a counter of late tiles that have become ready, from any thread.
    std::uint64_t arrivals() const;
    // The share of a pixel that rings keep to, and whether finer ones are being made.
    struct Detail {
        double share = 0;  // share of a pixel; 0: there are no rings
        bool late = false;
    };
    Detail ringDetail() const;

    using EyeRenderer::lookFrom;
    void lookFrom(const EyeView& left, const EyeView& right) const override;
    int tileCount(const EyeView& view) const override;
    void renderTile(const EyeView& view, int tile, EyeImage& image) const override;
    void renderPixels(const EyeView& view, PixelRect bounds, std::span<const PixelIndex> pixels,
                      EyeImage& image) const override;
    void renderMoreRays(const EyeView& view, const EyeView& known, const Plane<float>& depths,
                        PixelRect bounds, std::span<const PixelIndex> pixels, EyeImage& image) const override;
    bool mayHitBeyondEdge(const EyeView& view, PixelRect rect, double column,
                          double parallaxScale) const override;
    bool mayHitBeyondEdgeFrom(const EyeView& view, PixelRect rect, double column, double parallaxScale,
                              double& freeDepth) const override;
    ViewDependence viewDependence() const override;
    void shadeAgain(const EyeView& view, int y, int x0, int x1, EyeImage& image) const override;

    bool airDiffers(double separation) const override;
    void changeAir(const EyeView& from, const EyeView& view, int y, EyeImage& image) const override;

    // Colours rows y0 to y1 - 1 of an upright view from the depths in image.viewDepth, which another caster
    // has found, so that casters can be compared with the same shading.
    void shadeRows(const EyeView& view, int y0, int y1, EyeImage& image) const;

    // Updates highlights and air after the scene's look has changed (moveSun()). Not to be called while a
    // picture is cast.
    void sunMoved();
    // Shows the ground in these colours from now on, instead of the scene's own. light: the baked light in
    // them; null: the plain sun, or none. Both must live until others are set. Not to be called while a
    // picture is cast. parts: colours for rings of a tiled ground that are finer than `lit`; null: colours of
    // the whole ground.
    void showColors(const ColorTexture& lit, const TerrainIllumination* light, PartColors parts = {});

    // Returns the present fog over the ground; it lives as long as the renderer, and changes with sunMoved().
    const Fog& fog() const;
    SimdTarget target() const;  // what Auto became
    const TerrainScene& scene() const { return mScene; }
    std::size_t byteCount() const;  // without the scene: pyramid of heights, detail, coarser levels

private:
    struct State;
    // Returns whether a picture stores what is needed to shade again. Its base colours are then without fog,
    // since each eye sees the fog through its own distances.
    bool keepsBase(const EyeImage& image) const { return viewDependent() && !image.normal.empty(); }
    // Adds what the kernels do not cast: landmarks, normals, highlights and the fog before them.
    void castSparse(const EyeView& view, const CasterView& caster, std::span<const PixelIndex> pixels,
                    const std::function<float(PixelIndex)>& startOf, EyeImage& image) const;
    void finish(const EyeView& view, std::span<const PixelIndex> pixels, EyeImage& image) const;
    void castLandmarks(const EyeView& view, std::span<const PixelIndex> pixels, EyeImage& image,
                       std::vector<bool>& hit) const;
    // Returns the share of the sun's disc that is visible from a place on the ground; 1 without baked light.
    float sunShownAt(const glm::dvec3& place) const;

    const TerrainScene& mScene;
    std::unique_ptr<State> mState;
};

}  // namespace stereonav
