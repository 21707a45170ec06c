#include "app/scene/volume/ambient.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <tuple>

#include "app/scene/volume/side.h"
#include "engine/base/error.h"
#include "engine/light/occlusion/occlusion.h"

namespace stereonav {
namespace {

constexpr double kUsualStrength = 1;  // no place is brighter than its colour

glm::ivec3 voxelsOf(const VolumeFrame& frame, const char* option, double radius) {
    const double largest = largestOcclusionRadius(frame);
    if (radius > largest * (1 + 1e-6))
        throw Error(option, "",
                    fmt::format("expected at most {:.6g} millimetres in this volume, which are {} voxels, "
                                "got {:.6g}",
                                1000 * largest, kMostOcclusionRadius, 1000 * radius),
                    "choose a smaller one");
    return occlusionRadius(frame, radius);
}

// radiusOption: the option that the radius comes from.
ModulationSetting modulationSetting(const VolumeOptions& options, const VolumeFrame& frame,
                                    const char* radiusOption) {
    ModulationSetting setting;
    setting.by = options.modulate == Modulation::Variance ? ModulatedBy::Variance : ModulatedBy::Gradient;
    if (setting.by == ModulatedBy::Gradient) setting.openness = options.ambientMethod;
    setting.sigma = options.modulateSigma;
    setting.radius = voxelsOf(frame, radiusOption, modulationRadius(options, frame));
    return setting;
}

// Returns the options that a chosen sigma depends on. The isovalue is part of the function of --opacity.
auto shownBy(const VolumeOptions& o) {
    return std::make_tuple(o.transfer, o.opacity, o.opacity ? o.isovalue : std::nullopt);
}

}  // namespace

bool modulates(const VolumeOptions& options) {
    return options.modulate != Modulation::None;
}

double modulationRadius(const VolumeOptions& options, const VolumeFrame& frame) {
    // Radius of 10 voxels, as in Ruiz et al. 2010, section 4.2.
    const double usual = 10 * std::min({frame.spacing.x, frame.spacing.y, frame.spacing.z});
    if (options.modulateRadius_mm) return *options.modulateRadius_mm / 1000;
    return options.ambient_mm ? *options.ambient_mm / 1000 : usual;
}

void applyAmbient(const VolumeOptions& options, const VolumeOptions* made, ColonScene& scene,
                  Progress& progress) {
    AmbientLook& look = scene.volume.look.occlusion;
    if (!options.ambient_mm) {
        look = {};
        return;
    }
    sideOf(scene)->expectOutside("--ambient");
    look.strength = static_cast<float>(options.ambientStrength.value_or(kUsualStrength));
    look.lampShare = static_cast<float>(options.ambientLamp.value_or(0));
    const OcclusionEstimate estimate = options.ambientMethod;
    const GreyVolume& field = scene.volume.field;
    const glm::ivec3 radius = voxelsOf(field.frame, "--ambient", *options.ambient_mm / 1000);
    const bool same = made && look.openness &&
                      occlusionRadius(field.frame, *made->ambient_mm / 1000) == radius &&
                      made->ambientMethod == estimate;
    if (same) return;
    look.openness =
        std::make_shared<const OpennessVolume>(estimateOpenness(field, estimate, radius, progress));
}

std::optional<double> applyModulation(const VolumeOptions& options, const VolumeOptions* made,
                                      const std::optional<double>& sigma, ColonScene& scene,
                                      Progress& progress) {
    std::shared_ptr<const Volume<std::uint8_t>>& to = scene.volume.look.modulation;
    if (!modulates(options)) {
        to = nullptr;
        return std::nullopt;
    }
    sideOf(scene)->expectOutside("--modulate");
    const GreyVolume& field = scene.volume.field;
    const bool own = options.modulateRadius_mm || !options.ambient_mm;
    const ModulationSetting setting =
        modulationSetting(options, field.frame, own ? "--modulate-radius" : "--ambient");
    const bool same = made && to && setting == modulationSetting(*made, field.frame, "") &&
                      (setting.sigma || shownBy(*made) == shownBy(options));
    if (same) return sigma;
    OpacityModulation modulation = opacityModulation(field, setting, scene.volume.look.transfer, progress);
    to = std::make_shared<const Volume<std::uint8_t>>(std::move(modulation.share));
    return modulation.sigma;
}

}  // namespace stereonav
