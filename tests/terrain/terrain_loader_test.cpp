// A scene put together: what the loader chooses where the scene is silent, and what it takes over.
#include "terrain/scene/terrain_loader.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "engine/image/packed_color.h"
#include "engine/math/constants.h"
#include "raster_files.h"
#include "terrain/ground/nodata.h"
#include "terrain/scene/landmark.h"
#include "terrain/scene/terrain_illumination.h"
#include "tests/support/own_cache.h"

namespace stereonav {
namespace {

using test::errorOf;
using test::RasterSpec;
using test::TempFolder;
using test::writeRaster;
using testing::HasSubstr;

RasterSpec hillSpec() {
    RasterSpec spec;
    spec.width = 60;
    spec.height = 50;
    spec.value = [](int c, int r, int) { return 500 + 200 * std::sin(0.2 * c) * std::cos(0.15 * r); };
    return spec;
}

SceneFile sceneOf(const std::filesystem::path& dem) {
    SceneFile scene;
    scene.file = scene.dem = dem;
    return scene;
}

TerrainScene load(const SceneFile& file) {
    Progress progress;
    return loadTerrain(file, progress);
}

TEST(TerrainLoader, ChoosesWhatTheSceneDoesNotSay) {
    const TempFolder folder;
    const TerrainScene scene = load(sceneOf(writeRaster(folder / "hills.tif", hillSpec())));
    EXPECT_EQ(scene.ground.width(), 60);
    EXPECT_EQ(scene.report.driver, "GeoTIFF");
    EXPECT_EQ(scene.report.sourceCrs, "WGS 84 / UTM zone 33N");
    EXPECT_EQ(scene.report.missingSamples, 0);
    EXPECT_EQ(scene.report.colorSource, "tint by height and slope, lit");
    EXPECT_EQ(scene.report.skySource, "built-in gradient");
    EXPECT_EQ(scene.landmarks, nullptr);
    EXPECT_EQ(scene.clearance, 7.5);
    EXPECT_GT(scene.lens.nearDepth, 0);
    EXPECT_LT(scene.lens.nearDepth, scene.clearance);
    EXPECT_DOUBLE_EQ(scene.stereo.separation, scene.stereo.zeroParallax / 30);
    const Pose& start = scene.startPose;
    EXPECT_GE(start.position.z - scene.ground.heightAt(glm::dvec2(start.position)), scene.clearance);
    EXPECT_GE(scene.path.samples().size(), 2u);
    for (const PathSample& sample : scene.path.samples()) {
        const glm::dvec3 p = sample.pose.position;
        EXPECT_GE(p.z - scene.ground.heightAt(glm::dvec2(p)), scene.clearance) << sample.time;
    }
}

TEST(TerrainLoader, ChoosesViewSunAirAndLightWhereNothingSaysThem) {
    const TempFolder folder;
    SceneFile file = sceneOf(writeRaster(folder / "hills.tif", hillSpec()));
    const TerrainScene plain = load(file);
    file.chosen = file.quickLight = true;
    const TerrainScene scene = load(file);
    EXPECT_NE(scene.startPose.position, plain.startPose.position);
    EXPECT_NE(scene.look.sunAzimuth, plain.look.sunAzimuth);
    EXPECT_LE(scene.look.sunElevation, 35 * kRadians);
    EXPECT_TRUE(scene.look.physicalSky);
    EXPECT_THAT(scene.report.skySource, HasSubstr("scattering in the air, visibility"));
    ASSERT_NE(scene.illumination, nullptr);
    EXPECT_EQ(scene.illumination->light().grid.width, 60);
    EXPECT_EQ(scene.report.lightSource,
              "worked out with the first picture: the sun's shadow at 60x50 samples, openness at 60x50");
    EXPECT_THAT(scene.report.notes, testing::Contains(HasSubstr("sun chosen for the first view")));
    // The same ground, the same choice.
    EXPECT_EQ(load(file).startPose.position, scene.startPose.position);
}

// Natural colours, whatever unit and system the file is in; those of a plain look stay.
TEST(TerrainLoader, ChoosesNaturalColours) {
    const TempFolder folder;
    RasterSpec spec = hillSpec();
    const auto colorOf = [&](bool chosen) {
        SceneFile file = sceneOf(writeRaster(folder / "hills.tif", spec));
        file.chosen = chosen;
        file.sunGiven = file.fogGiven = true;
        return load(file);
    };
    EXPECT_EQ(colorOf(false).report.colorSource, "tint by height and slope, lit");
    const TerrainScene metres = colorOf(true);
    EXPECT_EQ(metres.report.colorSource,
              "natural colours by latitude, height, slope, aspect and wetness, lit");
    spec.value = [](int c, int r, int) {
        return (500 + 200 * std::sin(0.2 * c) * std::cos(0.15 * r)) / 0.3048;
    };
    spec.unit = "ft";
    const TerrainScene feet = colorOf(true);
    const auto one = metres.color.level(0), other = feet.color.level(0);
    for (int y = 0; y < one.height(); ++y)
        for (int x = 0; x < one.width(); ++x)
            ASSERT_LT(glm::distance(unpackColor(one.at(x, y)), unpackColor(other.at(x, y))), 0.004f);
    spec.unit = nullptr;
    spec.value = [](int c, int r, int) { return 500 + 20 * std::sin(0.2 * c) * std::cos(0.15 * r); };
    spec.epsg = 3413;  // over the pole
    spec.transform = {-900, 30, 0, 750, 0, -30};
    const TerrainScene overThePole = colorOf(true);
    EXPECT_EQ(overThePole.report.colorSource, metres.report.colorSource);
    const glm::vec3 pole = unpackColor(overThePole.color.level(0).at(60, 50));
    EXPECT_GT(pole.z, 0.3f) << "ice";
    spec.epsg = 0;
    EXPECT_EQ(colorOf(true).report.colorSource,
              "natural colours by height, slope and wetness, of no known latitude, lit");
}

// Palettes have the chosen light; relief after Imhof has its own sun.
TEST(TerrainLoader, PalettesAreLit) {
    const TempFolder folder;
    SceneFile file = sceneOf(writeRaster(folder / "hills.tif", hillSpec()));
    file.chosen = file.quickLight = true;
    for (const GroundPaint paint : {GroundPaint::Hypsometric, GroundPaint::Swiss, GroundPaint::Grey}) {
        file.paint = paint;
        const TerrainScene scene = load(file);
        EXPECT_NE(scene.illumination, nullptr);
        EXPECT_EQ(scene.look.sunAzimuth == TerrainLook().sunAzimuth, paint == GroundPaint::Swiss);
    }
}

TEST(TerrainLoader, ChoosesNothingThatIsSaid) {
    const TempFolder folder;
    SceneFile file = sceneOf(writeRaster(folder / "hills.tif", hillSpec()));
    file.chosen = file.quickLight = true;
    file.startPosition = glm::dvec3(10, 20, 120);
    file.startHeading = 1.2;
    file.sunGiven = true;
    file.fogGiven = true;
    file.look.fogDistance = 5000;
    const TerrainScene scene = load(file);
    EXPECT_NEAR(anglesOf(scene.startPose).heading, 1.2, 1e-9);
    EXPECT_EQ(scene.look.sunAzimuth, TerrainLook().sunAzimuth);
    EXPECT_EQ(scene.look.sunElevation, TerrainLook().sunElevation);
    EXPECT_FALSE(scene.look.physicalSky);
    EXPECT_EQ(scene.look.fogDistance, 5000);
    file.look.physicalSky = file.visibilityGiven = true;
    file.look.visibility = 12e3;
    EXPECT_EQ(load(file).look.visibility, 12e3);
    // Hillshade has the sun of maps, and is light itself.
    file.sunGiven = false;
    file.paint = GroundPaint::Hillshade;
    EXPECT_EQ(load(file).look.sunAzimuth, TerrainLook().sunAzimuth);
    EXPECT_EQ(load(file).illumination, nullptr);
}

TEST(TerrainLoader, HazeSuitsTheExtent) {
    const TempFolder folder;
    RasterSpec spec = hillSpec();
    SceneFile file = sceneOf(writeRaster(folder / "hills.tif", spec));
    file.chosen = true;
    EXPECT_EQ(load(file).look.visibility, 60e3) << "2 km across: a usual day";
    spec.transform = {400000, 600, 0, 5000000, 0, -600};
    file.dem = writeRaster(folder / "range.tif", spec);
    const double far = load(file).look.visibility;
    EXPECT_GT(far, 150e3) << "46 km across";
    EXPECT_LT(far, 250e3);
    spec.transform = {400000, 9000, 0, 5000000, 0, -9000};
    file.dem = writeRaster(folder / "land.tif", spec);
    EXPECT_FALSE(load(file).look.physicalSky) << "700 km of air hide all";
}

// The zero-parallax distance is that of the ground straight ahead.
TEST(TerrainLoader, ZeroParallaxLiesOnTheGroundAhead) {
    const TempFolder folder;
    SceneFile file = sceneOf(writeRaster(folder / "hills.tif", hillSpec()));
    const auto checkAhead = [&](const TerrainScene& scene) {
        const glm::dvec3 p = scene.startPose.position + scene.stereo.zeroParallax * scene.startPose.forward();
        EXPECT_TRUE(scene.ground.contains(glm::dvec2(p)));
        EXPECT_NEAR(p.z, scene.ground.heightAt(glm::dvec2(p)), 1e-3);
    };
    for (const double heading : {0.0, 1.0, 2.5, 4.0})
        for (const double pitch : {-1.5, -0.8, -0.5}) {
            file.startPosition = glm::dvec3(50, -40, 300);
            file.startHeading = heading;
            file.startPitch = pitch;
            checkAhead(load(file));
        }
    // Looking up there is none: a share of the extent.
    file.startPitch = 0.6;
    EXPECT_DOUBLE_EQ(load(file).stereo.zeroParallax, 0.25 * 49 * 30);
}

TEST(TerrainLoader, TakesOverWhatTheSceneSays) {
    const TempFolder folder;
    SceneFile file = sceneOf(writeRaster(folder / "hills.tif", hillSpec()));
    file.startPosition = glm::dvec3(10, 20, 120);
    file.startHeading = 1.2;
    file.startPitch = -0.3;
    file.startRoll = 0.1;
    file.separation = 7;
    file.zeroParallax = 450;
    file.verticalFov = 0.6;
    file.clearance = 11;
    file.verticalScale = 2;
    TerrainScene scene = load(file);
    EXPECT_EQ(scene.stereo.separation, 7);
    EXPECT_EQ(scene.stereo.zeroParallax, 450);
    EXPECT_EQ(scene.lens.verticalFov, 0.6);
    EXPECT_EQ(scene.clearance, 11);
    EXPECT_NEAR(scene.ground.maxHeight(), 1400, 5);
    EXPECT_NEAR(scene.startPose.position.z, scene.ground.heightAt({10, 20}) + 120, 1e-9);
    const PoseAngles angles = anglesOf(scene.startPose);
    EXPECT_NEAR(angles.heading, 1.2, 1e-9);
    EXPECT_NEAR(angles.pitch, -0.3, 1e-9);
    EXPECT_NEAR(angles.roll, 0.1, 1e-9);
    file.startAboveGround = false;
    scene = load(file);
    EXPECT_EQ(scene.startPose.position, glm::dvec3(10, 20, 120));
}

TEST(TerrainLoader, FillsOrLeavesHoles) {
    const TempFolder folder;
    RasterSpec spec = hillSpec();
    spec.hasNodata = true;
    spec.nodata = -1;
    spec.value = [](int c, int r, int) { return c > 20 && c < 30 && r > 10 && r < 16 ? -1.0 : 100.0 + c; };
    SceneFile file = sceneOf(writeRaster(folder / "holed.tif", spec));
    TerrainScene scene = load(file);
    EXPECT_EQ(scene.report.missingSamples, 45);
    EXPECT_EQ(scene.report.filledSamples, 45);
    EXPECT_FALSE(scene.ground.hasHoles());
    file.openHoles = true;
    scene = load(file);
    EXPECT_EQ(scene.report.missingSamples, 45);
    EXPECT_EQ(scene.report.filledSamples, 0);
    EXPECT_TRUE(scene.ground.hasHoles());
}

// Corners that a turned raster leaves empty are no missing samples of the file.
TEST(TerrainLoader, CountsWhatIsMissingInTheFileAndOnTheGroundApart) {
    const TempFolder folder;
    RasterSpec spec = hillSpec();
    spec.transform = {500000, 26, 15, 5000000, 15, -26};
    SceneFile file = sceneOf(writeRaster(folder / "turned.tif", spec));
    for (const bool open : {false, true}) {
        file.openHoles = open;
        const TerrainScene scene = load(file);
        EXPECT_EQ(scene.report.sourceSamples, 60 * 50);
        EXPECT_EQ(scene.report.missingSamples, 0);
        EXPECT_GT(scene.report.outsideSamples, 500);
        EXPECT_EQ(scene.report.filledSamples, open ? 0 : scene.report.outsideSamples);
        EXPECT_EQ(scene.report.openSamples, open ? scene.report.outsideSamples : 0);
        EXPECT_EQ(countMissing({scene.ground.data(),
                                scene.ground.data() + scene.ground.width() * scene.ground.height()}),
                  scene.report.openSamples);
    }
}

TEST(TerrainLoader, ExtremeRangesGiveAWholeScene) {
    const TempFolder folder;
    for (const double range : {0.0, 1e-6, 1e6}) {
        RasterSpec spec = hillSpec();
        spec.type = GDT_Float64;
        spec.value = [range](int c, int r, int) { return range * (0.5 + 0.5 * std::sin(0.4 * c + 0.2 * r)); };
        const TerrainScene scene = load(sceneOf(writeRaster(folder / "range.tif", spec)));
        EXPECT_LE(scene.ground.maxHeight() - scene.ground.minHeight(), range + 1e-9);
        EXPECT_TRUE(std::isfinite(scene.stereo.zeroParallax) && scene.stereo.zeroParallax > 0) << range;
        EXPECT_GT(scene.stereo.separation, 0) << range;
        for (const PathSample& sample : scene.path.samples()) {
            const glm::dvec3 p = sample.pose.position;
            EXPECT_GE(p.z - scene.ground.heightAt(glm::dvec2(p)), scene.clearance * (1 - 1e-9)) << range;
        }
    }
}

TEST(TerrainLoader, TheSmallestGroundLoads) {
    const TempFolder folder;
    const auto dem =
        folder.text("two.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 5\n1 2\n3 4\n");
    const TerrainScene scene = load(sceneOf(dem));
    EXPECT_EQ(scene.ground.width(), 2);
    EXPECT_GT(scene.stereo.zeroParallax, 0);
}

TEST(TerrainLoader, BuiltInTerrain) {
    SceneFile file;
    file.builtIn = true;
    file.builtInSize = 65;
    const TerrainScene scene = load(file);
    EXPECT_EQ(scene.ground.width(), 65);
    EXPECT_EQ(scene.report.driver, "built-in");
    EXPECT_EQ(scene.report.colorSource, "generated, lit");
    // The picture's outer edges lie on the outer samples.
    EXPECT_EQ(scene.color.gridOrigin(), glm::dvec2(0));
    EXPECT_DOUBLE_EQ(scene.color.gridPerTexel().x * scene.color.level(0).width(), 64);
}

// Texel for pixel, and none of it left to the tint.
TEST(TerrainLoader, APictureCoversTheWholeBuiltInTerrain) {
    const TempFolder folder;
    RasterSpec picture;
    picture.type = GDT_Byte, picture.bands = 3;
    picture.width = 40, picture.height = 30;
    picture.value = [](int c, int r, int) { return 10 + 5 * c + r; };
    SceneFile file;
    file.builtIn = true;
    file.builtInSize = 65;
    file.image = writeRaster(folder / "picture.tif", picture);
    const TerrainScene scene = load(file);
    const auto& texels = scene.color.level(0);
    ASSERT_EQ(texels.width(), 40);
    ASSERT_EQ(texels.height(), 30);
    EXPECT_FALSE(scene.report.colorHoldsSun);
    for (const glm::ivec2 at : {glm::ivec2(0, 0), {39, 29}, {12, 20}}) {
        const double display = std::sqrt(unpackColor(texels.at(at.x, 29 - at.y)).x);
        EXPECT_NEAR(display * 255, 10 + 5 * at.x + at.y, 12) << at.x;
    }
}

TEST(TerrainLoader, ErrorsOfAnyFileComeThrough) {
    const TempFolder folder;
    const SceneFile good = sceneOf(writeRaster(folder / "hills.tif", hillSpec()));
    SceneFile file = sceneOf(folder / "none.tif");
    EXPECT_THAT(errorOf([&] { load(file); }), HasSubstr("none.tif: there is no such file"));
    file = good;
    file.image = folder / "none.jpg";
    EXPECT_THAT(errorOf([&] { load(file); }), HasSubstr("none.jpg: there is no such file"));
    file = good;
    file.sky = folder / "none.png";
    EXPECT_THAT(errorOf([&] { load(file); }), HasSubstr("none.png: there is no such file"));
    file = good;
    file.path = folder / "none.path";
    EXPECT_THAT(errorOf([&] { load(file); }), HasSubstr("none.path"));
    file = good;
    file.verticalScale = 0;
    EXPECT_THAT(errorOf([&] { load(file); }), HasSubstr("expected a number above 0, got 0"));
    SceneFile builtIn;
    builtIn.builtIn = true;
    builtIn.builtInSize = 65;
    builtIn.verticalScale = 1e300;
    EXPECT_THAT(errorOf([&] { load(builtIn); }),
                HasSubstr("the built-in terrain:vertical scale: expected heights within 10,000 km"));
    const auto thin =
        folder.text("thin.asc", "ncols 5\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 5\n1 2 3 4 5\n");
    EXPECT_THAT(errorOf([&] { load(sceneOf(thin)); }), HasSubstr("expected at least 2x2 samples, got 5x1"));
}

TEST(TerrainLoader, RealScenes) {
    const std::pair<const char*, const char*> scenes[] = {
        {"srtm_bigtujunga30m_utm11.tif", ""},
        {"SainteHelens.dem", ""},
        {"mt_rainier_90m.tif", ""},
        {"ararat/agri-small-dem-utm38n-30m.tif", "ararat/agri-small-winter.jpg"},
        {"gsi/altitude.png", "gsi/color.jpg"}};
    for (const auto& [dem, image] : scenes) {
        const auto file = test::realData(dem);
        if (file.empty()) GTEST_SKIP() << "real data is absent: " << dem;
        SceneFile named = sceneOf(file);
        if (*image) named.image = test::realData(image);
        const TerrainScene scene = load(named);
        EXPECT_FALSE(scene.ground.hasHoles()) << dem;
        EXPECT_TRUE(std::isfinite(scene.ground.maxSlope())) << dem;
        EXPECT_GT(scene.stereo.zeroParallax, 5 * scene.lens.nearDepth) << dem;
        const double above =
            scene.startPose.position.z - scene.ground.heightAt(glm::dvec2(scene.startPose.position));
        EXPECT_GE(above, scene.clearance) << dem;
    }
}

}  // namespace
}  // namespace stereonav
