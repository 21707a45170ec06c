#include "app/scene/medium/options.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/math/constants.h"
#include "engine/medium/model/noise_file.h"

namespace stereonav {
namespace {

constexpr double kHeadLampCone = 2.2;  // radians: wider than the field of view

}  // namespace

void checkMediumOptions(const SceneOptions& options) {
    const MediumOptions& m = options.medium;
    if (!m.phase.empty()) findPhaseFunction(m.phase, "--phase");
    if (!m.noise.empty()) findNoise(m.noise, 1);
    if (!m.medium.empty() && !m.ground()) findMediumTransfer(m.medium);
}

void applyMediumOptions(const MediumOptions& options, MediumScene& scene) {
    MediumLook& look = scene.look;
    if (options.model) look.model = *options.model;
    if (!options.phase.empty()) {
        look.phase = findPhaseFunction(options.phase, "--phase");
        scene.phase = options.phase;
    }
    if (options.lightColor) look.light.radiance = *options.lightColor;
    if (options.lightFrom) {
        look.light.kind = MediumLight::Kind::Parallel;
        scene.turnLight(options.lightFrom->azimuth, options.lightFrom->elevation);
    }
    if (options.lamp) {
        const std::optional<glm::dvec3>& place = options.lamp->place;
        look.light.kind = MediumLight::Kind::Lamp;
        look.light.atHead = !place.has_value();
        look.light.coneAngle = kHeadLampCone;
        if (place) {
            const glm::dvec3 way = scene.medium.bounds().center() - *place;
            look.light.position = *place;
            look.light.direction = glm::length(way) > 0 ? glm::normalize(way) : glm::dvec3(0, 0, -1);
        }
    }
    if (options.slices) scene.sweep.slices = *options.slices;
    if (options.lightSize) scene.sweep.lightSize = *options.lightSize;
    if (options.cone_deg) scene.sweep.coneAngle = *options.cone_deg * kRadians;
    if (options.shadingWidth) scene.sweep.shadingWidth = *options.shadingWidth;
}

}  // namespace stereonav
