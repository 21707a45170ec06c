// Heights are resampled to a square grid; colours are read in place from the scene's texture.
#include "app/scene/terrain/height_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/medium/model/noise_file.h"

namespace stereonav {
namespace {

constexpr double kGroundOpacity = 0.9;  // at a thickness of one sample spacing, or of kSoftSlices slices
constexpr double kSoftSlices = 3;       // with fewer each slice shows as a terrace
constexpr double kThickness = 0.02;     // share of the longer side down to which the ground is solid
constexpr double kTaper = 0.5;          // least height of the taper in sample spacings
// Sines of the sun's elevation: from kHighSun on the taper is as above; it grows towards kLowestSun.
constexpr double kHighSun = 0.5, kLowestSun = 0.1;
constexpr double kMistTaper = 0.3;  // share of the mist's thickness
constexpr float kMistAlbedo = 0.97f;
constexpr glm::vec3 kMistColor{0.62f};  // grey that suits ground in colours the eye is used to

// Returns heights on a grid with the same spacing both ways, row 0 southernmost.
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

// Returns a white transfer function, since the colour comes from the texture. Scattered light reaches no
// deeper into the ground than direct light.
MediumTransfer groundTransfer(const Heightfield& ground, double length) {
    MediumMaterial material;
    material.color = glm::vec3(1.0f);
    material.opacity = kGroundOpacity;
    material.transport = glm::vec3(static_cast<float>(1 - kGroundOpacity));
    const double range = std::max<double>(ground.maxHeight() - ground.minHeight(), 1.0);
    return MediumTransfer(std::vector<MediumPoint>{{ground.minHeight() - 0.1 * range, material},
                                                   {ground.maxHeight() + 0.1 * range, material}},
                          length, "the ground's colours");
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
    // Faces thinner than the distance of slices or the width of light texels would show as terraces.
    const double slice = glm::length(extent) / sweep.slices;
    const double step = std::max(slice, glm::length(extent) / sweep.lightSize);
    // Low light crosses more of the face, and would end within a part of a texel: ripples.
    const double low = std::max(std::abs(std::sin(terrain.look.sunElevation)), kLowestSun);
    layer.taper = std::min(std::max(kTaper * layer.spacing, step) * (kHighSun / std::min(low, kHighSun)),
                           0.5 * layer.below);
    const bool ownColors = options.ground();
    const MediumTransfer transfer = ownColors
                                        ? groundTransfer(ground, std::max(layer.spacing, kSoftSlices * slice))
                                        : findMediumTransfer(options.medium);
    if (ownColors) {  // colours of the scene, which lives as long
        layer.color = std::shared_ptr<const ColorTexture>(std::shared_ptr<void>(), &terrain.color);
        layer.colorSpacing = ground.spacing();
    }
    const double margin = 1 + 0.05 * (static_cast<double>(ground.maxHeight()) - ground.minHeight());
    layer.table = makeMediumTable(transfer, ground.minHeight() - margin, ground.maxHeight() + margin);
    makeMipLevels(layer);
    return layer;
}

// Returns a uniform layer from below the lowest ground up to the top of the mist.
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
    // Each taper halves the extinction of its part.
    material.opacity = -std::expm1(-mist.opticalDepth / (1 - kMistTaper));
    // Diffusion uses tau_i = tau sqrt(3 (1 - albedo)).
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
    if (options.mist) layers.push_back(mistLayer(terrain, *options.mist));
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
