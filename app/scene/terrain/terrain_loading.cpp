#include "app/scene/terrain/terrain_loading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/scene/terrain/earth_alone.h"
#include "app/scene/terrain/ground_paint.h"
#include "app/scene/terrain/ground_paint_tracks.h"
#include "app/scene/terrain/shown_terrain.h"
#include "engine/base/error.h"
#include "engine/math/constants.h"
#include "engine/math/earth_bend.h"
#include "terrain/read/scene_file.h"
#include "terrain/scene/followed_track.h"
#include "terrain/scene/terrain_illumination.h"
#include "terrain/scene/terrain_loader.h"

namespace stereonav {
namespace {

constexpr int kStandInSide = 1536;  // samples: read and coloured in a second or two

bool asMedium(const SceneOptions& options) {
    return !options.medium.medium.empty();
}

// Refuses options without effect on this terrain.
void refuseWithoutEffect(const SceneOptions& options, const SceneFile& scene) {
    if (options.openHoles && scene.builtIn)
        throw Error("--open-holes", "", "the built-in terrain has no holes",
                    "leave it out, or name an elevation model");
    if (options.light.kind == LightChoice::Kind::Plain && (scene.builtIn || !scene.image.empty()))
        throw Error("--light plain", "", "no other light is worked out for this ground",
                    "leave it out, or name an elevation model without a picture");
    if (scene.paint != GroundPaint::None && !scene.image.empty())
        throw Error("--paint", "", "the scene file gives the ground a picture: both say what colour it has",
                    "leave one of them out");
    if (options.curvature && !scene.landmarks.empty())
        throw Error("--curvature", "", "does not go with landmarks, which would stand on flat ground",
                    "leave it out, or the landmarks of the scene file");
    if (options.shadeImage && scene.image.empty())
        throw Error("--shade-image", "", "there is no picture to light",
                    "name one with --image, or leave it out");
}

// Returns the scene file's content with the changes that the options make.
SceneFile describeTerrain(const SceneOptions& options) {
    SceneFile scene = sceneFileFromName(options.scene);
    if (options.verticalScale) scene.verticalScale = *options.verticalScale;
    if (options.openHoles) scene.openHoles = true;
    scene.tiles = tilesOf(options.tiles);
    if (options.standInFirst) scene.standInSide = kStandInSide;
    if (!options.image.empty()) scene.image = options.image;
    scene.paint = groundPaintOf(options);
    if (options.shadeImage) scene.look.shadeImage = true;
    if (!options.sky.empty()) scene.sky = options.sky;
    if (options.physicalSky) scene.look.physicalSky = true;
    if (options.visibility_m) scene.look.visibility = *options.visibility_m;
    if (options.light.kind == LightChoice::Kind::Auto) scene.light = "auto";
    if (options.light.kind == LightChoice::Kind::File) scene.light = options.light.file;
    scene.chosen = options.chosenLook && !asMedium(options);
    scene.sunGiven = scene.sunGiven || options.sun.has_value();
    scene.visibilityGiven = options.visibility_m.has_value();
    scene.quickLight = scene.chosen && !options.light.given();
    if (options.sun) scene.look.sunAzimuth = options.sun->azimuth;
    if (options.sun) scene.look.sunElevation = options.sun->elevation;
    if (options.zeroParallax_m) scene.zeroParallax = options.zeroParallax_m;  // the eyes follow it
    if (options.fov_deg) scene.verticalFov = *options.fov_deg * kRadians;
    scene.colorsAlone = asMedium(options);
    refuseWithoutEffect(options, scene);
    return scene;
}

// Checks what depends on the colours, which have to be loaded.
void refuseSunWithoutEffect(const SceneOptions& options, const TerrainScene& terrain) {
    if (!options.sun || asMedium(options) || terrain.illumination || terrain.landmarks) return;
    if (terrain.report.colorHoldsSun || terrain.look.specular > 0 || terrain.look.physicalSky) return;
    throw Error("--sun", "", "has no effect: the ground's picture holds the light that it was taken in",
                "add --shade-image or --sky physical, or leave it out; in pictures also --light auto, once "
                "bake has baked this "
                "ground's light");
}

}  // namespace

GroundTiles tilesOf(TilesChoice choice) {
    return choice == TilesChoice::Auto ? GroundTiles::Auto
           : choice == TilesChoice::On ? GroundTiles::On
                                       : GroundTiles::Off;
}

std::vector<NamedPlace> filesOfTerrain(const std::string& toml) {
    const SceneFile scene = readSceneFile(toml);
    std::vector<NamedPlace> files;
    for (const std::filesystem::path& file : {scene.dem, scene.image, scene.sky, scene.light, scene.path})
        files.push_back({"a file of SCENE", file.string()});
    for (const LandmarkFile& landmark : scene.landmarks)
        files.push_back({"a landmark of SCENE", landmark.mesh.string()});
    return files;
}

TerrainScene terrainOf(const SceneOptions& options, Progress& progress) {
    TerrainScene terrain = loadTerrain(describeTerrain(options), progress);
    refuseSunWithoutEffect(options, terrain);
    if (terrain.look.physicalSky)
        expectEarth(terrain.body, "--sky physical", "scatters light in the Earth's air");
    if (!options.ground.follow.empty()) {
        terrain.path = followedTrack(terrain, options.ground.follow, options.ground.followHeight_m);
        if (!terrain.eyesGiven && !options.separation_m)
            terrain.stereo = followedEyes(options.ground.followHeight_m);
    }
    // Tiled ground has its own detail near the eye, and needs none here.
    terrain.detail = options.groundDetail && !asMedium(options) && !terrain.tiled && !terrain.standIn;
    terrain.weathered = options.chosenLook && terrain.colorSource && !terrain.colorSource->builtIn;
    terrain.ringsMayBeLate = terrain.tiled && options.detailLater;
    terrain.levelOfDetail = options.levelOfDetail;
    // Exaggerated heights sink more by the same factor, so that the same ground stays hidden.
    if (options.curvature) {
        terrain.refraction = options.refraction.value_or(terrain.body.usualRefraction());
        terrain.lens.fall = curvatureFall(*terrain.refraction, terrain.body) * terrain.verticalScale;
    }
    return terrain;
}

std::unique_ptr<Scene> loadTerrainScene(const SceneOptions& options, SimdTarget simd, Progress& progress) {
    Progress loading(progress, 0, 0.8), painting(progress, 0.8, 1);
    auto shown = std::make_unique<ShownTerrain>(terrainOf(options, loading), simd,
                                                options.lightLater && !options.light.given());
    shown->paintGround(options, painting);
    return shown;
}

}  // namespace stereonav
