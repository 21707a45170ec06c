// The sums of a bake so far, brick by brick: they allow the bake to continue, to estimate its error, and to
// make the volumes that renderers look up. The step between the chosen texels (bake_texels.h) and the bake's
// file.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "engine/light/paths/texel_light.h"
#include "engine/light/transfer/bake_texels.h"
#include "engine/light/transfer/transfer_volume.h"
#include "engine/volume/illumination_volume.h"

namespace stereonav {

enum class BakeKind : std::uint32_t {
    Irradiance = 0,  // under a light setup
    Transfer = 1,    // distant light, in harmonics
    Openness = 2,    // irradiance under a sky of 1 without bounces: 0..1
};
std::string_view nameOf(BakeKind kind);

// The layout of a texel's sums.
struct BakeShape {
    BakeKind kind = BakeKind::Irradiance;
    int order = 5, channels = 1;  // transfer: 1 to kMaxHarmonicsOrder, 1 or 3
    int numbersPerTexel() const { return kind == BakeKind::Transfer ? order * order * channels : 0; }
    std::size_t bytesPerTexel() const {
        return kind == BakeKind::Transfer ? numbersPerTexel() * sizeof(float) + 1 : sizeof(TexelSum);
    }
};

// Sums over a brick's texels; the relative error is the root of variance / square.
struct BrickEstimate {
    // Variance of the means, summed; infinite where there are too few samples for an estimate.
    double variance = 0;
    double square = 0;  // squared means, summed
};

class BakeSums {
public:
    BakeSums() = default;
    // bricks: ordered by number, each with at least one texel. beside: bytes that lighting them will take in
    // addition (TexelLighter::bytesToCome). Throws Error where that is more than the available memory.
    BakeSums(const VolumeFrame& texels, std::vector<TexelBrick> bricks, const BakeShape& shape,
             std::size_t beside = 0);

    const VolumeFrame& frame() const { return mFrame; }
    const TexelLayout& layout() const { return mLayout; }
    const BakeShape& shape() const { return mShape; }
    std::span<const TexelBrick> bricks() const { return mBricks; }
    std::size_t texels() const { return mFirst.empty() ? 0 : mFirst.back(); }
    std::size_t texelsOf(std::size_t brick) const { return mFirst[brick + 1] - mFirst[brick]; }

    // Sums of irradiance and openness of a brick's texels, in the order of texelsIn().
    std::span<TexelSum> light(std::size_t brick);
    std::span<const TexelSum> light(std::size_t brick) const;
    // Transfer: sums of samples, numbersPerTexel() per texel, and whether texels lie on a surface.
    std::span<float> transfer(std::size_t brick);
    std::span<const float> transfer(std::size_t brick) const;
    std::span<std::uint8_t> alive(std::size_t brick);
    std::span<const std::uint8_t> alive(std::size_t brick) const;

    // Number of samples that each texel of a brick has had, and the estimate of the brick's error.
    std::vector<std::uint32_t> samples;
    std::vector<BrickEstimate> estimates;
    std::uint32_t fewestSamples() const;
    // Returns the estimated relative RMSE over all texels; infinite while there is no estimate; 0 without any
    // light.
    double error() const;

    // Writes the brick's part of a volume for lookups: means divided by `unit` with weight 1 where there is a
    // surface; nothing elsewhere.
    void writeLight(std::size_t brick, IlluminationVolume& to, float unit = 1) const;

private:
    VolumeFrame mFrame;
    TexelLayout mLayout;
    BakeShape mShape;
    std::vector<TexelBrick> mBricks;
    std::vector<std::size_t> mFirst;  // index of each brick's first texel; at the end the number of texels
    LazyArray<TexelSum> mLight;
    LazyArray<float> mTransfer;
    LazyArray<std::uint8_t> mAlive;
};

// Returns irradiance and openness, divided by `unit`.
IlluminationVolume illuminationOf(const BakeSums& sums, float unit = 1);
// Returns the unit in which half floats can hold the light: 1 where that suffices, else a power of two near
// the mean of the light.
float lightUnitOf(const BakeSums& sums);
// Returns transfer, without texels that lie on no surface.
TransferVolume transferOf(const BakeSums& sums);

// Returns the estimate from the luminance of a brick's texels.
BrickEstimate estimateOf(std::span<const TexelSum> texels);
// Returns the estimate from sums over the first `countBefore` samples and sums over all `count`: the samples
// before and after are independent estimates.
BrickEstimate estimateOf(std::span<const float> before, std::uint32_t countBefore, std::span<const float> all,
                         std::uint32_t count);

}  // namespace stereonav
