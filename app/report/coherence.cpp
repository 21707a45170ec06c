#include "app/report/coherence.h"

#include <algorithm>
#include <vector>

namespace stereonav {
namespace {

constexpr int kApart = 2;            // pixels: at most a quarter of a block, so that no block counts as dense
constexpr std::size_t kAtOnce = 64;  // a few full vectors of rays

PixelRect boundsOf(std::span<const PixelIndex> pixels) {
    PixelRect bounds{1 << 30, 1 << 30, 0, 0};
    for (const PixelIndex p : pixels) {
        bounds.x0 = std::min<int>(bounds.x0, p.x);
        bounds.y0 = std::min<int>(bounds.y0, p.y);
        bounds.x1 = std::max<int>(bounds.x1, p.x + 1);
        bounds.y1 = std::max<int>(bounds.y1, p.y + 1);
    }
    return bounds;
}

// Moves pixels from the scratch image to the image, and leaves the scratch image without known pixels.
void takeOver(std::span<const PixelIndex> pixels, EyeImage& scratch, EyeImage& image) {
    for (const PixelIndex p : pixels) {
        image.color.at(p.x, p.y) = scratch.color.at(p.x, p.y);
        image.viewDepth.at(p.x, p.y) = scratch.viewDepth.at(p.x, p.y);
        if (!image.baseColor.empty()) image.baseColor.at(p.x, p.y) = scratch.baseColor.at(p.x, p.y);
        if (!image.normal.empty()) image.normal.at(p.x, p.y) = scratch.normal.at(p.x, p.y);
        scratch.viewDepth.at(p.x, p.y) = 0;
    }
}

}  // namespace

void WithoutCoherence::renderPixels(const EyeView& view, PixelRect, std::span<const PixelIndex> pixels,
                                    EyeImage& image) const {
    thread_local EyeImage scratch;
    thread_local std::vector<PixelIndex> some;
    if (scratch.width() != image.width() || scratch.height() != image.height() ||
        scratch.normal.empty() != image.normal.empty() ||
        scratch.baseColor.empty() != image.baseColor.empty()) {
        scratch = {};
        scratch.resize(image.width(), image.height(), viewDependence());
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x) scratch.viewDepth.at(x, y) = 0;
    }
    for (int group = 0; group < kApart * kApart; ++group) {
        some.clear();
        for (const PixelIndex p : pixels)
            if (p.x % kApart + kApart * (p.y % kApart) == group) some.push_back(p);
        for (std::size_t first = 0; first < some.size(); first += kAtOnce) {
            const auto few = std::span(some).subspan(first, std::min(kAtOnce, some.size() - first));
            mInner.renderPixels(view, boundsOf(few), few, scratch);
            takeOver(few, scratch, image);
        }
    }
}

}  // namespace stereonav
