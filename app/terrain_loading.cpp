#include "app/terrain_loading.h"

#include <algorithm>
#include <numbers>

#include "engine/nav/navigator.h"
#include "terrain/terrain_loader.h"
#include "terrain/terrain_renderer.h"

namespace stereonav {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;
constexpr double kCrossingSeconds = 45.0;  // to cross the terrain at normal speed

// The scene's file with what the options change.
SceneFile describeTerrain(const SceneOptions& options) {
    SceneFile scene = sceneFileFromName(options.scene);
    if (options.verticalScale > 0.0) scene.verticalScale = options.verticalScale;
    if (options.openHoles) scene.openHoles = true;
    if (!options.image.empty()) scene.image = options.image;
    if (!options.sky.empty()) scene.sky = options.sky;
    if (options.separation_m) scene.separation = options.separation_m;
    if (options.zeroParallax_m) scene.zeroParallax = options.zeroParallax_m;
    if (options.fov_deg > 0.0) scene.verticalFov = options.fov_deg * kRadians;
    return scene;
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

LoadedScene loadTerrainScene(const SceneOptions& options, SimdTarget simd, Progress& progress) {
    LoadedScene scene;
    scene.name = options.scene.empty() ? "terrain" : options.scene;
    scene.terrain = std::make_unique<TerrainScene>(loadTerrain(describeTerrain(options), progress));
    const TerrainScene& terrain = *scene.terrain;
    auto renderer = std::make_unique<TerrainRenderer>(terrain, simd);
    scene.simd = renderer->target();
    scene.renderer = std::move(renderer);
    scene.lens = terrain.lens;
    scene.stereo = terrain.stereo;
    scene.startPose = terrain.startPose;
    scene.path = terrain.path;
    scene.methods = methodsFor(*scene.renderer);
    scene.makeFlight = [&terrain]() -> std::unique_ptr<Flight> {
        const auto ground = [&terrain](const glm::dvec2& place) { return terrain.ground.heightAt(place); };
        return std::make_unique<Navigator>(ground, terrain.startPose, flightSettingOf(terrain));
    };
    return scene;
}

}  // namespace stereonav
