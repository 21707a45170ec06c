// See the header.
#include "engine/light/paths/pixel_path.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/progress.h"
#include "engine/math/luminance.h"

namespace stereonav {
namespace {

bool showsSurface(float depth) {
    return depth > 0 && depth < kMissDepth;
}

}  // namespace

PixelPaths::PixelPaths(const VolumeScene& scene, const LightSetup& setup, const TexelSampling& sampling)
    : mScene(scene), mLighter(scene.field, scene.field.frame, setup, sampling) {}

void PixelPaths::addRow(const EyeView& view, const float* depths, int y, std::uint64_t firstNumber,
                        int samples, std::span<TexelSum> sums) const {
    std::vector<TexelLighter::SurfacePoint> points;
    std::vector<std::size_t> columns;
    std::vector<TexelSum> own;
    for (std::size_t x = 0; x < sums.size(); ++x) {
        if (!showsSurface(depths[x])) {
            sums[x] = {glm::vec3(0.0f), -1, 0};
            continue;
        }
        const glm::dvec3 ray = view.rayDirection(static_cast<double>(x) + 0.5, y + 0.5);
        const glm::dvec3 world = view.eye + static_cast<double>(depths[x]) * ray;
        points.push_back({mScene.field.frame.voxelFromWorld(world),
                          static_cast<double>(mScene.cells.isovalue), -glm::normalize(ray), firstNumber + x});
        columns.push_back(x);
        own.push_back(sums[x]);
    }
    mLighter.addIrradianceAt(points, samples, own);
    for (std::size_t n = 0; n < columns.size(); ++n) sums[columns[n]] = own[n];
}

void PixelPaths::add(const EyeView& view, const Plane<float>& viewDepth, std::uint32_t stream, int samples,
                     Plane<TexelSum>& sums, Progress& progress) const {
    const int width = viewDepth.width(), height = viewDepth.height();
    sums.resize(width, height);
    ProgressSteps rows(progress, height, "tracing paths from every pixel");
    parallelFor(height, [&](int y) {
        if (progress.cancelled()) throw Cancelled();
        const std::uint64_t first = static_cast<std::uint64_t>(stream) << 40 |
                                    static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(width);
        addRow(view, viewDepth.row(y), y, first, samples, {sums.row(y), static_cast<std::size_t>(width)});
        rows.done();
    });
}

PixelLightFacts factsOf(const Plane<TexelSum>& sums) {
    PixelLightFacts facts;
    double variance = 0, squares = 0;
    for (int y = 0; y < sums.height(); ++y)
        for (int x = 0; x < sums.width(); ++x) {
            const TexelSum& sum = sums.at(x, y);
            if (!(sum.samples > 0)) continue;
            const double n = sum.samples, light = luminance(glm::dvec3(sum.mean));
            ++facts.pixels;
            facts.mean += light;
            squares += light * light;
            variance += n >= 2 ? static_cast<double>(sum.squares) / (n * (n - 1))
                               : std::numeric_limits<double>::infinity();
        }
    if (facts.pixels == 0) return facts;
    facts.mean /= static_cast<double>(facts.pixels);
    // A picture without any light is exact: one sample of nothing tells as much as many.
    facts.error = squares > 0 ? std::sqrt(variance / squares) : 0;
    return facts;
}

void showPixelLight(const VolumeLook& look, const Plane<TexelSum>& sums, float exposure, EyeImage& image) {
    for (int y = 0; y < sums.height(); ++y)
        for (int x = 0; x < sums.width(); ++x) {
            const TexelSum& sum = sums.at(x, y);
            if (sum.samples > 0) image.color.at(x, y) = packColor(look.surface * sum.mean * exposure);
        }
}

}  // namespace stereonav
