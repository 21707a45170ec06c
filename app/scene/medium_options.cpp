// Texts become numbers here, each with an error that names its option.
#include "app/scene/medium_options.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "app/options/option_numbers.h"
#include "app/scene/volume_light.h"
#include "engine/base/error.h"
#include "engine/math/constants.h"
#include "engine/medium/noise_file.h"

namespace stereonav {
namespace {

constexpr double kHeadLampCone = 2.2;  // radians: wider than what is seen

glm::vec3 lightColorFromText(const std::string& text) {
    const std::vector<double> n = numbersIn("--light-color", colorNumbers(), text).numbers;
    return n.size() == 1 ? glm::vec3(static_cast<float>(n[0])) : glm::vec3(n[0], n[1], n[2]);
}

struct Direction {
    double azimuth = 0, elevation = 0;  // radians
};
Direction directionFromText(const std::string& text) {
    const std::vector<double> n = numbersIn("--light-from", sunNumbers(), text).numbers;
    return {std::remainder(n[0], 360.0) * kRadians, n[1] * kRadians};
}

// The lamp's place; none at the head.
std::optional<glm::dvec3> lampFromText(const std::string& text) {
    const GivenNumbers given = numbersIn("--lamp", lampNumbers(), text);
    if (given.word == kHeadLamp) return std::nullopt;
    return glm::dvec3(given.numbers[0], given.numbers[1], given.numbers[2]);
}

MediumModel modelFromText(const std::string& text) {
    std::string known;
    for (const MediumModel model :
         {MediumModel::Emission, MediumModel::Surface, MediumModel::Direct, MediumModel::Indirect}) {
        if (nameOf(model) == text) return model;
        known += (known.empty() ? "" : ", ") + std::string(nameOf(model));
    }
    throw Error("--model", "", "there is no model \"" + text + "\"", "the models are " + known);
}

void refuseAll(std::initializer_list<std::pair<const char*, bool>> given, const std::string& problem,
               const char* advice) {
    for (const auto& [option, is] : given)
        if (is) throw Error(option, "", problem, advice);
}

void refuseWithoutMedium(const MediumOptions& m) {
    refuseAll({{"--model", !m.model.empty()},
               {"--phase", !m.phase.empty()},
               {"--light-from", !m.lightFrom.empty()},
               {"--lamp", !m.lamp.empty()},
               {"--light-color", !m.lightColor.empty()},
               {"--noise", !m.noise.empty()},
               {"--mist", !m.mist.empty()},
               {"--slices", m.slices.has_value()},
               {"--light-size", m.lightSize.has_value()},
               {"--cone", m.cone_deg.has_value()},
               {"--shading-width", m.shadingWidth.has_value()}},
              "expected with a medium", "add --medium, or show cloud or wax");
}

// What a model leaves out; in a window a key chooses another one.
void refuseBesideModel(const SceneOptions& options) {
    const MediumOptions& m = options.medium;
    if (m.model.empty() || options.inWindow) return;
    const MediumModel model = modelFromText(m.model);
    const bool spreads = model == MediumModel::Indirect, scatters = spreads || model == MediumModel::Direct;
    const bool lit = model != MediumModel::Emission;
    const std::string problem = "has no effect on the model " + m.model;
    constexpr const char* kOtherModel = "leave it out, or choose another --model";
    if (!lit) refuseAll({{"--light-color", !m.lightColor.empty()}}, problem, kOtherModel);
    if (!scatters) refuseAll({{"--phase", !m.phase.empty()}}, problem, kOtherModel);
    if (!spreads) refuseAll({{"--cone", m.cone_deg.has_value()}}, problem, kOtherModel);
}

void refuseOfOtherKinds(const SceneOptions& options) {
    const VolumeOptions& v = options.volume;
    refuseAll({{"--transfer", !v.transfer.empty()},
               {"--opacity", v.opacity.has_value()},
               {"--shading", !v.shading.empty()},
               {"--modulate", !v.modulate.empty()},
               {"--modulate-radius", v.modulateRadius_mm.has_value()},
               {"--modulate-sigma", v.modulateSigma.has_value()},
               {"--ambient", v.ambient_mm.has_value()},
               {"--ambient-method", !v.ambientMethod.empty()},
               {"--ambient-strength", v.ambientStrength.has_value()},
               {"--ambient-lamp", v.ambientLamp.has_value()}},
              "does not go with a medium, which has its own", "leave it out, or leave out --medium");
    if (isLazyLight(options.light))
        throw Error("--light", "", options.light + " expects an opaque surface, this is a medium",
                    "bake the light and name its file");
}

}  // namespace

bool showsMedium(const SceneOptions& options) {
    return options.scene == "cloud" || options.scene == "wax" || !options.medium.medium.empty();
}

std::optional<Mist> mistFromText(const std::string& text) {
    if (text.empty()) return std::nullopt;
    const std::vector<double> n = numbersIn("--mist", mistNumbers(), text).numbers;
    return Mist{n[0], n[1]};
}

void checkMediumOptions(const SceneOptions& options) {
    const MediumOptions& m = options.medium;
    if (!showsMedium(options)) return refuseWithoutMedium(m);
    refuseOfOtherKinds(options);
    refuseBesideModel(options);
    if (!m.lamp.empty() && !m.lightFrom.empty())
        throw Error("--lamp", "", "does not go with --light-from", "leave one of them out");
    if (!m.model.empty()) modelFromText(m.model);
    if (!m.phase.empty()) findPhaseFunction(m.phase, "--phase");
    if (!m.noise.empty()) findNoise(m.noise, 1);
    if (!m.medium.empty() && m.medium != kGroundMedium) findMediumTransfer(m.medium);
}

void applyMediumOptions(const MediumOptions& options, MediumScene& scene) {
    MediumLook& look = scene.look;
    if (!options.model.empty()) look.model = modelFromText(options.model);
    if (!options.phase.empty()) {
        look.phase = findPhaseFunction(options.phase, "--phase");
        scene.phase = options.phase;
    }
    if (!options.lightColor.empty()) look.light.radiance = lightColorFromText(options.lightColor);
    if (!options.lightFrom.empty()) {
        const Direction from = directionFromText(options.lightFrom);
        look.light.kind = MediumLight::Kind::Parallel;
        scene.turnLight(from.azimuth, from.elevation);
    }
    if (!options.lamp.empty()) {
        const std::optional<glm::dvec3> place = lampFromText(options.lamp);
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
