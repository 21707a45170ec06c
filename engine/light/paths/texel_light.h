// Light at single texels: each is lit on the isosurface through itself (Wyman et al. 2006, section 4.1, Y1 of
// docs/ledger.md). Rays find the surface exactly (Y2) and start lifted along the smoothed normal (Y3).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <span>

#include "engine/light/skies/light_setup.h"
#include "engine/simd/simd_target.h"
#include "engine/volume/volume.h"

namespace stereonav {

// How paths are chosen: `Naive` is the paper's way (uniform over the hemisphere, without knowledge of the
// light), kept as the baseline and the oracle. Each improvement can be switched off separately, to measure
// its effect.
struct TexelSampling {
    bool naive = false;
    bool lowDiscrepancy = true;  // instead of independent random numbers
    bool cosine = true;          // directions by the cosine, instead of uniform
    bool nextEvent = true;  // the probe sampled by its brightness as well, weighted by the power heuristic
    bool roulette = true;   // dim paths end at random
    bool leaping = true;    // over cells that the surface of this isovalue does not cross
    // Range of isovalues of the surfaces that are shown, as stored values. A texel with another value stands
    // for the nearest point with a value in this range, where one is near (nearestOfValue). Masks need this:
    // a single voxel of a mask has a surface at its own value, which is not one that is shown. Without limits
    // each texel stands for the surface of its own value.
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    std::uint64_t seed = 1;
    SimdTarget simd = SimdTarget::Auto;
};

// Returns whether one point light is sampled at a time, in proportion to its unshadowed light: where there
// are more than a few. The naive way samples all.
bool choosesLights(const LightSetup& setup, const TexelSampling& sampling);

// Running mean of a texel's samples.
struct TexelSum {
    // Irradiance / pi: the radiance of a white diffuse surface. 0 where the texel lies on no surface (the
    // gradient is zero), or on both sides of a solid that is thinner than a voxel: samples is then negative,
    // and no more are added.
    glm::vec3 mean{0.0f};
    float samples = 0;
    float squares = 0;  // sum of squared distances of the samples' luminance from its mean (Welford)
};

// Lights texels of one volume. Immutable, all functions may be called from any thread.
class TexelLighter {
public:
    // volume must outlive this object. texels: frame of the grid of texels, with the same axes. Throws Error
    // for volumes of less than 2 voxels along an axis.
    TexelLighter(const GreyVolume& volume, const VolumeFrame& texels, const LightSetup& setup,
                 const TexelSampling& sampling);
    ~TexelLighter();

    // Returns the bytes that it will take at most in addition, without those that each thread takes for its
    // paths.
    std::size_t bytesToCome() const;

    // Adds samples [sums[n].samples, sums[n].samples + count) to each texel. The result depends only on the
    // texel, the seed and the sample numbers: not on threads, nor, except for rounding, on how samples are
    // split over calls.
    void addIrradiance(std::span<const glm::ivec3> texels, int count, std::span<TexelSum> sums) const;

    // A point between texels, on a surface that is shown.
    struct SurfacePoint {
        glm::dvec3 voxel{0.0};       // position in the volume's grid; clamped to its box
        double isovalue = 0;         // the surface's, a stored number
        glm::dvec3 towardsEye{0.0};  // unit, world: used as the normal where the gradient vanishes
        std::uint64_t number = 0;    // selects its random numbers, as a texel's index does
    };
    // Adds samples at points. A point with neither gradient nor towardsEye gets samples -1.
    void addIrradianceAt(std::span<const SurfacePoint> points, int count, std::span<TexelSum> sums) const;

    // Adds the transfer of distant light in harmonics (eq. 4 to 8; Y4): `count` samples from `firstSample`
    // on, to sums of harmonicsCount(order) * channels floats per texel (coefficient first, then channel),
    // already divided by pi, so that the dot product with the light's coefficients is what addIrradiance()
    // gives. channels: 1 (grey albedo: the mean of the three) or 3. The sums are sums of samples, not means.
    // alive[n]: false where the texel lies on no surface, or on two.
    void addTransfer(std::span<const glm::ivec3> texels, int firstSample, int count, int order, int channels,
                     std::span<float> sums, std::span<std::uint8_t> alive) const;

    // Isovalue (stored number) and unit normal (world, towards smaller values) at a texel; the normal is 0
    // where the gradient vanishes.
    struct TexelPlace {
        float isovalue;
        glm::dvec3 normal;
    };
    TexelPlace place(const glm::ivec3& texel) const;

private:
    struct State;
    std::unique_ptr<State> mState;
};

}  // namespace stereonav
