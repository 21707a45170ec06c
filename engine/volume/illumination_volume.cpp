// Packing of texels and the scalar lookups, in double precision: what the kernels' lookups must agree with.
// Texels may be written by a bake while they are read here, so each is loaded as one atomic word.
#include "engine/volume/illumination_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/pages.h"
#include "engine/math/half_float.h"
#include "engine/volume/volume_kernel_types.h"

namespace stereonav {
namespace {

// Kernels count halves of texels with signed 32-bit numbers, and read a few beyond the last.
constexpr double kMostTexels = 1073741824.0 - 512.0;

// Stored numbers: far below the steps of the data, far above the rounding of places in it.
constexpr double kEqualValues = 1e-4;

// 0 for NaN, infinities and what is negative.
float usable(float v, float most) {
    const float finite = v <= std::numeric_limits<float>::max() ? v : 0.0f;
    return finite > 0.0f ? std::min(finite, most) : 0.0f;
}

PackedTexel load(const IlluminationVolume& volume, int i, int j, int k) {
    auto& word = const_cast<PackedTexel&>(volume.texels[volume.layout.index(i, j, k)]);
    return std::atomic_ref<PackedTexel>(word).load(std::memory_order_relaxed);
}

// Texels along one axis that a point lies between, with their weights.
template <int Count>
struct Axis {
    std::array<int, Count> at{};
    std::array<double, Count> weight{};
};

// NaN becomes 0.
double clampToGrid(double x, int size) {
    return x > 0.0 ? std::min(x, size - 1.0) : 0.0;
}

Axis<2> linearAxis(double x, int size) {
    x = clampToGrid(x, size);
    const int low = std::min(static_cast<int>(x), std::max(size - 2, 0));
    const double f = x - low;
    return {{low, std::min(low + 1, size - 1)}, {1 - f, f}};
}

// Uniform cubic B-spline; beyond the faces the outermost texels count on.
Axis<4> cubicAxis(double x, int size) {
    const Axis<2> linear = linearAxis(x, size);
    const double g = linear.weight[0], f = linear.weight[1];
    Axis<4> axis;
    axis.weight = {g * g * g / 6, (4 - 3 * f * f * (2 - f)) / 6, (4 - 3 * g * g * (2 - g)) / 6,
                   f * f * f / 6};
    for (int n = 0; n < 4; ++n) axis.at[n] = std::clamp(linear.at[0] + n - 1, 0, size - 1);
    return axis;
}

template <int Count>
IlluminationVolume::Light weighted(const IlluminationVolume& volume, const std::array<Axis<Count>, 3>& axes) {
    glm::dvec3 sum(0.0);
    double weight = 0;
    for (int c = 0; c < Count; ++c)
        for (int b = 0; b < Count; ++b)
            for (int a = 0; a < Count; ++a) {
                const PackedTexel texel = load(volume, axes[0].at[a], axes[1].at[b], axes[2].at[c]);
                const double w =
                    texelWeight(texel) * (axes[0].weight[a] * axes[1].weight[b] * axes[2].weight[c]);
                sum += w * glm::dvec3(texelLight(texel));
                weight += w;
            }
    if (!(weight >= static_cast<double>(kLeastKnown))) return {};
    return {glm::vec3(sum / weight), static_cast<float>(std::min(weight, 1.0))};
}

IlluminationVolume::Light nearest(const IlluminationVolume& volume, const glm::dvec3& p) {
    glm::ivec3 at;
    for (int n = 0; n < 3; ++n) at[n] = static_cast<int>(clampToGrid(p[n], volume.frame.size[n]) + 0.5);
    const PackedTexel texel = load(volume, at.x, at.y, at.z);
    if (texelWeight(texel) <= 0) return {};
    return {texelLight(texel), texelWeight(texel)};
}

double trilinear(const GreyVolume& field, const glm::dvec3& world) {
    const glm::dvec3 p = field.frame.voxelFromWorld(world);
    const glm::ivec3 size = field.frame.size;
    const Axis<2> x = linearAxis(p.x, size.x), y = linearAxis(p.y, size.y), z = linearAxis(p.z, size.z);
    double sum = 0;
    for (int n = 0; n < 8; ++n)
        sum += x.weight[n & 1] * y.weight[n >> 1 & 1] * z.weight[n >> 2] *
               field.at(x.at[n & 1], y.at[n >> 1 & 1], z.at[n >> 2]);
    return sum;
}

}  // namespace

PackedTexel packTexel(const glm::vec3& light, float weight) {
    const std::uint64_t red = halfFromFloat(usable(light.x, kLargestHalf)),
                        green = halfFromFloat(usable(light.y, kLargestHalf)),
                        blue = halfFromFloat(usable(light.z, kLargestHalf)),
                        known = halfFromFloat(usable(weight, 1.0f));
    return red | green << 16 | blue << 32 | known << 48;
}

glm::vec3 texelLight(PackedTexel texel) {
    const auto channel = [&](int shift) { return floatFromHalf(static_cast<std::uint16_t>(texel >> shift)); };
    return {channel(0), channel(16), channel(32)};
}

float texelWeight(PackedTexel texel) {
    return floatFromHalf(static_cast<std::uint16_t>(texel >> 48));
}

std::size_t IlluminationVolume::bytesHeld() const {
    return residentBytes(texels);
}

IlluminationVolume::Light IlluminationVolume::at(const glm::dvec3& world, Lookup lookup) const {
    if (empty()) return {};
    const glm::dvec3 p = frame.voxelFromWorld(world);
    const glm::ivec3 size = frame.size;
    if (lookup == Lookup::Nearest) return nearest(*this, p);
    if (lookup == Lookup::Tricubic)
        return weighted<4>(*this, {cubicAxis(p.x, size.x), cubicAxis(p.y, size.y), cubicAxis(p.z, size.z)});
    return weighted<2>(*this, {linearAxis(p.x, size.x), linearAxis(p.y, size.y), linearAxis(p.z, size.z)});
}

IlluminationVolume::Light IlluminationVolume::nearestIsovalue(const glm::dvec3& world,
                                                              const GreyVolume& field, float isovalue) const {
    if (empty() || field.empty()) return {};
    const glm::dvec3 p = frame.voxelFromWorld(world);
    const Axis<2> x = linearAxis(p.x, frame.size.x), y = linearAxis(p.y, frame.size.y),
                  z = linearAxis(p.z, frame.size.z);
    PackedTexel best = 0;
    double bestAway = std::numeric_limits<double>::infinity(), bestShare = 0;
    for (int n = 0; n < 8; ++n) {
        const glm::ivec3 at(x.at[n & 1], y.at[n >> 1 & 1], z.at[n >> 2]);
        const PackedTexel texel = load(*this, at.x, at.y, at.z);
        if (texelWeight(texel) <= 0) continue;
        const double away = std::abs(trilinear(field, frame.worldFromVoxel(glm::dvec3(at))) - isovalue);
        // Among equal ones the nearer counts: the surface may run along a grid line.
        const double share = x.weight[n & 1] * y.weight[n >> 1 & 1] * z.weight[n >> 2];
        const bool equal = std::abs(away - bestAway) <= kEqualValues;
        if (equal ? share <= bestShare : away > bestAway) continue;
        best = texel;
        bestAway = away;
        bestShare = share;
    }
    if (best == 0) return {};
    return {texelLight(best), texelWeight(best)};
}

VolumeFrame texelFrame(const VolumeFrame& volume, double perVoxel) {
    if (!(perVoxel > 0 && perVoxel <= 64))
        throw Error("", "resolution",
                    fmt::format("expected more than 0 and at most 64 texels a voxel, got {}", perVoxel),
                    "use 0.5, 1 or 2");
    VolumeFrame frame = volume;
    frame.spacing = volume.spacing / perVoxel;
    double bricked = 1;
    glm::dvec3 texels;
    for (int n = 0; n < 3; ++n) {
        // The last texel may lie a rounding error before the last voxel.
        texels[n] = std::ceil((std::max(volume.size[n], 1) - 1) * perVoxel - 1e-9) + 1;
        bricked *= 8 * std::ceil(texels[n] / 8);
    }
    if (!(bricked <= kMostTexels))
        throw Error("", "resolution",
                    fmt::format("{} texels a voxel are {} x {} x {} texels, more than 2^30", perVoxel,
                                texels.x, texels.y, texels.z),
                    "choose a lower resolution or a smaller volume");
    frame.size = glm::ivec3(texels);
    return frame;
}

}  // namespace stereonav
