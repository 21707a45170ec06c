#include "app/scene/terrain_loading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/options/option_numbers.h"
#include "app/scene/medium_options.h"
#include "engine/base/error.h"
#include "engine/frame/cast_frames.h"
#include "engine/math/constants.h"
#include "engine/nav/navigator.h"
#include "terrain/scene_file.h"
#include "terrain/terrain_illumination.h"
#include "terrain/terrain_loader.h"
#include "terrain/terrain_renderer.h"

namespace stereonav {
namespace {

constexpr double kCrossingSeconds = 45.0;  // to cross the terrain at normal speed

void setSun(const std::string& text, TerrainLook& look) {
    const std::vector<double> n = numbersIn("--sun", sunNumbers(), text).numbers;
    look.sunAzimuth = std::remainder(n[0], 360.0) * kRadians;
    look.sunElevation = n[1] * kRadians;
}

// Options that this terrain would not show.
void refuseWithoutEffect(const SceneOptions& options, const SceneFile& scene) {
    if (options.openHoles && scene.builtIn)
        throw Error("--open-holes", "", "the built-in terrain has no holes",
                    "leave it out, or name an elevation model");
    if (options.shadeImage && scene.image.empty())
        throw Error("--shade-image", "", "there is no picture to light",
                    "name one with --image, or leave it out");
}

// The scene's file with what the options change.
SceneFile describeTerrain(const SceneOptions& options) {
    SceneFile scene = sceneFileFromName(options.scene);
    if (options.verticalScale > 0.0) scene.verticalScale = options.verticalScale;
    if (options.openHoles) scene.openHoles = true;
    if (!options.image.empty()) scene.image = options.image;
    if (options.shadeImage) scene.look.shadeImage = true;
    if (!options.sky.empty()) scene.sky = options.sky;
    if (!options.light.empty()) scene.light = options.light;
    if (!options.sun.empty()) setSun(options.sun, scene.look);
    if (options.separation_m) scene.separation = options.separation_m;
    if (options.zeroParallax_m) scene.zeroParallax = options.zeroParallax_m;
    if (options.fov_deg > 0.0) scene.verticalFov = options.fov_deg * kRadians;
    scene.colorsAlone = showsMedium(options);
    refuseWithoutEffect(options, scene);
    return scene;
}

// What can only be told once the colours are there.
void refuseSunWithoutEffect(const SceneOptions& options, const TerrainScene& terrain) {
    if (options.sun.empty() || showsMedium(options) || terrain.illumination || terrain.landmarks) return;
    if (terrain.report.colorHoldsSun || terrain.look.specular > 0) return;
    throw Error("--sun", "", "turns nothing: the ground's picture holds the light of its own day",
                "add --shade-image, or leave it out; in pictures also --light auto, once bake has baked this "
                "ground's light");
}

FlightSetting flightSettingOf(const TerrainScene& terrain) {
    const glm::dvec2 spacing = terrain.ground.spacing();
    const double extent =
        std::max(spacing.x * (terrain.ground.width() - 1), spacing.y * (terrain.ground.height() - 1));
    FlightSetting setting;
    setting.clearance = terrain.clearance;
    setting.followHeight = std::max(4 * terrain.clearance, extent / 150);
    setting.speed = extent / kCrossingSeconds;
    setting.groundStep = 0.5 * std::min(spacing.x, spacing.y);
    return setting;
}

}  // namespace

std::vector<NamedPlace> filesOfTerrain(const std::string& toml) {
    const SceneFile scene = readSceneFile(toml);
    std::vector<NamedPlace> files;
    for (const std::filesystem::path& file : {scene.dem, scene.image, scene.sky, scene.light, scene.path})
        files.push_back({"a file of SCENE", file.string()});
    for (const LandmarkFile& landmark : scene.landmarks)
        files.push_back({"a landmark of SCENE", landmark.mesh.string()});
    return files;
}

LoadedScene loadTerrainScene(const SceneOptions& options, SimdTarget simd, Progress& progress) {
    LoadedScene scene;
    scene.name = options.scene.empty() ? "terrain" : options.scene;
    scene.terrain = std::make_unique<TerrainScene>(loadTerrain(describeTerrain(options), progress));
    const TerrainScene& terrain = *scene.terrain;
    refuseSunWithoutEffect(options, terrain);
    auto renderer = std::make_unique<TerrainRenderer>(terrain, simd);
    scene.simd = renderer->target();
    if (terrain.illumination)
        scene.moveSun = [terrain = scene.terrain.get(), renderer = renderer.get()](double azimuth,
                                                                                   double elevation) {
            moveSun(*terrain, azimuth, elevation);
            renderer->sunMoved();
        };
    scene.renderer = std::move(renderer);
    scene.lens = terrain.lens;
    scene.stereo = terrain.stereo;
    scene.startPose = terrain.startPose;
    scene.path = terrain.path;
    scene.frames = std::make_unique<CastFrames>(*scene.renderer);
    scene.methods = methodsFor(*scene.renderer);
    scene.makeFlight = [&terrain]() -> std::unique_ptr<Flight> {
        const auto ground = [&terrain](const glm::dvec2& place) { return terrain.ground.heightAt(place); };
        return std::make_unique<Navigator>(ground, terrain.startPose, flightSettingOf(terrain));
    };
    return scene;
}

}  // namespace stereonav
