// Where a terrain lies on the Earth: against closed forms of its projections and places that others state.
#include "terrain/raster/earth_places.h"

#include <cmath>
#include <numbers>

#include "raster_files.h"
#include "terrain/read/dem_reader.h"
#include "terrain/read/raster_file.h"
#include "terrain/scene/terrain_loader.h"

namespace stereonav {
namespace {

using test::RasterSpec;
using test::TempFolder;
using test::writeRaster;

constexpr double kDegrees = 180 / std::numbers::pi;

std::unique_ptr<EarthPlaces> placesOf(const RasterSpec& spec) {
    const TempFolder folder;
    Progress progress;
    const DemGrid dem = readDem(writeRaster(folder / "ground.tif", spec), 1, progress);
    return earthPlaces(dem.grid, dem.spacing);
}

RasterSpec specOf(int epsg, std::array<double, 6> transform, int width = 41, int height = 31) {
    RasterSpec spec;
    spec.epsg = epsg;
    spec.transform = transform;
    spec.width = width;
    spec.height = height;
    return spec;
}

// UTM has a scale of 0.9996 on its central meridian; the meridian arc of WGS 84 from the equator to 45
// degrees is 4984944.378 m (Snyder 1987, equation 3-21).
TEST(EarthPlaces, OnTheCentralMeridianOfUtm) {
    const auto places = placesOf(specOf(32633, {500000 - 615, 30, 0, 0.9996 * 4984944.378 + 465, 0, -30}));
    ASSERT_TRUE(places);
    const auto middle = places->placeAt({0, 0});
    ASSERT_TRUE(middle);
    EXPECT_NEAR(middle->latitude * kDegrees, 45, 1e-8);
    EXPECT_NEAR(middle->longitude * kDegrees, 15, 1e-8);
    const auto north = places->placeAt({0, 400});
    EXPECT_GT(north->latitude, middle->latitude);
    EXPECT_NEAR(north->longitude, middle->longitude, 1e-12);
    const auto east = places->placeAt({400, 0});
    EXPECT_GT(east->longitude, middle->longitude);
}

TEST(EarthPlaces, DegreesThatWereBroughtToMetres) {
    // 41 x 31 samples of an arc second around 118.02 W, 34.3 N.
    const double step = 1.0 / 3600;
    const auto places =
        placesOf(specOf(4326, {-118.02 - 20.5 * step, step, 0, 34.3 + 15.5 * step, 0, -step}));
    ASSERT_TRUE(places);
    const auto middle = places->placeAt({0, 0});
    EXPECT_NEAR(middle->latitude * kDegrees, 34.3, 1e-6);
    EXPECT_NEAR(middle->longitude * kDegrees, -118.02, 1e-6);
    // A second of latitude there is 30.815 m (meridian radius 6355.5 km).
    const auto north = places->placeAt({0, 308.15});
    EXPECT_NEAR((north->latitude - middle->latitude) * kDegrees * 3600, 10, 0.01);
}

TEST(EarthPlaces, BothWaysAreInverse) {
    for (const RasterSpec& spec :
         {specOf(32633, {400000, 30, 0, 6000000, 0, -30}), specOf(4326, {179.99, 0.001, 0, -17, 0, -0.001}),
          specOf(2056, {2600000, 25, 0, 1200000, 0, -25}),
          specOf(3031, {-200000, 500, 0, 200000, 0, -500})}) {
        const auto places = placesOf(spec);
        ASSERT_TRUE(places) << spec.epsg;
        for (const glm::dvec2 world : {glm::dvec2(0, 0), glm::dvec2(300, -250), glm::dvec2(-5000, 7000)}) {
            const auto place = places->placeAt(world);
            ASSERT_TRUE(place) << spec.epsg;
            EXPECT_LE(std::abs(place->longitude), std::numbers::pi);
            const auto back = places->worldAt(*place);
            ASSERT_TRUE(back) << spec.epsg;
            EXPECT_NEAR(back->x, world.x, 0.01) << spec.epsg;
            EXPECT_NEAR(back->y, world.y, 0.01) << spec.epsg;
        }
        EXPECT_FALSE(places->placeAt({std::nan(""), 0}));
        EXPECT_FALSE(places->worldAt({std::nan(""), 0}));
        EXPECT_FALSE(places->worldAt({3, 0}));
    }
}

// The old observatory of Bern, the origin of the Swiss grid, which is of another datum than WGS 84: 7
// 26 22.34 E, 46 57 03.89 N there (swisstopo, "Formulas and constants for the calculation of the Swiss
// conformal cylindrical projection", the worked transformation of E 600000, N 200000).
TEST(EarthPlaces, AnotherDatum) {
    const auto places = placesOf(specOf(2056, {2600000 - 512.5, 25, 0, 1200000 + 387.5, 0, -25}));
    ASSERT_TRUE(places);
    const auto bern = places->placeAt({0, 0});
    ASSERT_TRUE(bern);
    EXPECT_NEAR(bern->longitude * kDegrees, 7.4386, 2e-4);
    EXPECT_NEAR(bern->latitude * kDegrees, 46.9511, 2e-4);
}

TEST(EarthPlaces, NoneWithoutAReferenceSystem) {
    EXPECT_FALSE(placesOf(specOf(0, {0, 10, 0, 5000, 0, -10})));
    Georeference local;
    local.wkt = "LOCAL_CS[\"site\",UNIT[\"metre\",1]]";
    local.width = local.height = 10;
    EXPECT_FALSE(earthPlaces(local, {1, 1}));
    EXPECT_FALSE(earthPlaces({}, {1, 1}));
    Progress progress;
    EXPECT_FALSE(loadTerrain(sceneFileFromName("terrain"), progress).earth) << "built in";
}

TEST(EarthPlaces, TheLoadedTerrainKnows) {
    const TempFolder folder;
    Progress progress;
    const TerrainScene scene = loadTerrain(
        sceneFileFromName(writeRaster(folder / "g.tif", specOf(32633, {499000, 30, 0, 5000000, 0, -30}))),
        progress);
    ASSERT_TRUE(scene.earth);
    EXPECT_NEAR(scene.earth->placeAt({0, 0})->longitude * kDegrees, 15, 0.01);
}

}  // namespace
}  // namespace stereonav
