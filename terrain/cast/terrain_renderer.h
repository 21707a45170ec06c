// Casts rays at a terrain for any view: the engine's door into a terrain scene.
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

// How the ground's colour is read; other values than these defaults are for comparing.
struct GroundFilter {
    bool mipLevels = true;  // false: the finest level alone
    double levelBias = 0;   // levels coarser (above 0) or finer than the ray's footprint asks for, -8 to 8
};

// Hits are those of the plain cell walk (plain_caster.h), whatever the height of the ground, for eyes up to
// 4,000 spacings away from it; from 400,000 spacings away a ray in a thousand passes by a tip or an edge.
class TerrainRenderer final : public EyeRenderer {
public:
    // scene must outlive the renderer.
    explicit TerrainRenderer(const TerrainScene& scene, SimdTarget target = SimdTarget::Auto,
                             const GroundFilter& filter = {});
    ~TerrainRenderer() override;

    // From now on a picture takes the ground from coarser samples where they are off by no more than that
    // share of what a pixel covers there (terrain/ground/ground_rings.h); 0: all of it from the ground's own.
    // The scene's own share at first. Not while a picture is cast.
    void takeCoarser(double share);
    // Returns the rings that are cast in the next pictures; null: the ground itself.
    const GroundRings* rings() const;
    // Sets whether pictures do without tiles that are not there yet; TerrainScene::ringsMayBeLate at first.
    // Not while a picture is cast.
    void ringsMayBeLate(bool may);
    // Counts up, from any thread, when tiles that pictures did not wait for are there.
    std::uint64_t arrivals() const;
    // The share of a pixel that rings keep to, and whether finer ones are on their way.
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
    // found: the same shading for comparing casters.
    void shadeRows(const EyeView& view, int y0, int y1, EyeImage& image) const;

    // Makes highlights and the air follow the scene's look, which has changed (moveSun()). Not while a
    // picture is cast.
    void sunMoved();
    // Casts the ground in these colours from now on, in place of the scene's own. light: the baked light in
    // them; null: the plain sun, or none. Both must live until others are shown. Not while a picture is cast.
    // parts: colours of rings of a tiled ground that are finer than it; null: the whole ground's.
    void showColors(const ColorTexture& lit, const TerrainIllumination* light, PartColors parts = {});

    // Returns the fog that the ground is seen through now; lives as long as the renderer, and changes with
    // sunMoved().
    const Fog& fog() const;
    SimdTarget target() const;  // what Auto became
    const TerrainScene& scene() const { return mScene; }
    std::size_t byteCount() const;  // beside the scene: pyramid of heights, detail, coarser levels

private:
    struct State;
    // Returns whether a picture keeps what shading again needs. Its base colours are without the fog then,
    // which each eye sees through its own distances.
    bool keepsBase(const EyeImage& image) const { return viewDependent() && !image.normal.empty(); }
    // Casts what the kernels leave out: landmarks, normals, highlights and the fog before them.
    void castSparse(const EyeView& view, const CasterView& caster, std::span<const PixelIndex> pixels,
                    const std::function<float(PixelIndex)>& startOf, EyeImage& image) const;
    void finish(const EyeView& view, std::span<const PixelIndex> pixels, EyeImage& image) const;
    void castLandmarks(const EyeView& view, std::span<const PixelIndex> pixels, EyeImage& image,
                       std::vector<bool>& hit) const;
    // The share of the sun's disc that is seen at a place on the ground; 1 without baked light.
    float sunShownAt(const glm::dvec3& place) const;

    const TerrainScene& mScene;
    std::unique_ptr<State> mState;
};

}  // namespace stereonav
