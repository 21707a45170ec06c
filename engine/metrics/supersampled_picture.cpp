#include "engine/metrics/supersampled_picture.h"

#include <algorithm>
#include <string>

#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

// Columns x0 .. x1 - 1 of a view as a view of their own.
EyeView columnsOf(const EyeView& view, int x0, int x1) {
    EyeView strip = view;
    strip.xMin = view.xMin + x0 * view.pixelWidth();
    strip.xMax = view.xMin + x1 * view.pixelWidth();
    strip.width = x1 - x0;
    return strip;
}

PackedColor averageBlock(const Plane<PackedColor>& fine, int x0, int y0, int factor) {
    glm::vec3 sum(0.0f);
    for (int y = y0; y < y0 + factor; ++y)
        for (int x = x0; x < x0 + factor; ++x) sum += unpackColor(fine.at(x, y));
    return packColor(sum / static_cast<float>(factor * factor));
}

// castStrip: casts a view; what it returns is read before the next call.
template <typename CastStrip>
Plane<PackedColor> supersampled(const EyeView& view, int factor, Progress& progress,
                                const CastStrip& castStrip) {
    if (factor < 1 || factor > 16)
        throw Error("", "", "expected 1 to 16 rays a side of a pixel, got " + std::to_string(factor),
                    "use 8 for 64 rays a pixel");
    constexpr long long kStripRays = 4'000'000;  // 16 bytes each with view-dependent planes
    const long long raysPerColumn = static_cast<long long>(view.height) * factor * factor;
    const int stripWidth = static_cast<int>(std::clamp<long long>(kStripRays / raysPerColumn, 1, view.width));
    Plane<PackedColor> result(view.width, view.height);
    for (int x0 = 0; x0 < view.width; x0 += stripWidth) {
        progress.report(static_cast<double>(x0) / view.width, "casting the truth");
        const int x1 = std::min(view.width, x0 + stripWidth);
        const EyeImage& fine = castStrip(columnsOf(view, x0, x1).supersampled(factor));
        parallelFor(view.height, [&](int y) {
            for (int x = x0; x < x1; ++x)
                result.at(x, y) = averageBlock(fine.color, (x - x0) * factor, y * factor, factor);
        });
    }
    progress.report(1.0, "casting the truth");
    return result;
}

}  // namespace

Plane<PackedColor> renderSupersampled(const EyeRenderer& renderer, const EyeView& view, int factor,
                                      Progress& progress) {
    EyeImage fine;
    return supersampled(view, factor, progress, [&](const EyeView& strip) -> const EyeImage& {
        fine.resize(strip.width, strip.height, renderer.viewDependence());
        renderEye(renderer, strip, fine);
        return fine;
    });
}

Plane<PackedColor> renderSupersampled(FrameMaker& frames, const EyeView& view, double time, int factor,
                                      Progress& progress) {
    EyePair fine;
    return supersampled(view, factor, progress, [&](const EyeView& strip) -> const EyeImage& {
        frames.makeOne(strip, time, fine);
        return fine.left;
    });
}

}  // namespace stereonav
