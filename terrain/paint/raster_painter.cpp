#include "terrain/paint/raster_painter.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "engine/base/parallel.h"
#include "terrain/paint/ground_view.h"

namespace stereonav {
namespace {

float rasterValueAt(const Plane<float>& values, const glm::dvec2& grid) {
    const double x = std::clamp(grid.x, 0.0, values.width() - 1.0),
                 y = std::clamp(grid.y, 0.0, values.height() - 1.0);
    const int i = std::min(static_cast<int>(x), values.width() - 2),
              j = std::min(static_cast<int>(y), values.height() - 2);
    const auto u = static_cast<float>(x - i), v = static_cast<float>(y - j);
    const float south = values.at(i, j) * (1 - u) + values.at(i + 1, j) * u,
                north = values.at(i, j + 1) * (1 - u) + values.at(i + 1, j + 1) * u;
    return south * (1 - v) + north * v;
}

PaintStop stopAt(const std::vector<PaintStop>& stops, float value) {
    const float at = std::clamp(value, 0.0f, 1.0f) * static_cast<float>(stops.size() - 1);
    const std::size_t n = std::min(static_cast<std::size_t>(at), stops.size() - 2);
    const float part = at - static_cast<float>(n);
    return {glm::mix(stops[n].color, stops[n + 1].color, part),
            stops[n].share + part * (stops[n + 1].share - stops[n].share)};
}

}  // namespace

RasterPainter::RasterPainter(const Heightfield& ground, const Fog& fog, Plane<float> values,
                             std::vector<PaintStop> stops)
    : mGround(ground), mFog(fog), mValues(std::move(values)), mStops(std::move(stops)) {}

void RasterPainter::paint(const EyeView& view, EyeImage& image) const {
    if (image.viewDepth.empty()) return;
    const GroundView ground(mGround, view);
    parallelFor(image.height(), [&](int y) {
        for (int x = 0; x < image.width(); ++x) {
            GroundSeen seen;
            if (!ground.at(x, y, image.viewDepth.at(x, y), seen)) continue;
            const float value = rasterValueAt(mValues, mGround.gridFromWorld(glm::dvec2(seen.place)));
            if (!std::isfinite(value)) continue;
            const PaintStop stop = stopAt(mStops, value);
            if (stop.share <= 0) continue;
            const glm::vec3 coat = mFog.seen(stop.color, view.eye, seen.direction, seen.depth);
            PackedColor& color = image.color.at(x, y);
            color = packColor(glm::mix(unpackColor(color), coat, stop.share));
        }
    });
}

}  // namespace stereonav
