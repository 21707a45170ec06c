// Everything a terrain needs, in the order it depends on each other: ground, colour, sky, meshes,
// where to stand, how to fly, how far apart the eyes.
#include "terrain/scene/terrain_loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <optional>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/camera/default_eyes.h"
#include "engine/math/constants.h"
#include "terrain/built_in/built_in_terrain.h"
#include "terrain/ground/nodata.h"
#include "terrain/light/atmosphere.h"
#include "terrain/light/fine_bake.h"
#include "terrain/light/quick_light.h"
#include "terrain/light/sky_source.h"
#include "terrain/read/dem_reader.h"
#include "terrain/read/height_limits.h"
#include "terrain/read/raster_file.h"
#include "terrain/scene/first_view.h"
#include "terrain/scene/ground_color.h"
#include "terrain/scene/ground_recolor.h"
#include "terrain/scene/ground_texture.h"
#include "terrain/scene/landmark.h"
#include "terrain/scene/scene_flight.h"
#include "terrain/scene/terrain_illumination.h"
#include "terrain/scene/tiled_ground.h"

namespace stereonav {
namespace {

constexpr double kClearancePerSpacing = 0.25;  // share of the wider spacing
constexpr double kNearPerSpacing = 0.05;       // share of the finer spacing: well inside the clearance
constexpr double kDefaultPitch = -0.2;         // radians; a start without its own looks a little down
constexpr double kFallbackShare = 0.25;        // share of the shorter side, where the view meets no ground

struct LoadedGround {
    DemGrid place;                        // without heights
    std::optional<BuiltInTerrain> built;  // with the heights that it has its colours for, moved from here
};

// Returns whether the ground's colours are to be without light.
bool litLater(const SceneFile& file) {
    return file.colorsAlone || !file.light.empty() || (file.quickLight && !file.builtIn);
}

LoadedGround loadBuiltIn(const SceneFile& file, TerrainScene& scene, Progress& progress) {
    BuiltInTerrain built = builtInUnder({file.seed, file.builtInSize}, file.look, litLater(file), progress);
    const auto [low, high] = std::minmax_element(built.heights.begin(), built.heights.end());
    checkScaledHeights("the built-in terrain", *low, *high, file.verticalScale);
    if (file.verticalScale != 1.0)
        for (float& h : built.heights) h = static_cast<float>(h * file.verticalScale);
    scene.ground = Heightfield(built.size, built.size, glm::dvec2(built.spacing), std::move(built.heights),
                               "the built-in terrain");
    scene.report.driver = "built-in";
    scene.report.projection = fmt::format("none: generated in metres, seed {}", file.seed);
    LoadedGround loaded;
    Georeference& place = loaded.place.source;
    place.width = place.height = built.size;
    place.transform = {0, built.spacing, 0, 0, 0, -built.spacing};
    loaded.place.grid = place;
    loaded.place.spacing = scene.ground.spacing();
    if (file.verticalScale == 1.0) loaded.built = std::move(built);
    return loaded;
}

// Heights, the maxima over blocks of them, and colours; a picture's are checked when its size is known.
double bytesOfGround(double samples, bool tinted) {
    constexpr double kHeights = 4, kMaxima = 4 * 4.0 / 3;
    return (kHeights + kMaxima) * samples + (tinted ? bytesOfTint(samples) : 0);
}

void reportDem(const DemGrid& dem, TerrainReport& report) {
    report.driver = dem.driver;
    report.sourceCrs = dem.crs;
    report.projection = dem.projection;
    report.verticalDatum = dem.verticalDatum;
    report.sourceOffset = dem.sourceOffset;
    report.placed = dem.georeferenced;
    if (report.placed) {
        report.worldCrs = dem.grid.wkt;
        report.worldUnit = dem.spacing.x / dem.grid.transform[1];
    }
    report.sourceUnit = dem.sourceUnit;
    report.placedBy = dem.source.placedBy;
    report.band = dem.band;
    report.heightUnit = dem.heightUnit;
    report.missingValue = dem.missingValue;
    report.sourceSamples = static_cast<long long>(dem.source.width) * dem.source.height;
    report.missingSamples = dem.sourceMissing;
    report.outsideSamples = dem.outside;
    report.notes = dem.notes;
}

double bytesOfTintedGround(double samples) {
    return bytesOfGround(samples, true);
}
double bytesOfPicturedGround(double samples) {
    return bytesOfGround(samples, false);
}

LoadedGround loadDem(const SceneFile& file, TerrainScene& scene, Progress& progress) {
    const auto bytesOf = file.image.empty() ? bytesOfTintedGround : bytesOfPicturedGround;
    const bool tiled = goesIntoTiles(file, bytesOf);
    const bool fills = !tiled && !file.openHoles;
    Progress reading(progress, 0, fills ? 0.7 : 1), filling(progress, 0.7, 1);
    DemGrid dem = tiled ? readTiledGround(file, scene, reading)
                        : readDem(file.dem, file.verticalScale, reading, bytesOf);
    TerrainReport& report = scene.report;
    reportDem(dem, report);
    scene.body = {dem.bodyRadius};
    for (const std::string& note : dem.notes) progress.note(note);
    if (dem.georeferenced) scene.earth = earthPlaces(dem.grid, dem.spacing);
    if (tiled) return {std::move(dem), std::nullopt};
    if (file.openHoles)
        report.openSamples = countMissing(dem.heights);
    else
        report.filledSamples = fillMissing(dem.heights, dem.width, dem.height, dem.spacing, filling);
    scene.ground = Heightfield(dem.width, dem.height, dem.spacing, std::move(dem.heights), file.dem.string());
    return {std::move(dem), std::nullopt};
}

// The latitudes along the ground's middle.
TintPlace tintPlaceOf(const SceneFile& file, const TerrainScene& scene) {
    TintPlace place;
    place.verticalScale = file.verticalScale;
    if (!scene.earth) return place;
    constexpr int kPlaces = 9;
    const Heightfield& ground = scene.ground;
    for (int k = 0; k < kPlaces; ++k) {
        const glm::dvec2 share(0.5, k / (kPlaces - 1.0));
        const auto at = scene.earth->placeAt(
            ground.worldFromGrid(share * glm::dvec2(ground.width() - 1, ground.height() - 1)));
        if (!at || !std::isfinite(at->latitude)) {
            place.latitudes.clear();
            break;
        }
        place.latitudes.push_back(at->latitude);
    }
    return place;
}

GroundColorSource colorSourceOf(const SceneFile& file, const LoadedGround& loaded,
                                const TerrainScene& scene) {
    GroundColorSource source{file.look, litLater(file), file.verticalScale, file.paint, std::nullopt, {}};
    if (loaded.built) source.builtIn = BuiltInOrigin{file.seed, file.builtInSize};
    source.tint = tintPlaceOf(file, scene);
    if (file.chosen) source.tint.palette = GroundPalette::Natural;
    return source;
}

GroundColor colorOf(const SceneFile& file, const LoadedGround& loaded, TerrainScene& scene,
                    Progress& progress) {
    if (!file.image.empty()) {
        TerrainLook look = file.look;
        if (litLater(file)) look.ambient = 1;
        PicturedGround pictured{std::make_shared<const LaidPicture>(file.image, loaded.place), look,
                                tintPlaceOf(file, scene), look.shadeImage || !file.light.empty()};
        for (const std::string& note : pictured.picture->notes()) {
            progress.note(note);
            scene.report.notes.push_back(note);
        }
        // A level in memory is what far ground is seen in: it has no more texels than were counted for it.
        const bool level = scene.tiled || scene.standIn;
        GroundColor color = picturedGround(
            scene.ground, pictured, level ? kLitDensity : std::numeric_limits<double>::infinity(), progress);
        if (scene.tiled) scene.pictured = std::move(pictured);
        return color;
    }
    const GroundColorSource& source = scene.colorSource.emplace(colorSourceOf(file, loaded, scene));
    // Light that is worked out for the whole would take the place of finer parts' own.
    if (!loaded.built && !litLater(file) && !scene.tiled && !scene.standIn) scene.tint = source.tint;
    if (loaded.built && file.paint == GroundPaint::None) return colorsOfBuiltIn(scene.ground, *loaded.built);
    return groundColorsAs(file.paint, scene.ground, source, {file.look.sunAzimuth, file.look.sunElevation},
                          progress);
}

void loadColor(const SceneFile& file, const LoadedGround& loaded, TerrainScene& scene, Progress& progress) {
    GroundColor color = colorOf(file, loaded, scene, progress);
    scene.color = std::move(color.texture);
    scene.report.colorSource = std::move(color.source);
    scene.report.colorHoldsSun = color.holdsSun && !litLater(file);
    if (litLater(file)) leaveOutLit(scene.report.colorSource);
}

// Returns null where none was baked. Throws Error where it does not go with that light.
std::shared_ptr<const FineLight> finerLight(const std::filesystem::path& place, const TerrainLight& light,
                                            const TerrainScene& scene) {
    const std::filesystem::path finer = fineLightPlace(place);
    std::error_code code;
    if (!scene.tiled || scene.tiled->level == 0 || !std::filesystem::exists(finer, code)) return nullptr;
    const FineLightShape shape = fineLightShape(*scene.tiled->levels, scene.tiled->level, light, 1);
    return std::make_shared<const FineLight>(scene.tiled->levels, LightTiles(finer, shape), SimdTarget::Auto);
}

void loadLight(const SceneFile& file, TerrainScene& scene, Progress& progress) {
    progress.report(0, "reading baked light");
    const std::filesystem::path place = file.light == "auto" ? terrainLightCache(scene.ground) : file.light;
    if (file.light == "auto" && !std::filesystem::exists(place))
        throw Error(file.file.string(), "light", "none was baked for this ground yet",
                    "bake it with stereonav bake, with the same --vertical-scale, --open-holes, --tiles and "
                    "--memory");
    TerrainLight light = loadTerrainLight(place, &scene.ground);
    const std::shared_ptr<const FineLight> finer = finerLight(place, light, scene);
    const bool photo = !file.image.empty() && !file.look.shadeImage;
    const bool transfer = light.settings.kind == TerrainLightKind::Transfer;
    scene.report.lightSource = fmt::format("{} {}x{}, {}", place.filename().string(), light.grid.width,
                                           light.grid.height, transfer ? "transfer" : "openness");
    if (finer)
        scene.report.lightSource +=
            fmt::format(", and tiles of up to {}x{}", finer->size(finer->shape().finest).x,
                        finer->size(finer->shape().finest).y);
    scene.illumination =
        std::make_unique<TerrainIllumination>(scene.ground, scene.color, scene.sky, std::move(light),
                                              photo ? TerrainIllumination::kPhotoShare : 1.0f);
    scene.illumination->takeFiner(finer);
    scene.illumination->apply(scene.look, scene.color);
    progress.report(1, "reading baked light");
}

// The highest ground within a cell of a place, for standing above it where the place is a hole.
double groundHeight(const TerrainScene& scene, const glm::dvec2& world) {
    const double height = scene.heightAt(world);
    return std::isfinite(height) ? height : scene.ground.maxHeight();
}

Pose startPoseOf(const SceneFile& file, const TerrainScene& scene) {
    if (!file.startPosition) return defaultStartPose(scene.ground, scene.clearance, kDefaultPitch);
    glm::dvec3 position = *file.startPosition;
    if (file.startAboveGround) position.z += groundHeight(scene, glm::dvec2(position));
    return poseFromAngles(position, file.startHeading, file.startPitch, file.startRoll);
}

// Sets the first view. Returns the description with a sun chosen for it where none is given. The built-in
// terrain, whose light is kept in the cache, and hillshade and swiss relief, whose sun stands where maps have
// it, keep theirs.
SceneFile chooseView(const SceneFile& file, TerrainScene& scene) {
    const bool free = file.chosen && !file.builtIn,
               mapSun = file.paint == GroundPaint::Hillshade || file.paint == GroundPaint::Swiss,
               freeSun = free && !file.sunGiven && !mapSun;
    if (!free || file.startPosition) scene.startPose = startPoseOf(file, scene);
    SceneFile chosen = file;
    if (!free || (file.startPosition && !freeSun)) return chosen;
    const FirstView view = file.startPosition
                               ? chooseSun(scene.ground, scene.startPose, file.verticalFov)
                               : chooseFirstView(scene.ground, scene.clearance, file.verticalFov);
    scene.startPose = view.pose;
    if (!file.startPosition) scene.report.notes.push_back("first view chosen by what is seen of the ground");
    if (!freeSun) return chosen;
    chosen.look.sunAzimuth = view.sunAzimuth;
    chosen.look.sunElevation = view.sunElevation;
    scene.report.notes.push_back(
        fmt::format("sun chosen for the first view: azimuth {:.0f}, {:.0f} degrees high",
                    view.sunAzimuth / kRadians, view.sunElevation / kRadians));
    return chosen;
}

// Metres across the whole ground.
double extentOfAll(const TerrainScene& scene) {
    const Heightfield& ground = scene.ground;
    return glm::length(glm::dvec2(ground.width() - 1, ground.height() - 1) * ground.spacing());
}

// The visibility with which the far end of the ground loses a third of its contrast to haze, but as far as
// the clearest air lets one see, and no worse than on a usual day.
double visibilityOver(double extent) {
    constexpr double kMolecules = 1.35e-5, kHazeLeft = 0.35, kClearest = 250e3;  // a metre
    constexpr double kContrastLeft = 3.912;
    return std::clamp(kContrastLeft / (kMolecules + kHazeLeft / extent), kUsualVisibility, kClearest);
}

// Chooses the physical sky and its haze where neither sky nor fog is given: for ground on the Earth, which is
// what a landscape without a place is taken for. Air would hide a far larger extent.
void chooseAir(SceneFile& file, TerrainScene& scene) {
    constexpr double kMostExtent = 400e3, kLeastExtent = 500;  // metres
    const double extent = extentOfAll(scene);
    const bool landscape = scene.earth || (extent >= kLeastExtent && !scene.report.placed);
    const bool air = landscape && scene.body.isEarth() && extent <= kMostExtent && !file.builtIn;
    if (!file.look.physicalSky && (!air || !file.sky.empty() || file.fogGiven)) return;
    if (!file.look.physicalSky && !scene.earth)
        scene.report.notes.push_back("taken for a landscape on the Earth: sky and air are chosen");
    file.look.physicalSky = file.look.hazyBelow = true;
    if (!file.visibilityGiven) file.look.visibility = visibilityOver(extent);
}

// Whether light is worked out with the loading: for ground in its own colours, where memory suffices. The
// built-in terrain has its light in its colours.
bool quickLightSuits(const SceneFile& file, const TerrainScene& scene) {
    if (!file.quickLight || file.builtIn || !file.light.empty() || !file.image.empty()) return false;
    if ((file.paint != GroundPaint::None && !paletteOf(file.paint)) || file.colorsAlone) return false;
    const double samples = double(scene.ground.width()) * scene.ground.height(),
                 needed = bytesOfQuickLight(samples) + 2 * bytesOfTint(samples);
    return needed <= availableMemoryFor(needed);
}

// Returns the description with all that is chosen for the ground.
SceneFile choose(const SceneFile& asked, TerrainScene& scene) {
    SceneFile file = chooseView(asked, scene);
    if (file.chosen) chooseAir(file, scene);
    file.quickLight = quickLightSuits(file, scene);
    return file;
}

// Works out light at few samples, in the place of a bake.
void lightQuickly(TerrainScene& scene, Progress& progress) {
    const TerrainLight sparse = sparseOpenness(scene.ground, kQuickSkySamples, progress);
    scene.illumination = std::make_unique<TerrainIllumination>(scene.ground, scene.color, scene.sky,
                                                               spreadOpenness(scene.ground, sparse), 1.0f);
    scene.illumination->castShadowsOf(scene.ground);
    scene.illumination->apply(scene.look, scene.color);
    scene.report.lightSource = fmt::format(
        "worked out with the first picture: the sun's shadow at {}x{} samples, "
        "openness at {}x{}",
        scene.illumination->light().grid.width, scene.illumination->light().grid.height, sparse.grid.width,
        sparse.grid.height);
}

// A physical sky counts heights from the sea where the ground is on the Earth or generated, else from the
// lowest sample.
void loadSky(const SceneFile& file, TerrainScene& scene) {
    if (!file.look.physicalSky) {
        SkySource sky = readSky(file.sky);
        scene.sky = std::move(sky.map);
        scene.report.skySource = std::move(sky.source);
        return;
    }
    scene.look.seaLevel = scene.earth || file.builtIn ? 0.0 : scene.ground.minHeight();
    scene.look.skySeenFrom = scene.startPose.position.z;
    scene.sky = skyMapOf(Atmosphere(scene.look));
    scene.report.skySource =
        fmt::format("scattering in the air, visibility {:g} km", 1e-3 * file.look.visibility);
}

// Distance along the view axis to the ground; nullopt where it meets none within the ground's extent.
std::optional<double> distanceToGround(const Heightfield& ground, const Pose& pose) {
    const glm::dvec3 d = pose.forward();
    const auto above = [&](double t) {
        const glm::dvec3 p = pose.position + t * d;
        return ground.contains(glm::dvec2(p)) ? p.z - ground.heightAt(glm::dvec2(p)) : std::nan("");
    };
    const glm::dvec2 extent = glm::dvec2(ground.width() - 1, ground.height() - 1) * ground.spacing();
    const double reach = 2 * glm::length(extent) + std::abs(pose.position.z) + std::abs(ground.maxHeight()) +
                         std::abs(ground.minHeight());
    constexpr int kMostSteps = 200'000;
    const double step = std::max(0.5 * std::min(ground.spacing().x, ground.spacing().y), reach / kMostSteps);
    double previous = above(0);
    for (double t = step; t < reach; t += step) {
        const double here = above(t);
        if (here <= 0 && previous > 0) {
            double low = t - step, high = t;
            for (int k = 0; k < 40; ++k) (above(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
            return high;
        }
        previous = here;
    }
    return std::nullopt;
}

StereoSetting stereoOf(const SceneFile& file, const TerrainScene& scene) {
    const Heightfield& ground = scene.ground;
    const glm::dvec2 extent = glm::dvec2(ground.width() - 1, ground.height() - 1) * ground.spacing();
    const auto seen = [&] {
        return distanceToGround(ground, scene.startPose)
            .value_or(kFallbackShare * std::min(extent.x, extent.y));
    };
    StereoSetting stereo = defaultEyes(
        SeenAs::Ground, file.zeroParallax ? *file.zeroParallax : std::max(seen(), 2 * scene.lens.nearDepth));
    if (file.separation) stereo.separation = *file.separation;
    return stereo;
}

RecordedPath pathOf(const SceneFile& file, const TerrainScene& scene) {
    return file.path.empty() ? defaultFlight(scene.ground, scene.clearance) : readPath(file.path);
}

}  // namespace

TerrainScene loadTerrain(const SceneFile& asked, Progress& progress) {
    if (!(asked.verticalScale > 0 && std::isfinite(asked.verticalScale)))
        throw Error(asked.file.string(), "vertical scale",
                    fmt::format("expected a number above 0, got {:g}", asked.verticalScale), "");
    TerrainScene scene;
    progress.report(0, "reading the ground");
    Progress reading(progress, 0, 0.6), colouring(progress, 0.6, 0.9), lighting(progress, 0.9, 1);
    LoadedGround loaded = asked.builtIn ? loadBuiltIn(asked, scene, reading) : loadDem(asked, scene, reading);
    scene.verticalScale = asked.verticalScale;
    const glm::dvec2 spacing = scene.tiled     ? scene.tiled->levels->spacing(0)
                               : scene.standIn ? scene.standIn->spacing
                                               : scene.ground.spacing();
    scene.clearance =
        asked.clearance > 0 ? asked.clearance : kClearancePerSpacing * std::max(spacing.x, spacing.y);
    scene.lens.verticalFov = asked.verticalFov;
    scene.lens.nearDepth = std::min(kNearPerSpacing * std::min(spacing.x, spacing.y), 0.25 * scene.clearance);
    const SceneFile file = choose(asked, scene);
    scene.look = file.look;
    loadColor(file, loaded, scene, colouring);
    loadSky(file, scene);
    if (!file.light.empty()) loadLight(file, scene, lighting);
    if (file.quickLight) lightQuickly(scene, lighting);
    if (!file.landmarks.empty())
        scene.landmarks = std::make_unique<LandmarkSet>(file.landmarks, scene.ground, scene.look);
    scene.path = pathOf(file, scene);
    scene.stereo = stereoOf(file, scene);
    scene.eyesGiven = file.separation || file.zeroParallax;
    progress.report(1, "loaded");
    return scene;
}

}  // namespace stereonav
