// A ground in tiles against the same ground in memory: heights, depths, colours, and what becomes of damage.
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <thread>

#include "engine/base/memory.h"
#include "engine/camera/stereo_rig.h"
#include "terrain/read/dem_rows.h"
#include "terrain/scene/followed_track.h"
#include "terrain/scene/ground_place.h"
#include "terrain/scene/stand_in_ground.h"
#include "tests/support/wait_for.h"
#include "tiled_case.h"

namespace stereonav::test {
namespace {

namespace fs = std::filesystem;

// Tells a file from one that took its place.
ino_t fileNumber(const fs::path& file) {
    struct stat is {};
    EXPECT_EQ(stat(file.c_str(), &is), 0) << file;
    return is.st_ino;
}

// The whole ground would take 63 MB: a quarter of what is allowed holds its next level.
class TiledScene : public TiledCase {
protected:
    TiledScene() {
        RasterSpec spec;
        spec.width = 1100, spec.height = 900;
        spec.transform = {400000, 10, 0, 5000000, 0, -10};
        spec.value = [](int c, int r, int) {
            return 800 + 250 * std::sin(c / 97.) * std::cos(r / 83.) +
                   30 * std::sin(c / 7.) * std::sin(r / 9.) + 4 * std::sin(c * 1.7 + r);
        };
        mFile.dem = mFile.file = writeRaster(mFolder / "ground.tif", spec);
    }

    TerrainScene load(GroundTiles tiles, double allowed = 180e6) { return loadWithin(tiles, allowed); }
    fs::path tilesFile() const {
        if (!fs::exists(mFolder / "cache" / "stereonav")) return {};
        for (const auto& entry : fs::directory_iterator(mFolder / "cache" / "stereonav"))
            if (entry.path().extension() == ".tiles") return entry.path();
        return {};
    }
};

EyeView viewAt(const TerrainScene& scene, const glm::dvec2& place, double heading, double over) {
    const Lens lens{320, 200, 1.0, 0.5, 0.5};
    return makeEyeView(poseFromAngles(glm::dvec3(place, scene.heightAt(place) + over), heading, -0.15, 0),
                       lens);
}

TEST_F(TiledScene, IsTheGroundInMemoryNearTheEye) {
    const TerrainScene whole = load(GroundTiles::Off), tiled = load(GroundTiles::On);
    ASSERT_TRUE(tiled.tiled);
    ASSERT_EQ(tiled.tiled->level, 1) << tiled.report.tiles;
    EXPECT_EQ(tiled.ground.spacing(), glm::dvec2(20, 20));
    EXPECT_EQ(tiled.clearance, whole.clearance);
    EXPECT_EQ(tiled.lens.nearDepth, whole.lens.nearDepth);
    const TerrainRenderer fromMemory(whole), fromTiles(tiled);
    for (const auto& [place, heading] : {std::pair{glm::dvec2(0, 0), 0.3},
                                         {glm::dvec2(-4400, 3000), 2.2},
                                         {glm::dvec2(5400, -4400), -0.6}}) {
        EXPECT_EQ(tiled.heightAt(place), whole.ground.heightAt(place));
        const auto read = groundPlaceAt(tiled, place), known = groundPlaceAt(whole, place);
        ASSERT_TRUE(read && known);
        EXPECT_NEAR(read->slope, known->slope, 1e-12);
        const EyeView view = viewAt(tiled, place, heading, 60);
        const EyeImage a = pictureOf(fromMemory, view), b = pictureOf(fromTiles, view);
        ASSERT_TRUE(fromMemory.rings());
        ASSERT_EQ(fromMemory.rings()->rings.size(), fromTiles.rings()->rings.size());
        for (int y = 0; y < a.height(); ++y)
            for (int x = 0; x < a.width(); ++x)
                ASSERT_EQ(a.viewDepth.at(x, y), b.viewDepth.at(x, y)) << x << " " << y;
        EXPECT_LT(rootMeanSquare(a, b), 0.02) << "of a display's range: a texel a sample in place of two";
    }
}

TEST_F(TiledScene, IsMadeOnceAndAgainWhereDamaged) {
    EXPECT_NE(load(GroundTiles::On).report.tiles.find("made now"), std::string::npos);
    EXPECT_EQ(load(GroundTiles::On).report.tiles.find("made now"), std::string::npos);
    fs::resize_file(tilesFile(), 5000);
    EXPECT_NE(load(GroundTiles::On).report.tiles.find("made now"), std::string::npos);
    {
        // A byte of the last tile, of the coarsest level: what is in memory is read from another.
        std::fstream stream(tilesFile(), std::ios::in | std::ios::out | std::ios::binary);
        stream.seekp(1 << 20);
        stream.put('?');
    }
    const TerrainScene scene = load(GroundTiles::On);
    const TerrainRenderer renderer(scene);
    EXPECT_THAT(errorOf([&] {
                    for (double x = -5000; x <= 5000; x += 2500)
                        for (double y = -4000; y <= 4000; y += 2000)
                            pictureOf(renderer, viewAt(scene, {x, y}, 0, 10));
                }),
                AllOf(HasSubstr("is damaged"), HasSubstr("remove the file")));
}

TEST_F(TiledScene, IsTakenWhereMemoryDoesNotSuffice) {
    EXPECT_TRUE(load(GroundTiles::Auto, 50e6).tiled);
    limitMemory(0);
    SceneFile file = mFile;
    Progress progress;
    EXPECT_FALSE(loadTerrain(file, progress).tiled);
}

// What is refused is refused again: nothing of it was kept as good.
TEST_F(TiledScene, IsRefusedAsOftenAsItIsOpened) {
    RasterSpec spec;
    spec.width = spec.height = 40;
    spec.type = GDT_Float64;
    spec.value = [](int c, int, int) { return 9e6 + 0.01 * c; };
    const fs::path fine = writeRaster(mFolder / "fine.tif", spec), hills = mFile.dem;
    for (int time = 0; time < 2; ++time) {
        mFile.dem = fine;
        EXPECT_THAT(errorOf([&] { load(GroundTiles::On); }), HasSubstr("single precision")) << time;
        mFile.dem = hills;
        mFile.verticalScale = 1e6;
        EXPECT_THAT(errorOf([&] { load(GroundTiles::On); }), HasSubstr("within 10,000 km")) << time;
        mFile.verticalScale = 1;
    }
    EXPECT_TRUE(load(GroundTiles::On).tiled);
}

// A track is flown over the finest samples, not those that are in memory.
TEST_F(TiledScene, IsFollowedAboveItsFinestSamples) {
    const TerrainScene scene = load(GroundTiles::On);
    const GroundLevels& levels = *scene.tiled->levels;
    const RecordedPath path =
        followTrack(scene.ground, {{-4500, -3000}, {4700, 3300}}, 3, "track",
                    [&](const glm::dvec2& place) { return levels.errorBoundAt(scene.tiled->level, place); });
    double lowest = 1e9, under = 1e9;
    for (double t = 0; t <= path.duration(); t += 0.05) {
        const glm::dvec3 eye = path.at(t).position;
        lowest = std::min(lowest, eye.z - scene.heightAt(glm::dvec2(eye)));
        under = std::min(under, eye.z - levels.errorBoundAt(scene.tiled->level, glm::dvec2(eye)) -
                                    scene.heightAt(glm::dvec2(eye)));
    }
    EXPECT_GE(lowest, 3);
    EXPECT_LT(under, 3) << "that there are bounds matters";
}

// What is late is on its way: the picture is there at once, and in time as fine as one that waits.
TEST_F(TiledScene, ShowsWhatThereIsUntilTheRestHasCome) {
    const TerrainScene patient = load(GroundTiles::On);
    TerrainScene hasty = load(GroundTiles::On);
    hasty.ringsMayBeLate = true;
    const TerrainRenderer waits(patient), shows(hasty);
    pictureOf(shows, viewAt(hasty, {-4500, -3700}, 0, 40));  // the first waits
    const EyeView view = viewAt(hasty, {4500, 3500}, 3, 40);
    const EyeImage wanted = pictureOf(waits, view);
    EyeImage got = pictureOf(shows, view);
    EXPECT_TRUE(shows.ringDetail().late);
    EXPECT_TRUE(test::waitFor([&] {
        got = pictureOf(shows, view);
        return !shows.ringDetail().late && got.viewDepth.at(160, 150) == wanted.viewDepth.at(160, 150);
    }));
    EXPECT_GT(shows.arrivals(), 0u);
    for (int x = 0; x < got.width(); ++x)
        ASSERT_EQ(got.viewDepth.at(x, 199), wanted.viewDepth.at(x, 199)) << x;
}

// What had coarse rings waits again when it is to: the picture is that of one that always waited.
TEST_F(TiledScene, WaitsAgainWhenItIsTo) {
    const TerrainScene patient = load(GroundTiles::On);
    TerrainScene hasty = load(GroundTiles::On);
    hasty.ringsMayBeLate = true;
    const TerrainRenderer waits(patient);
    TerrainRenderer shows(hasty);
    pictureOf(shows, viewAt(hasty, {-4500, -3700}, 0, 40));
    const EyeView view = viewAt(hasty, {4500, 3500}, 3, 40);
    pictureOf(shows, view);
    ASSERT_TRUE(shows.ringDetail().late);
    shows.ringsMayBeLate(false);
    const EyeImage got = pictureOf(shows, view), wanted = pictureOf(waits, view);
    EXPECT_FALSE(shows.ringDetail().late);
    for (int y = 0; y < got.height(); ++y)
        for (int x = 0; x < got.width(); ++x)
            ASSERT_EQ(got.viewDepth.at(x, y), wanted.viewDepth.at(x, y)) << x << " " << y;
}

// Some more samples than what stands in for it has, with a hole.
RasterSpec largeGround() {
    RasterSpec spec;
    spec.width = 1300, spec.height = 950;
    spec.type = GDT_Float32;
    spec.transform = {400000, 10, 0, 5000000, 0, -10};
    spec.hasNodata = true, spec.nodata = -32768;
    spec.value = [](int c, int r, int) {
        return c > 500 && c < 600 && r > 350 && r < 400 ? -32768. : 800 + 0.5 * c - 0.25 * r;
    };
    return spec;
}

TEST_F(TiledScene, IsCoarseUntilTilesAreMade) {
    mFile.dem = writeRaster(mFolder / "large.tif", largeGround());
    mFile.tiles = GroundTiles::On;
    mFile.standInSide = 300;
    mFile.verticalScale = 2;
    Progress progress;
    const TerrainScene first = loadTerrain(mFile, progress);
    ASSERT_TRUE(first.standIn);
    EXPECT_FALSE(first.tiled);
    EXPECT_FALSE(fs::exists(mFolder / "cache" / "stereonav")) << "nothing is made before it is asked for";
    const Heightfield& ground = first.ground;
    EXPECT_LE(1.0 * ground.width() * ground.height(), 300. * 300);
    EXPECT_GT(1.0 * ground.width() * ground.height(), 290. * 290);
    EXPECT_EQ(first.standIn->spacing, glm::dvec2(10));
    // A sample stands for its surroundings: within half a step in x and y, of twice the slope.
    const double off = 2 * (0.5 + 0.25) * 0.5 * ground.spacing().x / 10 + 1e-3;
    for (double x = -6000; x <= 6000; x += 497)
        for (double y = -4500; y <= 4500; y += 513) {
            const double c = x / 10 + 649.5, r = 474.5 - y / 10;
            if (c > 490 && c < 610 && r > 340 && r < 410) continue;
            ASSERT_NEAR(first.heightAt({x, y}), 2 * (800 + 0.5 * c - 0.25 * r), off) << c << " " << r;
        }
    EXPECT_TRUE(std::isnan(first.heightAt({-995, 995})));
    EXPECT_NEAR(double(first.report.openSamples), 99. * 49 * 100 / (ground.spacing().x * ground.spacing().y),
                0.15 * 99 * 49);
    EXPECT_NE(first.report.tiles.find("not there yet"), std::string::npos);

    Progress ended;
    ended.cancel();
    EXPECT_THROW(first.standIn->makeTiles(ended), Cancelled);
    EXPECT_TRUE(tilesFile().empty());
    first.standIn->makeTiles(progress);
    ASSERT_EQ(tilesFile(), fs::path(first.standIn->tiles));
    const auto made = fileNumber(tilesFile());
    first.standIn->makeTiles(progress);
    EXPECT_EQ(fileNumber(tilesFile()), made) << "they were there";
    const TerrainScene then = loadTerrain(mFile, progress);
    EXPECT_FALSE(then.standIn);
    ASSERT_TRUE(then.tiled);
    EXPECT_EQ(then.report.tiles.find("made now"), std::string::npos);
    EXPECT_EQ(then.clearance, first.clearance);
    EXPECT_EQ(then.lens.nearDepth, first.lens.nearDepth);
    EXPECT_EQ(then.heightAt({-6000, 4500}), 2 * (800 + 0.5 * 49.5 - 0.25 * 24.5));
}

// In degrees too it lies where all of the samples lie, to half a step of its own.
TEST_F(TiledScene, StandsInWhereTheWholeLies) {
    RasterSpec spec = largeGround();
    spec.width = 700, spec.height = 500;
    spec.epsg = 4326;
    spec.transform = {10, 1e-3, 0, 46, 0, -1e-3};
    mFile.dem = writeRaster(mFolder / "degrees.tif", spec);
    const DemGrid whole = DemRows(mFile.dem).place();
    mFile.standInSide = 600;
    EXPECT_FALSE(standInGround(mFile, whole)) << "there are no more samples";
    mFile.standInSide = 200;
    const std::optional<Heightfield> coarse = standInGround(mFile, whole);
    ASSERT_TRUE(coarse);
    EXPECT_LE(coarse->width() * coarse->height(), 2 * 200 * 200);
    const TerrainScene tiled = load(GroundTiles::On);
    const double step = std::max(coarse->spacing().x, coarse->spacing().y);
    int compared = 0;
    for (double x = -25000; x <= 25000; x += 1700)
        for (double y = -25000; y <= 25000; y += 1300) {
            const double fine = tiled.heightAt({x, y}), few = coarse->heightAt({x, y});
            if (std::isnan(fine) || std::isnan(few)) continue;
            ++compared;
            // 0.5 m a sample of some 77 m, and 0.25 m in 111 m.
            ASSERT_NEAR(few, fine, (0.5 / 77 + 0.25 / 111) * 0.75 * step) << x << " " << y;
        }
    EXPECT_GT(compared, 800);
}

}  // namespace
}  // namespace stereonav::test
