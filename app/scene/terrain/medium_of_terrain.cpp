#include "app/scene/terrain/medium_of_terrain.h"

#include "app/scene/terrain/height_volume.h"
#include "app/scene/terrain/shown_terrain.h"
#include "app/scene/terrain/terrain_facts.h"
#include "app/scene/terrain/terrain_loading.h"
#include "engine/light/skies/sky_map.h"

namespace stereonav {
namespace {

constexpr float kSnowRadiance =
    0.65f;  // radiance of light on terrain, except in its own colours, which are dark
// Slices and light texels: ridges and valleys show grain where texels are wider than a hundred metres.
constexpr int kTerrainSlices = 1200, kTerrainLight = 512;

}  // namespace

void makeFromTerrain(const SceneOptions& options, SimdTarget, Progress& progress, ShownMedium& scene) {
    const TerrainScene& terrain = scene.hold(std::make_unique<TerrainScene>(terrainOf(options, progress)));
    setViews(terrain, scene);
    scene.alsoOffer<const TerrainScene>(terrain);
    const TerrainSurvey& survey = scene.hold(std::make_unique<TerrainSurvey>(terrain));
    survey.offerAll([&scene](auto& capability) { scene.alsoOffer(capability); });
    scene.alsoDescribe([&scene] { return factForJson("terrain", factsOfTerrain(scene)); });
    scene.flyAs([&terrain] { return flightOver(terrain); });
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

}  // namespace stereonav
