// Faults by environment variable, each a share: STEREONAV_FAULT_SLOW=0.5 makes casting the right eye's holes
// take half as long again, and STEREONAV_FAULT_ERROR=0.1 darkens the cast pixels by a tenth.
#include <cstdlib>

#include "app/report/faults.h"
#include "engine/base/stopwatch.h"

namespace stereonav {
namespace {

double shareFrom(const char* variable) {
    const char* text = std::getenv(variable);
    return text ? std::strtod(text, nullptr) : 0.0;
}

class FaultyRenderer final : public EyeRenderer {
public:
    explicit FaultyRenderer(const EyeRenderer& sound)
        : mSound(sound),
          mSlow(shareFrom("STEREONAV_FAULT_SLOW")),
          mDark(shareFrom("STEREONAV_FAULT_ERROR")) {}

    int tileCount(const EyeView& view) const override { return mSound.tileCount(view); }
    void renderTile(const EyeView& view, int tile, EyeImage& image) const override {
        mSound.renderTile(view, tile, image);
    }
    void renderPixels(const EyeView& view, PixelRect bounds, std::span<const PixelIndex> pixels,
                      EyeImage& image) const override {
        const Stopwatch watch;
        mSound.renderPixels(view, bounds, pixels, image);
        const double until_ms = watch.elapsed_ms() * (1 + mSlow);
        while (watch.elapsed_ms() < until_ms) continue;
        if (mDark == 0) return;
        for (const PixelIndex& p : pixels)
            image.color.at(p.x, p.y) =
                packColor(unpackColor(image.color.at(p.x, p.y)) * static_cast<float>(1 - mDark));
    }
    bool startsAtKnownDepth() const override { return mSound.startsAtKnownDepth(); }
    bool mayHitBeyondEdge(const EyeView& view, PixelRect rect, double column,
                          double parallaxScale) const override {
        return mSound.mayHitBeyondEdge(view, rect, column, parallaxScale);
    }
    bool mayHitBeyondEdgeFrom(const EyeView& view, PixelRect rect, double column, double parallaxScale,
                              double& freeDepth) const override {
        return mSound.mayHitBeyondEdgeFrom(view, rect, column, parallaxScale, freeDepth);
    }
    ViewDependence viewDependence() const override { return mSound.viewDependence(); }
    void shadeAgain(const EyeView& view, int y, int x0, int x1, EyeImage& image) const override {
        mSound.shadeAgain(view, y, x0, x1, image);
    }
    bool airDiffers(double separation) const override { return mSound.airDiffers(separation); }
    void changeAir(const EyeView& from, const EyeView& view, int y, EyeImage& image) const override {
        mSound.changeAir(from, view, y, image);
    }
    bool translucent() const override { return mSound.translucent(); }
    void renderTileFromDepth(const EyeView& view, int tile, EyeImage& image) const override {
        mSound.renderTileFromDepth(view, tile, image);
    }

private:
    const EyeRenderer& mSound;
    double mSlow, mDark;
};

}  // namespace

std::unique_ptr<EyeRenderer> withFaults(const EyeRenderer& renderer) {
    return std::make_unique<FaultyRenderer>(renderer);
}

}  // namespace stereonav
