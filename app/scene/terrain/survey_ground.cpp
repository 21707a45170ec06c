#include "app/scene/terrain/survey_ground.h"

#include <fmt/format.h>

#include <cmath>

#include "app/scene/terrain/terrain_loading.h"
#include "engine/base/error.h"
#include "terrain/built_in/built_in_terrain.h"
#include "terrain/ground/nodata.h"
#include "terrain/read/scene_file.h"
#include "terrain/scene/tiled_ground.h"

namespace stereonav {
namespace {

// Places of ground without a reference system: the world's own coordinates.
class OwnPlaces final : public ReferencePlaces {
public:
    std::optional<glm::dvec2> referenceAt(const glm::dvec2& world) const override { return world; }
    std::optional<glm::dvec2> worldAt(const glm::dvec2& reference) const override { return reference; }
};

void placeInWorld(SurveyGround& survey) {
    const GroundSamples samples = survey.samples();
    const glm::dvec2 spacing = samples.spacing();
    Georeference& grid = survey.grid;
    grid = {};
    grid.width = samples.width(), grid.height = samples.height();
    grid.transform = {-0.5 * grid.width * spacing.x, spacing.x, 0,
                      0.5 * grid.height * spacing.y, 0,         -spacing.y};
    survey.reference = std::make_unique<OwnPlaces>();
}

SurveyGround generated(const SceneFile& file, Progress& progress) {
    SurveyGround survey;
    BuiltInTerrain built = builtInTerrain(file.seed, file.builtInSize, progress);
    for (float& height : built.heights) height = static_cast<float>(height * file.verticalScale);
    survey.ground = Heightfield(built.size, built.size, glm::dvec2(built.spacing), std::move(built.heights),
                                "the built-in terrain");
    placeInWorld(survey);
    return survey;
}

// Reads the heights, in memory or as tiles, and returns the other data of the elevation model.
DemGrid readHeights(const SceneFile& file, SurveyGround& survey, Progress& progress) {
    if (goesIntoTiles(file, bytesOfSurvey)) {
        GroundInTiles tiled = readGroundInTiles(file, progress);
        survey.tiles = std::make_shared<SurveyTiles>(std::move(tiled.levels));
        return std::move(tiled.place);
    }
    Progress reading(progress, 0, file.openHoles ? 1 : 0.7), filling(progress, 0.7, 1);
    DemGrid dem = readDem(file.dem, file.verticalScale, reading, bytesOfSurvey);
    if (!file.openHoles) fillMissing(dem.heights, dem.width, dem.height, dem.spacing, filling);
    survey.ground =
        Heightfield(dem.width, dem.height, dem.spacing, std::move(dem.heights), file.dem.string());
    return dem;
}

SurveyGround read(const SceneFile& file, Progress& progress) {
    SurveyGround survey;
    const DemGrid dem = readHeights(file, survey, progress);
    survey.crs = dem.crs;
    survey.body = {dem.bodyRadius};
    for (const std::string& note : dem.notes) progress.note(note);
    if (!dem.georeferenced) {
        placeInWorld(survey);
        return survey;
    }
    survey.grid = dem.grid;
    survey.earth = earthPlaces(dem.grid, dem.spacing);
    survey.reference = referencePlaces(dem.source, dem.grid, dem.spacing);
    if (!survey.reference)
        throw Error(file.dem.string(), "reference system",
                    "expected a reference system for coordinates, found none",
                    "reproject the file, for example with gdalwarp");
    return survey;
}

}  // namespace

double bytesOfSurvey(double samples) {
    return (4 + 4 * 4.0 / 3 + 1 + 4) * samples;
}

glm::dvec2 SurveyGround::gridAt(const glm::dvec2& place, const char* option) const {
    const auto world = reference->worldAt(place);
    const GroundSamples all = samples();
    if (world && all.contains(*world)) return all.gridFromWorld(*world);
    const auto corner = [&](double x, double y) {
        return reference->referenceAt(all.worldFromGrid({x * (all.width() - 1), y * (all.height() - 1)}));
    };
    const auto low = corner(0, 0), high = corner(1, 1);
    throw Error(
        option, "", fmt::format("expected a place on the ground, got {:.10g},{:.10g}", place.x, place.y),
        low && high
            ? fmt::format("it lies from {:.10g},{:.10g} to {:.10g},{:.10g}", low->x, low->y, high->x, high->y)
            : "see stereonav info");
}

double SurveyGround::heightAt(const glm::dvec2& grid_, const char* option) const {
    const GroundSamples all = samples();
    const double height = all.heightAt(all.worldFromGrid(grid_));
    if (!std::isfinite(height))
        throw Error(option, "", "there is a hole in the ground",
                    tiles ? "choose another place" : "leave out --open-holes, or choose another place");
    return height;
}

SurveyGround readSurveyGround(const SceneOptions& options, Progress& progress) {
    SceneFile file = sceneFileFromName(options.scene);
    if (options.verticalScale) file.verticalScale = *options.verticalScale;
    if (options.openHoles) file.openHoles = true;
    file.tiles = tilesOf(options.tiles);
    SurveyGround survey = file.builtIn ? generated(file, progress) : read(file, progress);
    survey.name = options.scene.empty() ? "terrain" : options.scene;
    return survey;
}

}  // namespace stereonav
