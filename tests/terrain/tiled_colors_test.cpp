// Ground in tiles under a picture, and under baked light: near the eye as the same ground in memory.
#include <algorithm>
#include <cmath>

#include "engine/camera/stereo_rig.h"
#include "engine/peers/peers.h"
#include "terrain/light/fine_bake.h"
#include "terrain/light/terrain_light.h"
#include "terrain/scene/laid_picture.h"
#include "terrain/scene/part_colors.h"
#include "terrain/scene/part_light.h"
#include "terrain/scene/terrain_illumination.h"
#include "tiled_case.h"

namespace stereonav::test {
namespace {

namespace fs = std::filesystem;

// 10 m samples, of which every second or fourth is in memory, under a picture of 5 m pixels that leaves the
// west out.
class TiledColors : public TiledCase {
protected:
    TiledColors() {
        RasterSpec dem;
        dem.width = 600, dem.height = 500;
        dem.transform = {400000, 10, 0, 5000000, 0, -10};
        dem.value = [](int c, int r, int) {
            return 800 + 150 * std::sin(c / 97.) * std::cos(r / 83.) +
                   20 * std::sin(c / 7.) * std::sin(r / 9.) + 4 * std::sin(c * 1.7 + r);
        };
        mFile.dem = mFile.file = writeRaster(mFolder / "ground.tif", dem);
        RasterSpec picture;
        picture.type = GDT_Byte, picture.bands = 3;
        picture.width = 1000, picture.height = 1000;
        picture.transform = {401000, 5, 0, 5000000, 0, -5};
        picture.value = [](int c, int r, int band) {
            return 120 + 60 * ((c / 4 + r / 4) % 2) + 40 * std::sin(c / 60. + band) * std::cos(r / 40.);
        };
        mPicture = writeRaster(mFolder / "picture.tif", picture);
    }

    TerrainScene load(GroundTiles tiles) {
        TerrainScene scene = loadWithin(tiles, 40e6);
        limitMemory(0);  // rings have what they need
        return scene;
    }

    fs::path mPicture;
};

EyeImage seenAt(const TerrainRenderer& renderer, const TerrainScene& scene, const glm::dvec2& place,
                double heading) {
    return pictureOf(
        renderer, makeEyeView(poseFromAngles(glm::dvec3(place, scene.heightAt(place) + 60), heading, -0.3, 0),
                              {240, 150, 1, 0.5, 0.5}));
}

TEST_F(TiledColors, APictureIsAsSharpAsOverTheGroundInMemory) {
    mFile.image = mPicture;
    const TerrainScene whole = load(GroundTiles::Off), tiled = load(GroundTiles::On);
    ASSERT_TRUE(tiled.tiled && tiled.pictured);
    ASSERT_GE(tiled.tiled->level, 1) << tiled.report.tiles;
    EXPECT_NEAR(tiled.pictured->picture->density(tiled.ground).x, 2.0 * (1 << tiled.tiled->level), 1e-3);
    const TerrainRenderer fromMemory(whole);
    TerrainRenderer fromTiles(tiled);
    // Over the picture, over its western edge, and in the far corner.
    for (const auto& [place, heading] : {std::pair{glm::dvec2(300, 200), 0.3},
                                         {glm::dvec2(-2000, 300), 1.6},
                                         {glm::dvec2(2800, -2300), -0.6}}) {
        const EyeImage a = seenAt(fromMemory, whole, place, heading),
                       b = seenAt(fromTiles, tiled, place, heading);
        EXPECT_LT(rootMeanSquare(a, b), 0.012) << place.x;
        fromTiles.showColors(tiled.color, nullptr, {});
        const EyeImage coarse = seenAt(fromTiles, tiled, place, heading);
        fromTiles.showColors(tiled.color, nullptr, partColorsOf(tiled));
        EXPECT_LT(rootMeanSquare(a, b), 0.5 * rootMeanSquare(a, coarse)) << place.x;
    }
}

TEST_F(TiledColors, APictureThatCanNotBeReadLaterIsOneLine) {
    mFile.image = mPicture;
    const TerrainScene scene = load(GroundTiles::On);
    const TerrainRenderer renderer(scene);
    const auto fly = [&] { seenAt(renderer, scene, {300, 200}, 0.3); };
    fs::rename(mPicture, mFolder / "elsewhere.tif");
    EXPECT_THAT(errorOf(fly), AllOf(HasSubstr("picture.tif"), HasSubstr("there is no such file")));
    RasterSpec other;
    other.type = GDT_Byte, other.width = other.height = 20;
    writeRaster(mPicture, other);
    EXPECT_THAT(errorOf(fly), AllOf(HasSubstr("picture.tif"), HasSubstr("1000x1000"), HasSubstr("20x20")));
    fs::rename(mFolder / "elsewhere.tif", mPicture);
    fs::resize_file(mPicture, 40000);
    EXPECT_THAT(errorOf(fly), HasSubstr("picture.tif"));
}

// Returns light as if baked where nothing blocks any light.
TerrainLight openLight(const Heightfield& ground) {
    TerrainLight light;
    light.settings.kind = TerrainLightKind::Openness;
    light.grid = LightGrid(ground, 1);
    light.key = terrainLightKey(ground, light.settings);
    light.openness.assign(light.grid.count(), 255);
    return light;
}

// The whole ground is baked at its own samples, and at the level in memory, each with light of its own.
TEST_F(TiledColors, BakedLightKeepsTheFineReliefAndFollowsTheSun) {
    mFile.look.ambient = 0.3;
    const fs::path ofWhole = mFolder / "whole.light", ofTiled = mFolder / "tiled.light";
    saveTerrainLight(ofWhole, openLight(load(GroundTiles::Off).ground));
    saveTerrainLight(ofTiled, openLight(load(GroundTiles::On).ground));
    for (const bool pictured : {false, true}) {
        if (pictured) mFile.image = mPicture;
        mFile.light = ofWhole;
        TerrainScene whole = load(GroundTiles::Off);
        mFile.light = ofTiled;
        TerrainScene tiled = load(GroundTiles::On);
        ASSERT_TRUE(tiled.illumination && tiled.tiled);
        ASSERT_GE(tiled.tiled->level, 1);
        TerrainRenderer fromMemory(whole), fromTiles(tiled);
        const double azimuth = pictured ? 1.1 : 5.4;  // neither is where it was
        moveSun(whole, azimuth, 0.8);
        moveSun(tiled, azimuth, 0.8);
        fromMemory.sunMoved();
        fromTiles.sunMoved();
        const EyeImage truth = seenAt(fromMemory, whole, {300, 200}, 0.3),
                       fine = seenAt(fromTiles, tiled, {300, 200}, 0.3);
        fromTiles.showColors(tiled.color, tiled.illumination.get(), {});
        const EyeImage coarse = seenAt(fromTiles, tiled, {300, 200}, 0.3);
        EXPECT_LT(rootMeanSquare(fine, truth), 0.7 * rootMeanSquare(coarse, truth)) << pictured;
    }
}

// Tiles of the finest samples: what is seen in them is nearer to the light of the ground in memory than the
// light of the level is, in both eyes and as the sun moves.
TEST_F(TiledColors, LightBakedAtFinerSamplesIsSeenNearTheEye) {
    RasterSpec dem;
    dem.width = 280, dem.height = 200;
    dem.transform = {400000, 10, 0, 5000000, 0, -10};
    dem.value = [](int c, int r, int) {
        return 800 + 60 * std::sin(c / 11.) * std::sin(r / 9.) + 9 * std::sin(c * 0.9 + r * 0.4);
    };
    mFile.dem = mFile.file = writeRaster(mFolder / "small.tif", dem);
    mFile.colorsAlone = true;
    TerrainLightSettings settings;
    settings.order = 1, settings.bounces = 0, settings.azimuths = 8;
    Progress quiet;
    const auto light = [&](TerrainScene& scene) {
        scene.illumination = std::make_unique<TerrainIllumination>(
            scene.ground, scene.color, scene.sky, bakeTerrainLight(scene.ground, settings, quiet), 1.0f);
        scene.illumination->apply(scene.look, scene.color);
    };
    TerrainScene whole = load(GroundTiles::Off), tiled = loadWithin(GroundTiles::On, 8e6);
    // What the process holds shrinks and grows beside the scene.
    for (double allowed = 6e6; tiled.tiled->level == 0 && allowed > 2e6; allowed -= 1e6)
        tiled = loadWithin(GroundTiles::On, allowed);
    limitMemory(0);
    ASSERT_GE(tiled.tiled->level, 1) << tiled.report.tiles;
    light(whole);
    light(tiled);
    const auto levels = tiled.tiled->levels;
    const TerrainLight& baked = tiled.illumination->light();
    const FineLightShape shape = fineLightShape(*levels, tiled.tiled->level, baked, 3);
    const fs::path place = fineLightPlace(mFolder / "tiled.light");
    Peers alone;
    bakeFineLight(FineBake(*levels, tiled.ground, baked), place, mFolder / "part", shape, quiet, alone);
    const auto finer = std::make_shared<const FineLight>(levels, LightTiles(place, shape), SimdTarget::Auto);
    TerrainRenderer fromWhole(whole), fromTiles(tiled);
    for (const double azimuth : {1.1, 5.4}) {
        const auto seen = [&](TerrainScene& scene, TerrainRenderer& renderer, double x) {
            moveSun(scene, azimuth, 0.35);
            renderer.sunMoved();
            return seenAt(renderer, scene, {x, 200}, 0.3);
        };
        for (const double x : {300.0, 340.0}) {
            const EyeImage truth = seen(whole, fromWhole, x);
            tiled.illumination->takeFiner(nullptr);
            const EyeImage coarse = seen(tiled, fromTiles, x);
            tiled.illumination->takeFiner(finer);
            EXPECT_LT(rootMeanSquare(seen(tiled, fromTiles, x), truth), 0.5 * rootMeanSquare(coarse, truth));
        }
    }
}

// A part of the same samples as what was baked has the light that was baked.
TEST_F(TiledColors, APartThatIsNoFinerHasTheBakedLight) {
    const TerrainScene scene = load(GroundTiles::Off);
    const LightGrid grid(scene.ground, 1);
    GroundBrightness brightness;
    brightness.width = grid.width, brightness.height = grid.height;
    for (int c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < grid.count(); ++k)
            brightness.planes.push_back(0.1f + 0.3f * static_cast<float>(c) +
                                        0.001f * static_cast<float>(k % 97));
    const PartLight light(scene.ground, grid, brightness, scene.look, {0.8f, 0.5f});
    Plane<PackedColor> gray(grid.width, grid.height);
    for (int y = 0; y < gray.height(); ++y)
        std::fill_n(gray.row(y), gray.width(), packColor(glm::vec3(0.4f)));
    ColorTexture colors(gray, glm::dvec2(-0.5), glm::dvec2(1.0));
    light.apply(scene.ground, colors);
    for (const glm::ivec2 at : {glm::ivec2(0, 0), {70, 3}, {599, 499}, {301, 250}}) {
        const glm::vec3 seen = unpackColor(colors.level(0).at(at.x, at.y)),
                        baked = 0.8f * brightness.at(at.x, at.y);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], 0.4f * (1 + 0.5f * (baked[c] - 1)), 2e-3) << at.x;
    }
}

TEST_F(TiledColors, TexelsOfAPartAreThePicturesWithinALimit) {
    PartColors colors;
    EXPECT_EQ(colors.texels(1000, 0), 1000);
    EXPECT_EQ(colors.texels(0, 3), 0);
    colors.texelsASample = 4, colors.mostTexels = 1e5;
    EXPECT_EQ(colors.texels(1000, 0), 4000);
    EXPECT_EQ(colors.texels(1000, 2), 64000);
    EXPECT_EQ(colors.texels(1000, 8), 1e5);
    EXPECT_EQ(colors.texels(1e6, 0), 1e6) << "never less than one a sample is counted";
    colors.texelsASample = 0.01;
    EXPECT_EQ(colors.texels(1000, 0), 1000);
}

}  // namespace
}  // namespace stereonav::test
