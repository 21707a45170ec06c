// Heights are copied onto a grid of one spacing; colours are the means of the ground's picture at each
// height.
#include "app/medium_terrain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "app/medium_noise.h"
#include "app/medium_options.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr int kColors = 64;               // heights with a colour of their own
constexpr int kColorSamples = 1'000'000;  // samples of the ground looked at, about
constexpr double kGroundOpacity = 0.9;    // of a layer one sample spacing thick, or kSoftSlices slices
constexpr double kSoftSlices = 3;         // fewer, and each slice shows as a terrace
constexpr double kThickness = 0.02;       // of the longer side: how far down the ground is solid
constexpr double kTaper = 0.5;            // sample spacings over which it begins at least
constexpr double kMistTaper = 0.3;        // of the mist's thickness
constexpr float kMistAlbedo = 0.97f;
constexpr glm::vec3 kMistColor{0.62f};  // beside ground whose colours are as the eye is used to them

// Heights of a grid with the same spacing both ways, row 0 southernmost.
Plane<float> heightsOf(const Heightfield& ground, double spacing) {
    const glm::dvec2 extent = ground.spacing() * glm::dvec2(ground.width() - 1, ground.height() - 1);
    const auto side = [&](double length) { return static_cast<int>(std::lround(length / spacing)) + 1; };
    Plane<float> heights(side(extent.x), side(extent.y));
    parallelFor(heights.height(), [&](int y) {
        for (int x = 0; x < heights.width(); ++x)
            heights.at(x, y) =
                static_cast<float>(ground.heightAt(ground.originWorld() + glm::dvec2(x, y) * spacing));
    });
    return heights;
}

glm::vec3 colorAt(const ColorTexture& color, const glm::dvec2& grid) {
    if (color.levelCount() == 0) return glm::vec3(0.5f);
    const ColorTexture::Level level = color.level(0);
    const glm::dvec2 texel = (grid - color.gridOrigin()) / color.gridPerTexel();
    const auto index = [](double t, int size) {
        return static_cast<int>(std::clamp(t, 0.0, static_cast<double>(size - 1)));
    };
    return unpackColor(level.at(index(texel.x, level.width()), index(texel.y, level.height())));
}

// The mean colour of the ground in kColors equal ranges of height; ranges without any ground take the one
// below.
std::vector<glm::vec3> meanColors(const TerrainScene& terrain) {
    const Heightfield& ground = terrain.ground;
    std::vector<glm::dvec3> sums(kColors, glm::dvec3(0.0));
    std::vector<double> counts(kColors, 0.0);
    const double range = static_cast<double>(ground.maxHeight()) - ground.minHeight();
    const double samples = static_cast<double>(ground.width()) * ground.height();
    const int step = std::max(1, static_cast<int>(std::sqrt(samples / kColorSamples)));
    for (int j = 0; j < ground.height(); j += step)
        for (int i = 0; i < ground.width(); i += step) {
            const double height = ground.sample(i, j);
            if (!std::isfinite(height)) continue;
            const double share = range > 0 ? (height - ground.minHeight()) / range : 0.0;
            const int bin = std::min(static_cast<int>(share * kColors), kColors - 1);
            sums[bin] += glm::dvec3(colorAt(terrain.color, glm::dvec2(i, j)));
            counts[bin] += 1;
        }
    std::vector<glm::vec3> colors;
    for (int n = 0; n < kColors; ++n) {
        const glm::vec3 before = colors.empty() ? glm::vec3(0.5f) : colors.back();
        colors.push_back(counts[n] > 0 ? glm::vec3(sums[n] / counts[n]) : before);
    }
    return colors;
}

// Light that scatters in the ground goes no further than light that falls straight in.
MediumMaterial groundMaterial(const glm::vec3& color) {
    MediumMaterial material;
    material.color = glm::clamp(color, 0.0f, 1.0f);
    material.opacity = kGroundOpacity;
    material.transport = glm::vec3(static_cast<float>(1 - kGroundOpacity));
    return material;
}

MediumTransfer groundTransfer(const TerrainScene& terrain, double length) {
    const std::vector<glm::vec3> colors = meanColors(terrain);
    const double lowest = terrain.ground.minHeight();
    const double range = std::max<double>(terrain.ground.maxHeight() - lowest, 1.0);
    std::vector<MediumPoint> points{{lowest - 0.1 * range, groundMaterial(colors.front())}};
    for (int n = 0; n < kColors; ++n)
        points.push_back({lowest + (n + 0.5) / kColors * range, groundMaterial(colors[n])});
    points.push_back({lowest + 1.1 * range, groundMaterial(colors.back())});
    return MediumTransfer(std::move(points), length, "the ground's colours");
}

HeightLayer groundLayer(const TerrainScene& terrain, const MediumOptions& options,
                        const SweepSetting& sweep) {
    const Heightfield& ground = terrain.ground;
    const glm::dvec2 extent = ground.spacing() * glm::dvec2(ground.width() - 1, ground.height() - 1);
    HeightLayer layer;
    layer.spacing = std::min(ground.spacing().x, ground.spacing().y);
    layer.originX = ground.originWorld().x;
    layer.originY = ground.originWorld().y;
    layer.levels.push_back(heightsOf(ground, layer.spacing));
    layer.below = kThickness * std::max(extent.x, extent.y);
    // A face thinner than slices are apart, or the light's texels wide, shows them as terraces.
    const double slice = glm::length(extent) / sweep.slices;
    const double step = std::max(slice, glm::length(extent) / sweep.lightSize);
    layer.taper = std::min(std::max(kTaper * layer.spacing, step), 0.5 * layer.below);
    const MediumTransfer transfer =
        options.medium == kGroundMedium
            ? groundTransfer(terrain, std::max(layer.spacing, kSoftSlices * slice))
            : findMediumTransfer(options.medium);
    const double margin = 1 + 0.05 * (static_cast<double>(ground.maxHeight()) - ground.minHeight());
    layer.table = makeMediumTable(transfer, ground.minHeight() - margin, ground.maxHeight() + margin);
    makeMipLevels(layer);
    return layer;
}

// From below the lowest ground up to the top, everywhere the same.
HeightLayer mistLayer(const TerrainScene& terrain, const Mist& mist) {
    const Heightfield& ground = terrain.ground;
    if (!(mist.top > ground.minHeight()))
        throw Error("--mist", "",
                    fmt::format("expected a top above the lowest ground, {:.6g} m, got {:.6g} m",
                                ground.minHeight(), mist.top),
                    fmt::format("the ground reaches up to {:.6g} m", ground.maxHeight()));
    const glm::dvec2 extent = ground.spacing() * glm::dvec2(ground.width() - 1, ground.height() - 1);
    HeightLayer layer;
    layer.spacing = std::max(extent.x, extent.y);
    layer.originX = ground.originWorld().x;
    layer.originY = ground.originWorld().y;
    Plane<float> top(2, 2);
    for (int n = 0; n < 4; ++n) top.at(n % 2, n / 2) = static_cast<float>(mist.top);
    layer.levels.push_back(std::move(top));
    layer.below = mist.top - ground.minHeight();
    layer.taper = kMistTaper * layer.below;
    MediumMaterial material;
    material.color = kMistColor;
    // The tapers take away half of their part each.
    material.opacity = -std::expm1(-mist.opticalDepth / (1 - kMistTaper));
    // Diffusion: tau_i = tau sqrt(3 (1 - albedo)).
    material.transport = glm::vec3(std::exp(-static_cast<float>(mist.opticalDepth / (1 - kMistTaper)) *
                                            std::sqrt(3.0f * (1.0f - kMistAlbedo))));
    const double margin = 1 + layer.below;
    const MediumTransfer transfer(
        std::vector<MediumPoint>{{mist.top - 2 * margin, material}, {mist.top + margin, material}},
        layer.below, "--mist");
    layer.table = makeMediumTable(transfer, mist.top - 2 * margin, mist.top + margin);
    makeMipLevels(layer);
    return layer;
}

}  // namespace

Medium terrainMedium(const TerrainScene& terrain, const MediumOptions& options, const SweepSetting& sweep) {
    std::vector<HeightLayer> layers;
    layers.push_back(groundLayer(terrain, options, sweep));
    if (const std::optional<Mist> mist = mistFromText(options.mist))
        layers.push_back(mistLayer(terrain, *mist));
    const glm::dvec2 extent =
        terrain.ground.spacing() * glm::dvec2(terrain.ground.width() - 1, terrain.ground.height() - 1);
    const double side = std::max(extent.x, extent.y);
    return Medium(std::move(layers), options.noise.empty() ? Perturbation{} : findNoise(options.noise, side));
}

glm::vec3 skyAt(const SkyMap& sky, const glm::dvec3& direction) {
    const Plane<PackedColor>& map = sky.map();
    if (map.empty()) return glm::vec3(0.0f);
    const glm::dvec3 size = glm::abs(direction);
    glm::dvec2 p = glm::dvec2(direction) / (size.x + size.y + size.z);
    if (direction.z < 0)
        p = glm::dvec2(std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y));
    const glm::dvec2 last(map.width() - 1, map.height() - 1);
    const glm::dvec2 place = glm::clamp((0.5 * p + 0.5) * (last + 1.0) - 0.5, glm::dvec2(0.0), last);
    const int i = std::min(static_cast<int>(place.x), std::max(map.width() - 2, 0));
    const int j = std::min(static_cast<int>(place.y), std::max(map.height() - 2, 0));
    const float u = static_cast<float>(place.x - i), v = static_cast<float>(place.y - j);
    const auto at = [&](int x, int y) {
        return unpackColor(map.at(std::min(x, map.width() - 1), std::min(y, map.height() - 1)));
    };
    return glm::mix(glm::mix(at(i, j), at(i + 1, j), u), glm::mix(at(i, j + 1), at(i + 1, j + 1), u), v);
}

}  // namespace stereonav
