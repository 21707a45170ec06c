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
#include "engine/medium/model/noise_file.h"

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
