// Where rasters lie: by ground control points, over the poles, turned; and one clear line for what places
// nothing.
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "gdal_reading.h"
#include "raster_files.h"
#include "terrain/scene/terrain_loader.h"

namespace stereonav::test {
namespace {

void expectLine(const std::string& message, const std::filesystem::path& file, const std::string& what) {
    EXPECT_THAT(message, AllOf(HasSubstr(file.string() + ":"), HasSubstr(what), Not(HasSubstr("\n"))));
}

// A raster with points in the place of a transform. place: from pixels to EPSG:32633.
RasterSpec pointSpec(const std::vector<glm::dvec2>& pixels,
                     const std::function<glm::dvec2(glm::dvec2)>& place, int epsg = 32633) {
    RasterSpec spec;
    spec.width = 90;
    spec.height = 70;
    spec.placed = false;
    spec.value = [](int c, int r, int) { return 500 + 3.0 * c - 2.0 * r + 20 * std::sin(0.3 * c); };
    spec.adorn = [=](GDALDataset& dataset) {
        static char none[] = "";
        std::vector<GDAL_GCP> points;
        for (const glm::dvec2& p : pixels) {
            const glm::dvec2 q = place(p);
            points.push_back({none, none, p.x, p.y, q.x, q.y, 0});
        }
        OGRSpatialReference system;
        system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        if (epsg != 0) system.importFromEPSG(epsg);
        ASSERT_EQ(
            dataset.SetGCPs(static_cast<int>(points.size()), points.data(), epsg != 0 ? &system : nullptr),
            CE_None);
    };
    return spec;
}

const std::vector<glm::dvec2> kTwelve = {{0, 0},  {45, 2},  {90, 0},  {3, 35},  {48, 33}, {88, 36},
                                         {0, 70}, {44, 68}, {90, 70}, {20, 20}, {70, 50}, {66, 15}};

glm::dvec2 turnedPlace(glm::dvec2 p) {
    return {500000 + 29 * p.x + 7 * p.y, 5000000 + 7 * p.x - 29 * p.y};
}

glm::dvec2 bentPlace(glm::dvec2 p) {
    return turnedPlace(p) + glm::dvec2(0.02 * p.x * p.y, 0.03 * p.y * p.y);
}

TEST(DemPlacement, ControlPointsOfAStraightGridAreATransform) {
    const TempFolder folder;
    for (const std::size_t count : {3u, 4u, 12u}) {
        std::vector<glm::dvec2> pixels(kTwelve.begin(), kTwelve.begin() + static_cast<long>(count));
        if (count < 12) pixels = {{0, 0}, {90, 0}, {90, 70}, {0, 70}}, pixels.resize(count);
        const auto file = writeRaster(folder / "straight.tif", pointSpec(pixels, turnedPlace));
        const DemGrid dem = readGround(file);
        EXPECT_TRUE(dem.georeferenced);
        EXPECT_TRUE(dem.source.points.empty());
        EXPECT_THAT(dem.source.placedBy,
                    HasSubstr(std::to_string(count) + " ground control points, by a transform"));
        EXPECT_EQ(dem.crs, "WGS 84 / UTM zone 33N");
        EXPECT_NEAR(dem.spacing.x, std::hypot(29, 7), 0.02);
        const Compared all = compareWithGdal(dem, GdalReading(file, 1, dem.grid.wkt));
        EXPECT_EQ(all.wrong, 0) << all.first;
        EXPECT_GT(all.between, 6000);
    }
}

TEST(DemPlacement, ControlPointsOfABentGridAreAPolynomial) {
    const TempFolder folder;
    const auto file = writeRaster(folder / "bent.tif", pointSpec(kTwelve, bentPlace));
    const DemGrid dem = readGround(file);
    EXPECT_EQ(dem.source.points.size(), 12u);
    EXPECT_THAT(dem.source.placedBy, HasSubstr("by a polynomial of the second order, off by"));
    const Compared all = compareWithGdal(dem, GdalReading(file, 1, dem.grid.wkt));
    EXPECT_EQ(all.wrong, 0) << all.first;
    EXPECT_GT(all.between, 6000);
    // The places are those of the points, a few metres from the closed form.
    const GdalReading truth(file, 1, "");
    for (const glm::dvec2& p : kTwelve) EXPECT_LT(glm::length(truth.pixelOf(bentPlace(p)) - p), 0.2);
}

// A picture without a place of its own lies over the same points; one with points by them.
TEST(DemPlacement, PicturesFollowControlPoints) {
    const TempFolder folder;
    SceneFile scene;
    scene.file = scene.dem = writeRaster(folder / "bent.tif", pointSpec(kTwelve, bentPlace));
    const auto pictureOf = [&](const char* name, RasterSpec spec) {
        spec.type = GDT_Byte;
        spec.bands = 3;
        // Half red, half blue, along the raster's columns.
        const int middle = spec.width / 2;
        spec.value = [middle](int c, int, int band) { return band == (c < middle ? 0 : 2) ? 255.0 : 0.0; };
        return writeRaster(folder / name, spec);
    };
    RasterSpec bare;
    bare.width = 180;
    bare.height = 140;
    bare.placed = false;
    const Georeference place = readGround(scene.dem).source;
    for (const auto& image : {pictureOf("bare.png",
                                        [&] {
                                            bare.driver = "PNG";
                                            return bare;
                                        }()),
                              pictureOf("own.tif", pointSpec(kTwelve, bentPlace))}) {
        scene.image = image;
        Progress progress;
        const TerrainScene terrain = loadTerrain(scene, progress);
        const DemGrid dem = readGround(scene.dem);
        const GdalReading truth(scene.dem, 1, dem.grid.wkt);
        const auto& texels = terrain.color.level(0);
        int red = 0, blue = 0;
        for (int y = 0; y < texels.height(); y += 3)
            for (int x = 0; x < texels.width(); x += 3) {
                const glm::dvec2 share = glm::dvec2(x + 0.5, texels.height() - y - 0.5) /
                                         glm::dvec2(texels.width(), texels.height());
                const glm::dvec2 p =
                    truth.pixelOf(dem.grid.fromPixel(share * glm::dvec2(dem.width, dem.height)));
                if (!(p.x > 1 && p.y > 1 && p.x < 89 && p.y < 69) || std::abs(p.x - 45) < 2) continue;
                const glm::vec3 color = unpackColor(texels.at(x, y));
                (p.x < 45 ? red : blue) += 1;
                EXPECT_EQ(color.x > color.z, p.x < 45) << image << " " << p.x << " " << p.y;
            }
        EXPECT_GT(red, 100);
        EXPECT_GT(blue, 100);
    }
}

TEST(DemPlacement, ControlPointsThatPlaceNothingAreRefused) {
    const TempFolder folder;
    const auto refused = [&](const char* name, const RasterSpec& spec, const std::string& what) {
        const auto file = writeRaster(folder / name, spec);
        expectLine(errorOf([&] { readGround(file); }), file, "ground control points: " + what);
    };
    refused("two.tif", pointSpec({{0, 0}, {90, 70}}, turnedPlace), "expected at least 3, found 2");
    refused("line.tif", pointSpec({{0, 0}, {30, 20}, {60, 40}, {90, 60}}, turnedPlace),
            "expected places all over the raster, found 4 on one line");
    refused("spot.tif", pointSpec(kTwelve, [](glm::dvec2) { return glm::dvec2(500000, 5000000); }),
            "expected places all over the raster, found 12 on one line");
    refused("nameless.tif", pointSpec(kTwelve, turnedPlace, 0), "found 12 without a reference system");
}

TEST(DemPlacement, RationalPolynomialsAloneAreRefused) {
    const TempFolder folder;
    RasterSpec spec;
    spec.width = spec.height = 20;
    spec.placed = false;
    spec.adorn = [](GDALDataset& dataset) {
        for (const char* key : {"LINE_OFF", "SAMP_OFF", "LAT_OFF", "LONG_OFF", "HEIGHT_OFF", "LINE_SCALE",
                                "SAMP_SCALE", "LAT_SCALE", "LONG_SCALE", "HEIGHT_SCALE"})
            dataset.SetMetadataItem(key, "10", "RPC");
        for (const char* key : {"LINE_NUM_COEFF", "LINE_DEN_COEFF", "SAMP_NUM_COEFF", "SAMP_DEN_COEFF"})
            dataset.SetMetadataItem(key, "1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0", "RPC");
    };
    const auto file = writeRaster(folder / "rpc.tif", spec);
    expectLine(errorOf([&] { readGround(file); }), file, "found rational polynomials (RPC) alone");
}

RasterSpec polarSpec(int epsg, double middleX, double middleY, int samples, double step) {
    RasterSpec spec;
    spec.epsg = epsg;
    spec.width = spec.height = samples;
    spec.transform = {middleX - 0.5 * samples * step, step, 0, middleY + 0.5 * samples * step, 0, -step};
    spec.value = [](int c, int r, int) { return 1000 + 5.0 * c - 3.0 * r; };
    return spec;
}

// Polar stereographic, true at 71 degrees south and 70 north: by the closed form on the sphere 2.7 and 3.0 %
// too small at the pole, on the ellipsoid k = 0.97277 and 0.96986.
TEST(DemPlacement, GroundOverAPoleKeepsItsProjection) {
    const TempFolder folder;
    for (const auto& [epsg, scale] : {std::pair{3031, 0.97277}, {3413, 0.96986}}) {
        const auto file = writeRaster(folder / "pole.tif", polarSpec(epsg, 0, 0, 200, 1000));
        const DemGrid dem = readGround(file);
        EXPECT_EQ(dem.width, 200);
        EXPECT_EQ(dem.height, 200);
        EXPECT_NEAR(dem.spacing.x, 1000 / scale, 0.1) << epsg;
        EXPECT_NEAR(dem.spacing.y, 1000 / scale, 0.1) << epsg;
        EXPECT_THAT(dem.projection, AllOf(HasSubstr("as it is"), HasSubstr("over the pole: map scale 0.9")));
        EXPECT_EQ(dem.sourceOffset, glm::dvec2(0));
        const Compared all = compareWithGdal(dem, GdalReading(file, 1, dem.grid.wkt));
        EXPECT_EQ(all.wrong, 0) << all.first;
        EXPECT_EQ(all.exact, 200 * 200);
    }
}

TEST(DemPlacement, TurnedGroundOverAPoleIsMadeLevel) {
    const TempFolder folder;
    RasterSpec spec = polarSpec(3031, 0, 0, 100, 1000);
    const double s = 1000 * std::sin(0.4), c = 1000 * std::cos(0.4);
    spec.transform = {-50 * c - 50 * s, c, s, 50 * c - 50 * s, s, -c};
    const auto file = writeRaster(folder / "turned.tif", spec);
    const DemGrid dem = readGround(file);
    EXPECT_THAT(dem.projection,
                AllOf(HasSubstr("turned level in its own projection"), HasSubstr("over the pole")));
    EXPECT_NEAR(dem.spacing.x, 1000 / 0.97277, 0.1);
    const Compared all = compareWithGdal(dem, GdalReading(file, 1, dem.grid.wkt));
    EXPECT_EQ(all.wrong, 0) << all.first;
    EXPECT_GT(all.between, 9000);
}

// Beside the pole meridians run together: many degrees, little ground.
TEST(DemPlacement, GroundBesideAPoleIsBroughtToMetres) {
    const TempFolder folder;
    const auto file = writeRaster(folder / "beside.tif", polarSpec(3413, 90000, -40000, 120, 1000));
    const DemGrid dem = readGround(file);
    EXPECT_THAT(dem.projection, HasSubstr("local transverse Mercator"));
    EXPECT_NEAR(dem.spacing.x, 1000 / 0.96986, 1);
    const Compared all = compareWithGdal(dem, GdalReading(file, 1, dem.grid.wkt));
    EXPECT_EQ(all.wrong, 0) << all.first;
}

TEST(DemPlacement, HalfAGlobeOverAPoleIsRefused) {
    const TempFolder folder;
    const auto file = writeRaster(folder / "half.tif", polarSpec(3413, 0, 0, 100, 120000));
    expectLine(errorOf([&] { readGround(file); }), file, "scales differ by at most 1.2 times");
    // Antarctica whole.
    EXPECT_EQ(readGround(writeRaster(folder / "south.tif", polarSpec(3031, 0, 0, 100, 60000))).width, 100);
}

// A survey's own plane, not tied to the Earth, in feet: turned level in it.
TEST(DemPlacement, TurnedLocalPlaneInFeet) {
    const TempFolder folder;
    RasterSpec spec = polarSpec(0, 0, 0, 50, 10);
    spec.transform = {100, 9.6, 2.8, 200, 2.8, -9.6};
    spec.adorn = [](GDALDataset& dataset) {
        OGRSpatialReference local;
        local.SetLocalCS("site grid");
        local.SetLinearUnits("foot", 0.3048);
        ASSERT_EQ(dataset.SetSpatialRef(&local), CE_None);
    };
    const auto file = writeRaster(folder / "site.tif", spec);
    const DemGrid dem = readGround(file);
    EXPECT_NEAR(dem.spacing.x, 10 * 0.3048, 1e-9);
    const Compared all = compareWithGdal(dem, GdalReading(file, 1, ""));
    EXPECT_EQ(all.wrong, 0) << all.first;
    EXPECT_GT(all.between, 2000);
}

}  // namespace
}  // namespace stereonav::test
