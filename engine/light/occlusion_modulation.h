// Opacity modulation as a renderer takes it (Ruiz et al. 2010, section 4.2; R5): what differs from its
// surroundings stays, what lies among its like becomes clear, so that inner structures show. The measures are
// those of occlusion.h; here they get their scale.
#pragma once

#include "engine/light/occlusion.h"
#include "engine/volume/transfer_function.h"

namespace stereonav {

enum class ModulatedBy {
    Variance,  // of the values in the box
    Gradient,  // of the openness that the Gaussian estimates (R2)
};

// Share of the voxels that keep all their opacity, among those that the transfer function shows and whose
// measure is above 0. The paper names a greatest variance of 5 without its unit.
constexpr double kWhollyOpaque = 0.1;

// 0..255 for 0..1. Where no shown voxel differs from its surroundings nothing is left: 0 everywhere shown.
// radius: as estimateOpenness. Throws Error, Cancelled.
Volume<std::uint8_t> opacityModulation(const GreyVolume& volume, ModulatedBy by, const glm::ivec3& radius,
                                       const TransferFunction& transfer, Progress& progress);

}  // namespace stereonav
