// Scenes are loaded as ever; what they hold becomes a medium, and sweeps take the place of rays.
#include "app/scene/medium_loading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "app/scene/colon_loading.h"
#include "app/scene/medium_options.h"
#include "app/scene/medium_terrain.h"
#include "app/scene/shown_medium.h"
#include "app/scene/terrain_loading.h"
#include "colon/built_in/built_in_colon.h"
#include "colon/study/study.h"
#include "engine/base/error.h"
#include "engine/math/constants.h"
#include "engine/medium/model/built_in_media.h"
#include "engine/medium/model/noise_file.h"
#include "terrain/light/sky_map.h"

namespace stereonav {
namespace {

constexpr double kFov = 40 * kRadians;
constexpr double kOrbitSeconds = 15;
constexpr int kOrbitSamples = 180;
// Where light comes from when nothing is said, seen by one who looks north: from the left, behind and above;
// of wax from the left and from beyond it, so that it shines through.
constexpr double kLightAzimuth = 235 * kRadians, kLightElevation = 40 * kRadians;
constexpr double kWaxAzimuth = 300 * kRadians, kWaxElevation = 30 * kRadians;
constexpr double kLampCone = 2.2;  // radians: wider than what is seen
// Of parallel light, so that white media are just below white on the screen.
constexpr float kCloudRadiance = 0.6f, kWaxRadiance = 0.75f, kVolumeRadiance = 0.85f, kLampRadiance = 0.7f;
constexpr float kSnowRadiance = 0.65f;  // of terrain, but for its own colours, which are dark
constexpr double kFraming = 0.85;       // of the distance at which a ball around the bounds fills the picture
// A colon's wall shows grain far away with 250 slices, none in the pictures looked at with 400; ridges and
// valleys where the light's texels are more than a hundred metres wide.
constexpr int kTerrainSlices = 1200, kTerrainLight = 512, kColonSlices = 500;

// Around the medium, looking at its middle from a little above; at turn 0 northwards.
Pose orbitPose(const glm::dvec3& middle, double distance, double turn) {
    Pose pose = poseFromAngles(middle, turn, -0.15, 0);
    pose.position -= distance * pose.forward();
    return pose;
}

void seeFromOutside(const WorldBox& box, Scene& scene) {
    const double radius = std::max(0.5 * glm::length(box.high - box.low), 1e-6);
    const double distance = kFraming * radius / std::sin(0.5 * kFov);
    scene.lens.verticalFov = kFov;
    scene.lens.nearDepth = 0.005 * radius;
    scene.stereo.zeroParallax = distance;
    scene.stereo.separation = distance / 30;
    scene.startPose = orbitPose(box.center(), distance, 0);
    std::vector<PathSample> samples;
    for (int n = 0; n <= kOrbitSamples; ++n)
        samples.push_back({n * kOrbitSeconds / kOrbitSamples,
                           orbitPose(box.center(), distance, 2 * kPi * n / kOrbitSamples)});
    scene.path = RecordedPath(std::move(samples), "the flight around the medium");
}

void putField(std::shared_ptr<const GreyVolume> field, Perturbation noise, MediumScene& shown) {
    const MediumTransfer transfer = findMediumTransfer(shown.transfer);
    shown.medium = Medium(field, transfer, noise);
    shown.makeSurface = [field = std::move(field), transfer, noise = std::move(noise)] {
        return Medium(field, allSurface(transfer), noise);
    };
}

void makeBuiltIn(const SceneOptions& options, ShownMedium& scene) {
    const bool cloud = options.scene == "cloud";
    MediumScene& shown = scene.medium();
    const std::shared_ptr<GreyVolume> field = cloud ? makeCloudField() : makeWaxField();
    const glm::dvec3 size = glm::dvec3(field->frame.size) * field->frame.spacing;
    shown.transfer = options.medium.medium.empty() ? options.scene : options.medium.medium;
    shown.noise = !options.medium.noise.empty() ? options.medium.noise : cloud ? "cloud" : "none";
    Perturbation noise = cloud && options.medium.noise.empty()
                             ? cloudPerturbation()
                             : findNoise(shown.noise, std::max({size.x, size.y, size.z}));
    putField(field, std::move(noise), shown);
    if (cloud) {
        shown.sky = [](const glm::dvec3& direction) { return gradientSky(glm::vec3(direction)); };
        shown.turnLight(kLightAzimuth, kLightElevation);
        shown.look.light.radiance = glm::vec3(kCloudRadiance);
    } else {
        shown.look.light.radiance = glm::vec3(kWaxRadiance);
        shown.look.background = glm::vec3(0.02f);
        shown.turnLight(kWaxAzimuth, kWaxElevation);
    }
    // Without the noise, whose displacements may reach anywhere.
    seeFromOutside(Medium(field, findMediumTransfer(shown.transfer)).bounds(), scene);
    adjustViews(options, scene);
    scene.flyFreely();
}

// A colon's field has neither fluid nor what is far from the wall: the study is read again. Null for a mask,
// which has no grey values.
std::shared_ptr<const GreyVolume> studyOf(const SceneOptions& options, Progress& progress) {
    const ColonOptions colon = colonOptionsOf(options);
    if (colon.study.empty()) return std::make_shared<GreyVolume>(builtInColon(colon.builtIn, progress).grey);
    Study study = readStudy(colon.study, colon.reading, progress);
    return study.isMask ? nullptr : std::make_shared<GreyVolume>(std::move(study.grey));
}

void lightAtHead(const ColonScene& colon, MediumScene& shown) {
    MediumLight& light = shown.look.light;
    light.kind = MediumLight::Kind::Lamp;
    light.atHead = true;
    light.coneAngle = kLampCone;
    light.radiance = glm::vec3(kLampRadiance);
    light.falloff = colon.volume.look.falloff;
}

void makeFromVolume(const SceneOptions& options, Progress& progress, ShownMedium& scene) {
    VolumeWorld& world = scene.hold(litVolumeOf(options, progress));
    world.setViews(options, scene);
    const ColonScene& colon = world.colon();
    MediumScene& shown = scene.medium();
    std::shared_ptr<const GreyVolume> field;
    if (colon.isColon()) field = studyOf(options, progress);
    // what the scene holds already, which lives as long
    if (!field) field = std::shared_ptr<const GreyVolume>(std::shared_ptr<void>(), &colon.volume.field);
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
    if (colon.isColon()) {
        shown.sweep.slices = kColonSlices;
        lightAtHead(colon, shown);
    } else {
        shown.turnLight(kLightAzimuth, kLightElevation);
        shown.look.light.radiance = glm::vec3(kVolumeRadiance);
        scene.flyFreely();
    }
}

void makeFromTerrain(const SceneOptions& options, Progress& progress, ShownMedium& scene) {
    const TerrainScene& terrain = scene.hold(terrainOf(options, progress));
    MediumScene& shown = scene.medium();
    shown.transfer = options.medium.medium;
    if (!options.medium.noise.empty()) shown.noise = options.medium.noise;
    shown.sweep.slices = options.medium.slices.value_or(kTerrainSlices);
    shown.sweep.lightSize = options.medium.lightSize.value_or(kTerrainLight);
    shown.medium = terrainMedium(terrain, options.medium, shown.sweep);
    shown.makeSurface = [&shown] { return allSurface(shown.medium); };
    shown.sky = [&terrain](const glm::dvec3& direction) { return skyAt(terrain.sky, direction); };
    shown.turnLight(terrain.look.sunAzimuth, terrain.look.sunElevation);
    if (!options.medium.ground()) shown.look.light.radiance = glm::vec3(kSnowRadiance);
    if (terrain.landmarks) shown.notes.push_back("landmarks are not shown with a medium");
}

}  // namespace

std::unique_ptr<Scene> loadMediumScene(const SceneOptions& options, SimdTarget simd, Progress& progress) {
    const SceneKind kind = kindOf(options.scene);
    auto scene = std::make_unique<ShownMedium>();
    if (kind == SceneKind::Medium)
        makeBuiltIn(options, *scene);
    else if (kind == SceneKind::Terrain)
        makeFromTerrain(options, progress, *scene);
    else
        makeFromVolume(options, progress, *scene);
    applyMediumOptions(options.medium, scene->medium());
    scene->begin(simd);
    return scene;
}

}  // namespace stereonav
