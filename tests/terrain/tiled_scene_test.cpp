// A ground in tiles against the same ground in memory: heights, depths, colours, and what becomes of damage.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <glm/geometric.hpp>
#include <thread>

#include "engine/base/memory.h"
#include "engine/camera/stereo_rig.h"
#include "raster_files.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/scene/followed_track.h"
#include "terrain/scene/ground_place.h"
#include "terrain/scene/terrain_loader.h"
#include "tests/support/own_cache.h"

namespace stereonav::test {
namespace {

namespace fs = std::filesystem;

double bytesTaken() {
    std::ifstream status("/proc/self/status");
    double kilobytes = 0;
    for (std::string word; status >> word;)
        if (word == "RssAnon:") status >> kilobytes;
    return 1024 * kilobytes;
}

// The whole ground would take 63 MB: a quarter of what is allowed holds its next level.
class TiledScene : public testing::Test {
protected:
    TiledScene() {
        const char* const before = std::getenv("XDG_CACHE_HOME");
        mCacheBefore = before ? before : "";
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
        RasterSpec spec;
        spec.width = 1100, spec.height = 900;
        spec.transform = {400000, 10, 0, 5000000, 0, -10};
        spec.value = [](int c, int r, int) {
            return 800 + 250 * std::sin(c / 97.) * std::cos(r / 83.) +
                   30 * std::sin(c / 7.) * std::sin(r / 9.) + 4 * std::sin(c * 1.7 + r);
        };
        mFile.dem = mFile.file = writeRaster(mFolder / "ground.tif", spec);
        fs::create_directories(mFolder / "cache");
    }
    ~TiledScene() override {
        limitMemory(0);
        setenv("XDG_CACHE_HOME", mCacheBefore.c_str(), 1);
    }

    TerrainScene load(GroundTiles tiles, double allowed = 180e6) {
        limitMemory(tiles == GroundTiles::Off ? 0 : bytesTaken() + allowed);
        SceneFile file = mFile;
        file.tiles = tiles;
        Progress progress;
        TerrainScene scene = loadTerrain(file, progress);
        scene.levelOfDetail = 0.5;
        return scene;
    }
    fs::path tilesFile() const {
        for (const auto& entry : fs::directory_iterator(mFolder / "cache" / "stereonav"))
            if (entry.path().extension() == ".tiles") return entry.path();
        return {};
    }

    TempFolder mFolder;
    SceneFile mFile;
    std::string mCacheBefore;
};

EyeView viewAt(const TerrainScene& scene, const glm::dvec2& place, double heading, double over) {
    const Lens lens{320, 200, 1.0, 0.5, 0.5};
    return makeEyeView(poseFromAngles(glm::dvec3(place, scene.heightAt(place) + over), heading, -0.15, 0),
                       lens);
}

EyeImage pictureOf(const TerrainRenderer& renderer, const EyeView& view) {
    EyeImage image;
    image.resize(view.width, view.height);
    renderer.lookFrom(view);
    renderEye(renderer, view, image);
    return image;
}

double rootMeanSquare(const EyeImage& a, const EyeImage& b) {
    double sum = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            const glm::dvec3 off(glm::sqrt(unpackColor(a.color.at(x, y))) -
                                 glm::sqrt(unpackColor(b.color.at(x, y))));
            sum += glm::dot(off, off) / 3;
        }
    return std::sqrt(sum / (double(a.width()) * a.height()));
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
    bool same = false;
    for (int k = 0; k < 400 && !same; ++k) {
        std::this_thread::sleep_for(std::chrono::milliseconds(25));
        got = pictureOf(shows, view);
        same = !shows.ringDetail().late && got.viewDepth.at(160, 150) == wanted.viewDepth.at(160, 150);
    }
    EXPECT_TRUE(same);
    EXPECT_GT(shows.arrivals(), 0u);
    for (int x = 0; x < got.width(); ++x)
        ASSERT_EQ(got.viewDepth.at(x, 199), wanted.viewDepth.at(x, 199)) << x;
}

}  // namespace
}  // namespace stereonav::test
