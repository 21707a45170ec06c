// Light at single texels: each takes the isosurface through itself (Wyman et al. 2006, section 4.1, Y1 of
// docs/ledger.md), which is met exactly (Y2) from starts lifted along the smoothed normal (Y3).
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

// How paths are chosen: `Naive` is the paper's (uniform over the hemisphere, no knowledge of the light), kept
// as the baseline and the oracle; each of the others can be switched off alone, to measure what it gains.
struct TexelSampling {
    bool naive = false;
    bool lowDiscrepancy = true;  // else independent random numbers
    bool cosine = true;          // directions by the cosine, else uniform
    bool nextEvent = true;  // the probe sampled by its brightness as well, weighted by the power heuristic
    bool roulette = true;   // dim paths end at random
    bool leaping = true;    // over cells that no surface of this isovalue meets
    // Isovalues of the surfaces that are shown, as the volume stores them: a texel of another value stands
    // for the nearest of these where it lies near (nearestOfValue). Masks need it: what stands alone in one
    // voxel is a surface at that voxel's own value, and none of what is shown. Without limits each texel
    // stands for its own value's.
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    std::uint64_t seed = 1;
    SimdTarget simd = SimdTarget::Auto;
};

// Returns whether point lights are sampled one at a time, by what each would bring unshadowed: where there
// are more than a few. The naive way takes all.
bool choosesLights(const LightSetup& setup, const TexelSampling& sampling);

// Running mean of a texel's samples.
struct TexelSum {
    // Irradiance / pi: what a white diffuse surface would send out. 0 where the texel lies on no surface (the
    // gradient is zero), or on both sides of what is thinner than a voxel: samples is then negative and
    // nothing more is to be done.
    glm::vec3 mean{0.0f};
    float samples = 0;
    float squares = 0;  // sum of squared distances of the samples' luminance from its mean (Welford)
};

// Lights texels of one volume. Immutable, all functions may be called from any thread.
class TexelLighter {
public:
    // volume must outlive this. The texels' grid: frame of the texels, in the same axes. Throws Error for
    // volumes of less than 2 voxels along an axis.
    TexelLighter(const GreyVolume& volume, const VolumeFrame& texels, const LightSetup& setup,
                 const TexelSampling& sampling);
    ~TexelLighter();

    // Returns the bytes that it will take at most beside what it holds, but for what each thread takes for
    // its paths.
    std::size_t bytesToCome() const;

    // Adds samples [sums[n].samples, sums[n].samples + count) to each texel; the result depends on the texel,
    // the seed and the sample numbers alone: neither on threads nor on how samples are split over calls
    // (but for rounding: equal bytes need equal splits).
    void addIrradiance(std::span<const glm::ivec3> texels, int count, std::span<TexelSum> sums) const;

    // A point between texels, on a surface that is shown.
    struct SurfacePoint {
        glm::dvec3 voxel{0.0};       // place in the volume's grid; clamped to its box
        double isovalue = 0;         // the surface's, a stored number
        glm::dvec3 towardsEye{0.0};  // unit, world: the normal where the gradient vanishes
        std::uint64_t number = 0;    // chooses its random numbers, as a texel's place in the grid does
    };
    // Adds samples at such points; one at which there is neither a gradient nor a direction gets samples -1.
    void addIrradianceAt(std::span<const SurfacePoint> points, int count, std::span<TexelSum> sums) const;

    // Adds the transfer of distant light in harmonics (eq. 4 to 8; Y4): `count` samples from `firstSample`
    // on, to sums of harmonicsCount(order) * channels floats a texel (coefficient first, then channel),
    // already divided by pi: dotted with the light's coefficients it is what addIrradiance gives. channels: 1
    // (grey albedo: the mean of the three) or 3. Sums of samples, not means. alive[n]: false where the texel
    // lies on no surface, or on two.
    void addTransfer(std::span<const glm::ivec3> texels, int firstSample, int count, int order, int channels,
                     std::span<float> sums, std::span<std::uint8_t> alive) const;

    // Isovalue (stored number) and unit normal (world, towards smaller values) at a texel; normal 0 where the
    // gradient vanishes.
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
