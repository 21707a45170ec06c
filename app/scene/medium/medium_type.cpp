#include "app/scene/medium/medium_type.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "app/scene/medium/field.h"
#include "app/scene/medium/shown_medium.h"
#include "app/scene/type/outside_view.h"
#include "engine/light/skies/sky_map.h"
#include "engine/math/constants.h"
#include "engine/medium/model/built_in_media.h"
#include "engine/medium/model/noise_file.h"

namespace stereonav {
namespace {

// Direction of light on wax by default: from the left and behind, so that it shines through.
constexpr double kWaxAzimuth = 300 * kRadians, kWaxElevation = 30 * kRadians;
// Radiance of parallel light at which white media are just below white on the screen.
constexpr float kCloudRadiance = 0.6f, kWaxRadiance = 0.75f;

// Returns the sky over a sea, linear RGB, by a unit direction: below the horizon dark water, which haze hides
// with its distance.
glm::vec3 skyOverSea(const glm::vec3& direction) {
    const glm::vec3 water(0.05f, 0.13f, 0.20f), horizon = gradientSky({1, 0, 0});
    if (direction.z >= 0) return gradientSky(direction);
    return glm::mix(water, horizon, std::exp(7 * direction.z));
}

void makeBuiltIn(const SceneOptions& options, SimdTarget, Progress&, ShownMedium& scene) {
    const bool cloud = options.scene == "cloud";
    MediumScene& shown = scene.medium();
    const std::shared_ptr<GreyVolume> field = cloud                ? makeCloudField()
                                              : options.chosenLook ? makeWaxRabbit()
                                                                   : makeWaxField();
    const glm::dvec3 size = glm::dvec3(field->frame.size) * field->frame.spacing;
    shown.transfer = options.medium.medium.empty() ? options.scene : options.medium.medium;
    shown.noise = !options.medium.noise.empty() ? options.medium.noise : cloud ? "cloud" : "none";
    Perturbation noise = cloud && options.medium.noise.empty()
                             ? cloudPerturbation()
                             : findNoise(shown.noise, std::max({size.x, size.y, size.z}));
    putField(field, std::move(noise), shown);
    if (cloud) {
        shown.sky = [over = options.chosenLook ? skyOverSea : gradientSky](const glm::dvec3& direction) {
            return over(glm::vec3(direction));
        };
        shown.turnLight(kLightAzimuth, kLightElevation);
        shown.look.light.radiance = glm::vec3(kCloudRadiance);
    } else {
        shown.look.light.radiance = glm::vec3(kWaxRadiance);
        shown.look.background = glm::vec3(0.02f);
        shown.turnLight(kWaxAzimuth, kWaxElevation);
    }
    // Bounds without the noise, whose displacements may reach anywhere.
    const WorldBox box = Medium(field, findMediumTransfer(shown.transfer)).bounds();
    seeFromOutside(box.low, box.high, SeenAs::Outside, "the flight around the medium", scene);
    scene.flyFreely();
}

}  // namespace

const SceneType& builtInMediumType() {
    static const SceneType type{.noun = "medium",
                                .builtIn = {"cloud", "wax"},
                                .optionsFor = [](const std::string&) { return scene_type::kBuiltInMedium; },
                                .makeMedium = makeBuiltIn};
    return type;
}

}  // namespace stereonav
