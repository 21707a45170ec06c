// Maps and places on the Earth that terrains offer, however their frames are made.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/vector_relational.hpp>
#include <numbers>

#include "app/scene/scene_loading.h"
#include "app/scene/terrain/ground_figures.h"
#include "app/scene/terrain/survey_part.h"
#include "app/scene/terrain/terrain_loading.h"
#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/line_measurer.h"
#include "engine/scene/place_reader.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/held_memory.h"
#include "tests/support/own_cache.h"

namespace stereonav {
namespace {

constexpr double kToDegrees = 180 / std::numbers::pi;

// A slope of 40 x 40 samples, 30 m apart, whose south-west corner lies there in UTM zone 33.
std::filesystem::path slope(const TemporaryFolder& folder, double east, double north, bool placed) {
    const std::filesystem::path file = folder / "slope.asc";
    std::ofstream out(file);
    out << "ncols 40\nnrows 40\nxllcorner " << std::fixed << east << "\nyllcorner " << north
        << "\ncellsize 30\n";
    for (int row = 0; row < 40; ++row)
        for (int column = 0; column < 40; ++column) out << 10 * row + column << (column == 39 ? "\n" : " ");
    if (placed)
        std::ofstream(folder / "slope.prj")
            << "PROJCS[\"WGS 84 / UTM zone 33N\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS "
               "84\",6378137,"
               "298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],PROJECTION["
               "\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\",0],PARAMETER[\"central_meridian\","
               "15],"
               "PARAMETER[\"scale_factor\",0.9996],PARAMETER[\"false_easting\",500000],PARAMETER["
               "\"false_northing\",0],UNIT[\"metre\",1]]";
    return file;
}

std::unique_ptr<Scene> terrainFrom(const std::filesystem::path& file) {
    SceneOptions options;
    options.scene = file.string();
    Progress progress;
    return loadTerrainScene(options, SimdTarget::Auto, progress);
}

TEST(TerrainSurvey, AMapLeadsBackAndForth) {
    const TemporaryFolder folder;
    const auto scene = terrainFrom(slope(folder, 600000, 5000000, true));
    const MapFromAbove* const above = scene->offered<MapFromAbove>();
    ASSERT_TRUE(above);
    Progress progress;
    const MapPicture map = above->makeMap(64, progress);
    EXPECT_EQ(map.picture.width(), 64);
    EXPECT_EQ(map.picture.height(), 64);
    const glm::dvec2 eye(scene->startPose.position), pixel = map.mapFromWorld(eye);
    EXPECT_NEAR(glm::distance(map.worldFromMap(pixel), eye), 0, 1e-9);
    EXPECT_TRUE(glm::all(glm::lessThan(glm::dvec2(0.0), pixel)) &&
                glm::all(glm::lessThan(pixel, glm::dvec2(64.0))));
    EXPECT_GT(map.worldFromMap({0, 0}).y, map.worldFromMap({0, 10}).y) << "north is up";
    EXPECT_LT(map.worldFromMap({0, 0}).x, map.worldFromMap({10, 0}).x);
    const SceneBox* const box = scene->offered<SceneBox>();
    ASSERT_TRUE(box);
    EXPECT_EQ(box->low.z, 0);
    EXPECT_EQ(box->high.z, 429);
    EXPECT_NEAR(box->high.x - box->low.x, 39 * 30, 1e-9);
}

double figureNamed(const Facts& facts, const std::string& key) {
    for (const Fact& fact : facts)
        if (fact.key == key) return std::get<double>(fact.value);
    ADD_FAILURE() << key;
    return std::nan("");
}

// The slope falls by a third towards the north, and rises by a thirtieth towards the east.
TEST(TerrainSurvey, MeasuresInHeightsOfTheFileWhateverTheyAreExaggeratedBy) {
    const TemporaryFolder folder;
    const auto file = slope(folder, 600000, 5000000, true);
    for (const double scale : {1.0, 3.0}) {
        SceneOptions options;
        options.scene = file.string();
        options.verticalScale = scale;
        Progress progress;
        const auto scene = loadTerrainScene(options, SimdTarget::Auto, progress);
        const auto* const measurer = scene->offered<LineMeasurer>();
        ASSERT_TRUE(measurer);
        const MeasuredSurface line = measurer->measure({{-300, -200, 0}, {300, 100, 0}}, false);
        const double plan = std::hypot(600, 300), rise = -80;
        EXPECT_NEAR(figureNamed(line.facts, "plan_m"), plan, 1e-6);
        EXPECT_NEAR(figureNamed(line.facts, "rise_m"), rise, 1e-3);
        EXPECT_NEAR(figureNamed(line.facts, "along_m"), std::hypot(plan, rise), 1e-3);
        ASSERT_EQ(line.places.size(), line.profile.size());
        ASSERT_GT(line.places.size(), 20U);
        for (std::size_t n = 0; n < line.places.size(); ++n) {
            const glm::dvec3& place = line.places[n];
            EXPECT_NEAR(place.z, scale * line.profile[n].y, 1e-3);
            EXPECT_NEAR(place.z, scale * (214.5 + place.x / 30 - place.y / 3), 1e-2);
            EXPECT_NEAR(line.profile[n].x, std::hypot(place.x + 300, place.y + 200), 1e-6);
        }
        EXPECT_NEAR(line.profile.back().x, plan, 1e-6);
        const MeasuredSurface area = measurer->measure({{0, 0, 0}, {100, 0, 0}, {100, 50, 0}}, true);
        EXPECT_NEAR(figureNamed(area.facts, "area_m2"), 2500, 1e-6);
        EXPECT_NEAR(figureNamed(area.facts, "surface_m2"), 2500 * std::sqrt(1 + 1.0 / 9 + 1.0 / 900), 1e-2);
        EXPECT_NEAR(area.profile.back().x, 100 + 50 + std::hypot(100, 50), 1e-6) << "back to its first place";
        // At the border, and beside it.
        EXPECT_NEAR(figureNamed(measurer->measure({{-585, 585, 0}, {585, 585, 0}}, false).facts, "rise_m"),
                    39, 1e-3);
        EXPECT_THROW(measurer->measure({{0, 0, 0}, {586, 0, 0}}, false), Error);
        EXPECT_THROW(measurer->measure({{0, 0, 0}, {std::nan(""), 0, 0}}, false), Error);
    }
}

// Meridians of a transverse Mercator projection: sin(latitude) of the longitude from its own, clockwise from
// the west of it (Snyder 1987, equation 8-1's first term).
TEST(TerrainSurvey, KnowsWhereItLiesAndWhereNorthIs) {
    const TemporaryFolder folder;
    const auto scene = terrainFrom(slope(folder, 600000, 5000000, true));
    const OnEarth* const earth = scene->offered<OnEarth>();
    ASSERT_TRUE(earth);
    const auto place = earth->placeAt({0, 0, 100});
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->latitude * kToDegrees, 45.15, 0.01);
    EXPECT_NEAR(place->longitude * kToDegrees, 16.28, 0.01);
    const double fromOwn = place->longitude - 15 / kToDegrees;
    EXPECT_NEAR(earth->northAt({0, 0, 0}), -fromOwn * std::sin(place->latitude), 2e-5);
    const auto back = earth->worldAt(*place);
    ASSERT_TRUE(back);
    EXPECT_NEAR(glm::length(*back), 0, 1e-3);
    EXPECT_FALSE(earth->placeAt({std::nan(""), 0, 0}));
    EXPECT_EQ(earth->northAt({std::nan(""), 0, 0}), 0);
}

TEST(TerrainSurvey, WithoutAReferenceSystemThereIsNoPlaceOnEarth) {
    const TemporaryFolder folder;
    const auto scene = terrainFrom(slope(folder, 600000, 5000000, false));
    EXPECT_FALSE(scene->offered<OnEarth>());
    EXPECT_TRUE(scene->offered<MapFromAbove>());
}

TEST(TerrainSurvey, AMediumOfATerrainHasItsMap) {
    const TemporaryFolder folder;
    SceneOptions options;
    options.scene = slope(folder, 600000, 5000000, true).string();
    options.medium.medium = "ground";
    Progress progress;
    const auto scene = loadScene(options, SizeOption{64, 48}, progress);
    ASSERT_TRUE(scene->offered<MapFromAbove>());
    EXPECT_EQ(scene->offered<MapFromAbove>()->makeMap(10, progress).picture.width(), 10);
    EXPECT_TRUE(scene->offered<OnEarth>());
    EXPECT_TRUE(scene->offered<SceneBox>());
}

double placeNumber(const Facts& facts, const std::string& key, std::size_t part = 0) {
    for (const Fact& fact : facts)
        if (fact.key == key) {
            if (const auto* const numbers = std::get_if<FactNumbers>(&fact.value)) return numbers->at(part);
            return std::get<double>(fact.value);
        }
    return std::nan("");
}

// Heights fall by 10 m a sample to the north and by 1 m to the west.
TEST(TerrainSurvey, TellsOfAPlaceWhatTheFileSays) {
    const TemporaryFolder folder;
    for (const double scale : {1.0, 3.0}) {
        SceneOptions options;
        options.scene = slope(folder, 600000, 5000000, true).string();
        options.verticalScale = scale;
        Progress progress;
        const auto scene = loadTerrainScene(options, SimdTarget::Auto, progress);
        const PlaceReader* const reader = scene->offered<PlaceReader>();
        ASSERT_TRUE(reader);
        const Facts facts = reader->readPlace({90, -60, 0});
        EXPECT_NEAR(placeNumber(facts, "reference", 0), 600690, 1e-6);
        EXPECT_NEAR(placeNumber(facts, "reference", 1), 5000540, 1e-6);
        EXPECT_NEAR(placeNumber(facts, "height_m"), 10 * 21.5 + 22.5, 1e-3) << scale;
        EXPECT_NEAR(placeNumber(facts, "slope_degrees"), std::atan(std::sqrt(101.0) / 30) * kToDegrees, 1e-4);
        EXPECT_NEAR(placeNumber(facts, "aspect_degrees"), 360 - std::atan(0.1) * kToDegrees, 1e-3);
        const auto earth = scene->offered<OnEarth>()->placeAt({90, -60, 0});
        EXPECT_EQ(placeNumber(facts, "latitude_longitude", 0), earth->latitude * kToDegrees);
        EXPECT_EQ(placeNumber(facts, "latitude_longitude", 1), earth->longitude * kToDegrees);
        EXPECT_TRUE(reader->readPlace({1e4, 0, 0}).empty()) << "beside the ground";
    }
    const TemporaryFolder other;
    const auto nowhere = terrainFrom(slope(other, 0, 0, false));
    const Facts facts = nowhere->offered<PlaceReader>()->readPlace({0, 0, 0});
    EXPECT_TRUE(std::isnan(placeNumber(facts, "latitude_longitude"))) << "it says no place on the Earth";
    EXPECT_NEAR(placeNumber(facts, "height_m"), 10 * 19.5 + 19.5, 1e-3);
}

// Level ground has no direction of fall, and a hole has no height.
TEST(TerrainSurvey, LevelGroundHasNoAspect) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "level.asc";
    std::ofstream(file) << "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 30\nNODATA_value -9999\n"
                           "5 5 5\n5 5 5\n5 5 -9999\n";
    SceneOptions options;
    options.scene = file.string();
    options.openHoles = true;
    Progress progress;
    const auto scene = loadTerrainScene(options, SimdTarget::Auto, progress);
    const Facts level = scene->offered<PlaceReader>()->readPlace({-20, 20, 5});
    EXPECT_EQ(placeNumber(level, "height_m"), 5);
    EXPECT_EQ(placeNumber(level, "slope_degrees"), 0);
    EXPECT_TRUE(std::isnan(placeNumber(level, "aspect_degrees")));
    EXPECT_TRUE(scene->offered<PlaceReader>()->readPlace({20, -20, 5}).empty());
}

// Tiles go there, and away with it.
class CacheIn {
public:
    explicit CacheIn(const TemporaryFolder& folder) {
        std::filesystem::create_directory(folder / "cache");
        setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
    }
    ~CacheIn() {
        limitMemory(0);
        test::useOwnCache();
    }
};

// Hills of 600 x 560 samples, 10 m apart.
SceneOptions hillsIn(const TemporaryFolder& folder, TilesChoice tiles) {
    const std::filesystem::path file = folder / "hills.asc";
    std::ofstream out(file);
    out << "ncols 600\nnrows 560\nxllcorner 4000\nyllcorner 7000\ncellsize 10\n";
    for (int row = 0; row < 560; ++row)
        for (int column = 0; column < 600; ++column)
            out << std::floor(200 + 60 * std::sin(row / 21.) * std::cos(column / 17.)) << " ";
    out.close();
    SceneOptions options;
    options.scene = file.string();
    options.tiles = tiles;
    return options;
}

SurveyGround surveyedHills(const TemporaryFolder& folder, TilesChoice tiles) {
    Progress progress;
    return loadSurveyGround(hillsIn(folder, tiles), progress);
}

// What the window measures, where every second sample is in memory.
TEST(TerrainSurvey, MeasuresGroundInTilesAsGroundInMemory) {
    const TemporaryFolder folder;
    const CacheIn cache(folder);
    Facts told[2];  // without, with tiles
    for (const TilesChoice tiles : {TilesChoice::Off, TilesChoice::On}) {
        SceneOptions options = hillsIn(folder, tiles);
        if (tiles == TilesChoice::On) limitMemory(test::bytesHeld() + 60e6);
        options.verticalScale = 2;
        Progress progress;
        const auto scene = loadTerrainScene(options, SimdTarget::Auto, progress);
        limitMemory(0);
        const bool tiled = tiles == TilesChoice::On;
        EXPECT_EQ(scene->offered<const TerrainScene>()->ground.spacing().x, tiled ? 20 : 10);
        const auto* const measurer = scene->offered<LineMeasurer>();
        for (const bool closed : {false, true}) {
            const std::vector<glm::dvec3> places{{-900, -700, 0}, {800, 300, 0}, {-100, 850, 0}};
            for (const Fact& fact : measurer->measure(places, closed).facts)
                if (fact.key == "sample_spacing_m") {
                    EXPECT_EQ(std::get<double>(fact.value), tiled ? 10 : 0) << "said of tiles alone";
                } else {
                    told[tiled].push_back(fact);
                }
        }
        for (const Fact& fact : measurer->sight({-900, -700, 0}, {800, 300, 0}, 2))
            told[tiled].push_back(fact);
        EXPECT_THROW(measurer->measure({{0, 0, 0}, {3001, 0, 0}}, false), Error);
    }
    ASSERT_EQ(told[0].size(), told[1].size());
    ASSERT_GT(told[0].size(), 12u);
    for (std::size_t n = 0; n < told[0].size(); ++n) {
        const auto *a = std::get_if<double>(&told[0][n].value), *b = std::get_if<double>(&told[1][n].value);
        ASSERT_EQ(!a, !b);
        if (a) {
            EXPECT_EQ(*a, *b) << told[0][n].key;
        }
        EXPECT_EQ(told[0][n].text, told[1][n].text);
    }
}

// The part has as many samples as there is room for, each in its place.
TEST(SurveyPart, TakesTheFinestSamplesThatFit) {
    const TemporaryFolder folder;
    const CacheIn cache(folder);
    const SurveyGround whole = surveyedHills(folder, TilesChoice::Off),
                       tiled = surveyedHills(folder, TilesChoice::On);
    ASSERT_TRUE(tiled.tiles && !whole.tiles);
    const glm::dvec2 place(-900, 300);
    EXPECT_EQ(&SurveyPart(whole, place, 400).ground(), &whole.ground);
    struct Case {
        double reach, memory;
        int step;
        const char* words;
    };
    // All of it takes 4.8 MB, and every second sample a quarter of that.
    for (const Case& wanted :
         {Case{400, 3e6, 1, "samples 10.0 m apart"}, Case{0, 0, 1, "samples 10.0 m apart"},
          Case{0, 3e6, 2, "samples 20.0 m apart, the finest are 10.0 m"},
          Case{2500, 3e6, 2, "samples 20.0 m apart, the finest are 10.0 m"}}) {
        SCOPED_TRACE(wanted.words);
        if (wanted.memory > 0) limitMemory(test::bytesHeld() + wanted.memory);
        const SurveyPart part(tiled, place, wanted.reach);
        limitMemory(0);
        const Heightfield& ground = part.ground();
        EXPECT_EQ(ground.spacing(), glm::dvec2(10 * wanted.step));
        EXPECT_EQ(part.words(), wanted.words);
        EXPECT_EQ(part.grid().width, ground.width());
        EXPECT_EQ(part.grid().height, ground.height());
        if (wanted.reach > 0) {
            EXPECT_LE(ground.width(), 2 * wanted.reach / (10 * wanted.step) + 3);
            EXPECT_TRUE(ground.contains(place - std::min(wanted.reach, 2000.0)));
            EXPECT_TRUE(ground.contains(place + std::min(wanted.reach, 2400.0)));
        } else {
            EXPECT_EQ(ground.width(), 600 / wanted.step);
        }
        for (const glm::ivec2& at : {glm::ivec2(0), glm::ivec2(ground.width() - 1, ground.height() - 1)}) {
            const glm::dvec2 world = ground.worldFromGrid(at),
                             file = part.grid().fromPixel({at.x + 0.5, ground.height() - 0.5 - at.y});
            EXPECT_NEAR(glm::distance(file, *tiled.reference->referenceAt(world)), 0, 1e-6);
            if (wanted.step == 1) {
                EXPECT_EQ(ground.sample(at.x, at.y), whole.ground.heightAt(world));
            }
        }
    }
}

TEST(GroundFigures, TellErrorsWithoutExponents) {
    const auto told = [](double error) { return errorText({"key", "name", "m", 1, error}); };
    EXPECT_EQ(told(0), "");
    EXPECT_EQ(told(std::nan("")), " (error not known)");
    EXPECT_EQ(told(0.0123), " +- 0.012");
    EXPECT_EQ(told(7.61), " +- 7.6");
    EXPECT_EQ(told(11.2), " +- 11");
    EXPECT_EQ(told(99.4), " +- 99");
    EXPECT_EQ(told(99.6), " +- 100");
    EXPECT_EQ(told(213.4), " +- 210");
    EXPECT_EQ(told(123456789), " +- 120000000");
    EXPECT_EQ(told(1.23e20), " +- 1.2e+20");
}

}  // namespace
}  // namespace stereonav
