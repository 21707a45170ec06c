#include "app/scene/survey_ground.h"

#include <fmt/format.h>

#include <cmath>

#include "app/scene/scene_loading.h"
#include "app/scene/scene_type.h"
#include "engine/base/error.h"
#include "terrain/built_in/built_in_terrain.h"
#include "terrain/ground/nodata.h"
#include "terrain/read/scene_file.h"

namespace stereonav {
namespace {

// Of a ground that lies nowhere: the world's own coordinates.
class OwnPlaces final : public ReferencePlaces {
public:
    std::optional<glm::dvec2> referenceAt(const glm::dvec2& world) const override { return world; }
    std::optional<glm::dvec2> worldAt(const glm::dvec2& reference) const override { return reference; }
};

void placeInWorld(SurveyGround& survey) {
    const glm::dvec2 spacing = survey.ground.spacing();
    Georeference& grid = survey.grid;
    grid = {};
    grid.width = survey.ground.width(), grid.height = survey.ground.height();
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

// Heights, the maxima over blocks of them, what is seen, and the heights that a sweep has read
// (survey/fan_sweep.h).
double bytesOfSurvey(double samples) {
    return (4 + 4 * 4.0 / 3 + 1 + 4) * samples;
}

SurveyGround read(const SceneFile& file, Progress& progress) {
    SurveyGround survey;
    DemGrid dem = readDem(file.dem, file.verticalScale, progress, bytesOfSurvey);
    if (!file.openHoles) fillMissing(dem.heights, dem.width, dem.height, dem.spacing, progress);
    survey.crs = dem.crs;
    survey.ground =
        Heightfield(dem.width, dem.height, dem.spacing, std::move(dem.heights), file.dem.string());
    if (!dem.georeferenced) {
        placeInWorld(survey);
        return survey;
    }
    survey.grid = dem.grid;
    survey.earth = earthPlaces(dem.grid, dem.spacing);
    survey.reference = referencePlaces(dem.source, dem.grid, dem.spacing);
    if (!survey.reference)
        throw Error(file.dem.string(), "reference system",
                    "expected one that places can be given in, found none",
                    "bring it to another one, for example with gdalwarp");
    return survey;
}

}  // namespace

glm::dvec2 SurveyGround::gridAt(const glm::dvec2& place, const char* option) const {
    const auto world = reference->worldAt(place);
    if (world && ground.contains(*world)) return ground.gridFromWorld(*world);
    const auto corner = [&](double x, double y) {
        return reference->referenceAt(
            ground.worldFromGrid({x * (ground.width() - 1), y * (ground.height() - 1)}));
    };
    const auto low = corner(0, 0), high = corner(1, 1);
    throw Error(
        option, "", fmt::format("expected a place on the ground, got {:.10g},{:.10g}", place.x, place.y),
        low && high
            ? fmt::format("it lies from {:.10g},{:.10g} to {:.10g},{:.10g}", low->x, low->y, high->x, high->y)
            : "see stereonav info");
}

double SurveyGround::heightAt(const glm::dvec2& grid_, const char* option) const {
    const double height = ground.heightAt(ground.worldFromGrid(grid_));
    if (!std::isfinite(height))
        throw Error(option, "", "there is a hole in the ground",
                    "leave out --open-holes, or choose another place");
    return height;
}

SurveyGround loadSurveyGround(const SceneOptions& options, Progress& progress) {
    checkSceneOptions(options);
    const SceneType& type = sceneTypeNamed(options.scene);
    if (!type.hasGround)
        throw Error(options.scene, "", fmt::format("expected a terrain, found a {}", type.noun),
                    "name an elevation model");
    SceneFile file = sceneFileFromName(options.scene);
    if (options.verticalScale > 0) file.verticalScale = options.verticalScale;
    if (options.openHoles) file.openHoles = true;
    SurveyGround survey = file.builtIn ? generated(file, progress) : read(file, progress);
    survey.name = options.scene.empty() ? "terrain" : options.scene;
    return survey;
}

}  // namespace stereonav
