// Opacity modulation as a renderer takes it (Ruiz et al. 2010, section 4.2; R5 of docs/ledger.md): what
// differs from its surroundings stays, what lies among its like becomes clear, so that inner structures show.
// The measures are those of occlusion.h; here they get their scale.
#pragma once

#include <optional>

#include "engine/light/occlusion/occlusion.h"
#include "engine/volume/transfer_function.h"

namespace stereonav {

enum class ModulatedBy {
    Variance,  // variance of the values in the box
    Gradient,  // gradient of the openness that is estimated from it
};

// Share of the voxels that keep all their opacity where no sigma is given, among those that the transfer
// function shows and whose measure is above 0. The paper names a greatest variance of 5 without its unit.
constexpr double kWhollyOpaque = 0.1;

struct ModulationSetting {
    ModulatedBy by = ModulatedBy::Variance;
    glm::ivec3 radius{10};       // voxels, as estimateOpenness takes it
    OcclusionEstimate openness;  // how it is estimated, for Gradient
    // The measure from where on opacity stays whole, above 0. Variance: the paper's sigma_max, a standard
    // deviation in the volume's values; Gradient: a change of openness a voxel, at most kSteepestOpenness.
    // None: chosen.
    std::optional<double> sigma;

    bool operator==(const ModulationSetting&) const = default;
};
constexpr double kSteepestOpenness = 1;  // a voxel

// The factor on opacity, and the scale that it was made with.
struct OpacityModulation {
    Volume<std::uint8_t> share;  // factor on opacity, 0..255 for 0..1
    double sigma = 0;            // given, or chosen, as ModulationSetting::sigma
};

// Finds the modulation. Where no shown voxel differs from its surroundings nothing is left: 0 everywhere
// shown. transfer: what the chosen sigma looks at. Throws Error, Cancelled.
OpacityModulation opacityModulation(const GreyVolume& volume, const ModulationSetting& setting,
                                    const TransferFunction& transfer, Progress& progress);

}  // namespace stereonav
