#include "app/scene/volume/medium_of_volume.h"

#include <algorithm>

#include "app/scene/medium/field.h"
#include "app/scene/volume/seen_light.h"
#include "app/scene/volume/volume_facts.h"
#include "app/scene/volume/volume_loading.h"
#include "engine/medium/model/noise_file.h"

namespace stereonav {
namespace {

constexpr double kLampCone = 2.2;  // radians: wider than the field of view
// Radiance of parallel light and of a lamp at which white media are just below white on the screen.
constexpr float kVolumeRadiance = 0.85f, kLampRadiance = 0.7f;
// Slices for a colon: its wall shows grain at a distance with 250, and none in our pictures with 400.
constexpr int kColonSlices = 500;

void lightAtHead(const ColonScene& colon, MediumScene& shown) {
    MediumLight& light = shown.look.light;
    light.kind = MediumLight::Kind::Lamp;
    light.atHead = true;
    light.coneAngle = kLampCone;
    light.radiance = glm::vec3(kLampRadiance);
    light.falloff = colon.volume.look.falloff;
}

void offerWorld(VolumeWorld& world, SimdTarget simd, ShownMedium& scene) {
    world.offerAll([&scene](auto& capability) { scene.alsoOffer(capability); });
    scene.alsoDescribe([&scene] { return factForJson("volume", factsOfVolume(scene)); });
    scene.flyAs([&world] { return world.makeFlight(); });
    scene.checkBy([&world](const RecordedPath& path, const std::string& file) { world.check(path, file); });
    if (!world.eyesFollow()) return;
    VolumeCasting casting;
    casting.target = simd;
    world.setWall(&scene.hold(std::make_unique<VolumeRenderer>(world.colon().volume, casting)));
}

void offerLight(const VolumeLighting& light, ShownMedium& scene) {
    if (!light.lazy && !light.sky) return;
    auto& seen = scene.hold(std::make_unique<SeenVolumeLight>(light.lazy, light.sky));
    scene.alsoOffer<SeenLight>(seen);
    if (seen.turns()) scene.turnInstead(seen);
}

}  // namespace

void makeFromVolume(const SceneOptions& options, SimdTarget simd, Progress& progress, ShownMedium& scene) {
    SceneOptions reading = options;
    reading.chosenLook = false;  // which is for surfaces and transfer functions
    LitVolume lit = litVolumeOf(reading, progress, true);
    VolumeWorld& world = scene.hold(std::move(lit.world));
    world.setViews(options, scene);
    offerWorld(world, simd, scene);
    offerLight(lit.light, scene);
    const ColonScene& colon = world.colon();
    MediumScene& shown = scene.medium();
    std::shared_ptr<const GreyVolume> field;
    if (!colon.study.empty())
        field = std::make_shared<GreyVolume>(std::move(world.colon().study));
    else  // field that the scene already holds and that lives as long
        field = std::shared_ptr<const GreyVolume>(std::shared_ptr<void>(), &colon.volume.field);
    const glm::dvec3 size = glm::dvec3(field->frame.size) * field->frame.spacing;
    shown.transfer = options.medium.medium;
    Perturbation noise;
    if (!options.medium.noise.empty()) {
        shown.noise = options.medium.noise;
        noise = findNoise(shown.noise, std::max({size.x, size.y, size.z}));
    }
    putField(field, std::move(noise), shown);
    shown.look.background = colon.volume.look.background;
    shown.look.baked = colon.volume.look.baked;
    if (world.side().letsLightIn()) {
        shown.turnLight(kLightAzimuth, kLightElevation);
        shown.look.light.radiance = glm::vec3(kVolumeRadiance);
        scene.flyFreely();
    } else {
        shown.sweep.slices = kColonSlices;
        lightAtHead(colon, shown);
    }
}

}  // namespace stereonav
