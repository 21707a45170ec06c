// Holes cast without knowledge of the scene: shows what filling them gains by ray coherence (Wan et al. 2004,
// section 5).
#pragma once

#include "engine/render/eye_renderer.h"

namespace stereonav {

// A renderer that passes on scattered pixels a few at a time and far apart, without depths beside them, so
// that each ray goes the whole way from the eye by itself. The pictures are the same.
class WithoutCoherence final : public EyeRenderer {
public:
    // inner must outlive this object.
    explicit WithoutCoherence(const EyeRenderer& inner) : mInner(inner) {}

    int tileCount(const EyeView& view) const override { return mInner.tileCount(view); }
    void renderTile(const EyeView& view, int tile, EyeImage& image) const override {
        mInner.renderTile(view, tile, image);
    }
    void renderPixels(const EyeView& view, PixelRect bounds, std::span<const PixelIndex> pixels,
                      EyeImage& image) const override;
    bool mayHitBeyondEdge(const EyeView& view, PixelRect rect, double column,
                          double parallaxScale) const override {
        return mInner.mayHitBeyondEdge(view, rect, column, parallaxScale);
    }
    bool mayHitBeyondEdgeFrom(const EyeView& view, PixelRect rect, double column, double parallaxScale,
                              double& freeDepth) const override {
        return mInner.mayHitBeyondEdgeFrom(view, rect, column, parallaxScale, freeDepth);
    }
    ViewDependence viewDependence() const override { return mInner.viewDependence(); }
    void shadeAgain(const EyeView& view, int y, int x0, int x1, EyeImage& image) const override {
        mInner.shadeAgain(view, y, x0, x1, image);
    }
    bool airDiffers(double separation) const override { return mInner.airDiffers(separation); }
    void changeAir(const EyeView& from, const EyeView& view, int y, EyeImage& image) const override {
        mInner.changeAir(from, view, y, image);
    }
    bool translucent() const override { return mInner.translucent(); }

private:
    const EyeRenderer& mInner;
};

}  // namespace stereonav
