#include "engine/sampling/edge_rays.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/sampling/edge_row.h"
#include "engine/sampling/pixel_samples.h"
#include "engine/stereo/hole_fill.h"

namespace stereonav {
namespace {

constexpr int kRowsOfTask = 16;

void checkSetting(const EdgeSetting& setting) {
    if (setting.rays < 0 || setting.rays > kMostEdgeRays)
        throw Error("", "",
                    fmt::format("expected 0 to {} rays at edges, got {}", kMostEdgeRays, setting.rays),
                    "use 4, or 0 for none");
}

}  // namespace

void findEdges(const EyeImage& image, const EdgeSetting& setting, Plane<std::uint8_t>& edges) {
    const int width = image.width(), height = image.height();
    edges.resize(width, height);
    const EdgeFunction find = edgeFinder();
    const auto row = [height](const auto& plane, int y) {
        return y < 0 || y >= height ? nullptr : plane.row(y);
    };
    const int tasks = (height + kRowsOfTask - 1) / kRowsOfTask;
    parallelFor(tasks, [&](int task) {
        for (int y = task * kRowsOfTask; y < std::min((task + 1) * kRowsOfTask, height); ++y)
            find({row(image.color, y - 1), image.color.row(y), row(image.color, y + 1),
                  row(image.viewDepth, y - 1), image.viewDepth.row(y), row(image.viewDepth, y + 1),
                  edges.row(y), width, setting.contrast, setting.jumpContrast, setting.strongContrast,
                  static_cast<float>(setting.depthBreak), static_cast<float>(setting.depthJump)});
    });
}

struct EdgeRays::State {
    Plane<std::uint8_t> edges;
    HoleFill batches;
    EyeImage rays;  // view depths are 0 between two tasks: nothing is known
};

EdgeRays::EdgeRays() : mState(std::make_unique<State>()) {}
EdgeRays::~EdgeRays() = default;
EdgeRays::EdgeRays(EdgeRays&&) noexcept = default;
EdgeRays& EdgeRays::operator=(EdgeRays&&) noexcept = default;

EdgeTimings EdgeRays::smooth(const EyeRenderer& renderer, const EyeView& view, const EdgeSetting& setting,
                             EyeImage& image) {
    checkSetting(setting);
    if (setting.rays == 0 || image.width() < 1 || image.height() < 1) return {};
    const Stopwatch watch;
    State& s = *mState;
    findEdges(image, setting, s.edges);
    EdgeTimings timings;
    timings.pixels = s.batches.list(s.edges, Schedule::Dynamic);
    s.rays.resize(image.width(), image.height(), renderer.viewDependence());
    std::vector<EyeView> views;
    for (const glm::dvec2& place : rotatedGrid(setting.rays)) views.push_back(shiftedBy(view, place));
    const float share = 1.0f / static_cast<float>(setting.rays + 1);
    s.batches.forEach(Schedule::Dynamic, [&](PixelRect bounds, std::span<const PixelIndex> pixels) {
        thread_local std::vector<glm::vec3> sums;
        sums.clear();
        for (const PixelIndex p : pixels) sums.push_back(unpackColor(image.color.at(p.x, p.y)));
        for (const EyeView& shifted : views) {
            renderer.renderMoreRays(shifted, view, image.viewDepth, bounds, pixels, s.rays);
            for (std::size_t k = 0; k < pixels.size(); ++k) {
                sums[k] += unpackColor(s.rays.color.at(pixels[k].x, pixels[k].y));
                s.rays.viewDepth.at(pixels[k].x, pixels[k].y) = 0;
            }
        }
        for (std::size_t k = 0; k < pixels.size(); ++k)
            image.color.at(pixels[k].x, pixels[k].y) = packColor(sums[k] * share);
    });
    timings.ms = watch.elapsed_ms();
    return timings;
}

const Plane<std::uint8_t>& EdgeRays::edges() const {
    return mState->edges;
}

}  // namespace stereonav
