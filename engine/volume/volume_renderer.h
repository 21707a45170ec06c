// Casts rays at the isosurface of a volume, or composites what is translucent: the engine's door into CT.
#pragma once

#include <memory>

#include "engine/render/eye_renderer.h"
#include "engine/simd/simd_target.h"
#include "engine/volume/volume_scene.h"

namespace stereonav {

// How a volume is cast.
struct VolumeCasting {
    SimdTarget target = SimdTarget::Auto;
    bool leaping = true;      // false: cell by cell; the same hits, slower
    bool shadeAgain = true;   // keep normals and shade again for the other eye
    double stepVoxels = 0.5;  // translucent: distance of samples, in the smallest spacing
    // Cosine by which an opaque surface is lit where it turns out of sight, 0 to 1. With 0 the lamp's light
    // ends there, in a line narrower than a pixel, which shows as dashes along slanted edges.
    float leastCosine = 0;
    bool integrated = false;  // translucent: what cells hold is integrated over values, and nothing sampled
};

class VolumeRenderer final : public EyeRenderer {
public:
    // scene must outlive the renderer. Translucent where the look has a transfer function.
    explicit VolumeRenderer(const VolumeScene& scene, const VolumeCasting& casting = {});
    ~VolumeRenderer() override;

    int tileCount(const EyeView& view) const override;
    void renderTile(const EyeView& view, int tile, EyeImage& image) const override;
    void renderPixels(const EyeView& view, PixelRect bounds, std::span<const PixelIndex> pixels,
                      EyeImage& image) const override;
    bool startsAtKnownDepth() const override { return !translucent(); }
    bool mayHitBeyondEdge(const EyeView& view, PixelRect rect, double column,
                          double parallaxScale) const override;
    bool mayHitBeyondEdgeFrom(const EyeView& view, PixelRect rect, double column, double parallaxScale,
                              double& freeDepth) const override;
    ViewDependence viewDependence() const override;
    void shadeAgain(const EyeView& view, int y, int x0, int x1, EyeImage& image) const override;
    bool translucent() const override;
    void renderTileFromDepth(const EyeView& view, int tile, EyeImage& image) const override;

    SimdTarget target() const;  // what Auto became
    const VolumeScene& scene() const { return mScene; }

private:
    void lookUpAgain(const EyeView& view, PixelRect rect, EyeImage& image) const;

    struct State;
    const VolumeScene& mScene;
    std::unique_ptr<State> mState;
};

}  // namespace stereonav
