// Volumetric ambient occlusion (Ruiz et al. 2010): how open each voxel is, O = P(v <= value of the voxel)
// within a box around it, from a few numbers of the box that separable filters find for all voxels at a cost
// that does not grow with the radius. Beside it what such a volume is used for: opacity modulation.
//
// The box. The paper's kernel radius R is the diameter of the tangent sphere (section 4.1). All spheres of
// diameter R that touch the voxel, whatever its normal, lie within R of it, so the box reaches R voxels to
// either side: 2R + 1 voxels an axis, the voxel in the middle. At the volume's faces the box is what lies
// inside: nothing is made up beyond them.
//
// Because of this a flat wall has O = 1/2, not 1: half of the box is the wall itself. The gain of 2 that
// makes a flat wall fully open belongs to the constant k of eq. 5 (AmbientLook::strength).
#pragma once

#include <cstdint>

#include "engine/base/progress.h"
#include "engine/simd/simd_target.h"
#include "engine/volume/volume.h"

namespace stereonav {

enum class OcclusionMethod {
    Reconstructed,  // t^beta from minimum, maximum and mean (section 3.2; R1 of docs/ledger.md)
    DrawnIn,    // Reconstructed between ends at most three standard deviations from the mean, which is ours
    Gaussian,   // from mean and variance (section 3.3; R2)
    Chebyshev,  // Penner and Mitchell 2008: the one-tailed bound from mean and variance (R4)
};

// A method with what it leaves open.
struct OcclusionEstimate {
    OcclusionMethod method = OcclusionMethod::Gaussian;
    double beta = 0;        // Reconstructed: t^beta with this one, 0.01 to 100; 0: that of the box's mean
    double deviations = 3;  // DrawnIn: how far its ends lie from the mean at most, 1 to 10

    OcclusionEstimate() = default;
    OcclusionEstimate(OcclusionMethod m) : method(m) {}
    bool operator==(const OcclusionEstimate&) const = default;
};
// Ranges of OcclusionEstimate::beta and deviations.
constexpr double kLeastBeta = 0.01, kMostBeta = 100, kLeastDeviations = 1, kMostDeviations = 10;

constexpr float kFlatWallGain = 2.0f;  // on openness

// Openness, 0..255 for 0..1: one byte a voxel.
using OpennessVolume = Volume<std::uint8_t>;

constexpr int kMostOcclusionRadius = 64;  // voxels; sums over (2 * 64 + 1)^3 of any 16-bit values are exact

// Returns voxels an axis for a radius in metres, so that the box is a cube in space when spacings differ; 0
// along an axis whose spacing is more than twice as long. At least 1 along some axis; along an axis of at
// most kMostOcclusionRadius + 1 voxels no more than hold all of it. Throws Error for a radius that is not
// above 0 or larger than largestOcclusionRadius().
glm::ivec3 occlusionRadius(const VolumeFrame& frame, double radius);
// Returns metres; infinite in a volume that a box of kMostOcclusionRadius holds whatever its middle.
double largestOcclusionRadius(const VolumeFrame& frame);

// Estimates openness. radius: voxels, 0..kMostOcclusionRadius an axis and not 0 along all. Integer sums and
// extrema are exact, so neither an offset nor a positive scale of the values changes the result by a bit; a
// negative scale turns open and occluded around; scale 0 (all values equal) gives 1/2 everywhere. The same
// bytes for any thread count and instruction set. Throws Error (radius, the estimate's numbers, empty
// volume), Cancelled.
OpennessVolume estimateOpenness(const GreyVolume& volume, const OcclusionEstimate& estimate,
                                const glm::ivec3& radius, Progress& progress,
                                SimdTarget target = SimdTarget::Auto);

// Returns what opacity is multiplied with, 0..255 for 0..1: min(variance / sigmaMax^2, 1) of the values in
// the box (section 4.2; R5). sigmaMax: in values (HU), > 0. Throws as estimateOpenness() does.
Volume<std::uint8_t> varianceModulation(const GreyVolume& volume, const glm::ivec3& radius, double sigmaMax,
                                        Progress& progress, SimdTarget target = SimdTarget::Auto);

// Returns the same from how fast the openness changes: min(|gradient| / gradientMax, 1), the gradient (of O
// in 0..1, a voxel) by four-dimensional linear regression. gradientMax > 0, in 1/voxel. Throws Error.
Volume<std::uint8_t> gradientModulation(const OpennessVolume& openness, double gradientMax);

}  // namespace stereonav
