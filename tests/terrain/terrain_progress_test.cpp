// Every function of ground that takes a Progress tells all of it.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "raster_files.h"
#include "terrain/built_in/built_in_color.h"
#include "terrain/built_in/built_in_relief.h"
#include "terrain/built_in/built_in_terrain.h"
#include "terrain/ground/membrane.h"
#include "terrain/ground/nodata.h"
#include "terrain/light/fine_bake.h"
#include "terrain/light/terrain_light.h"
#include "terrain/mesh/terrain_mesh.h"
#include "terrain/read/dem_reader.h"
#include "terrain/scene/ground_color.h"
#include "terrain/scene/ground_map.h"
#include "terrain/scene/ground_recolor.h"
#include "terrain/scene/slope_color.h"
#include "terrain/scene/terrain_loader.h"
#include "terrain/scene/tiled_ground.h"
#include "terrain/survey/sun_hours.h"
#include "terrain/survey/viewshed.h"
#include "terrain/tiles/tile_maker.h"
#include "tests/support/test_grounds.h"
#include "tests/support/thread_peers.h"
#include "tests/support/whole_progress.h"
#include "tiled_case.h"

namespace stereonav::test {
namespace {

namespace fs = std::filesystem;

class TerrainProgress : public TiledCase {
protected:
    fs::path ground(bool degrees, bool holed) const {
        RasterSpec spec;
        spec.width = 300, spec.height = 280;
        if (degrees) {
            spec.epsg = 4326;
            spec.transform = {11, 0.0003, 0, 47, 0, -0.0003};
        }
        spec.hasNodata = holed;
        spec.nodata = -5000;
        spec.value = [holed](int c, int r, int) {
            return holed && std::hypot(c - 100, r - 90) < 9 ? -5000 : 500 + 90 * std::sin(c / 17.0) + r;
        };
        return writeRaster(mFolder / fmt::format("ground{}{}.tif", degrees ? 1 : 0, holed ? 1 : 0), spec);
    }
    SceneFile sceneOf(const fs::path& dem, GroundTiles tiles = GroundTiles::Off) const {
        SceneFile file;
        file.dem = file.file = dem;
        file.tiles = tiles;
        return file;
    }
    // Empties the cache, so that all is made again.
    void dropCache() const {
        fs::remove_all(mFolder / "cache");
        fs::create_directories(mFolder / "cache");
    }
};

TEST_F(TerrainProgress, IsWholeOfElevationModelsAsTheyAreRead) {
    for (const bool degrees : {false, true}) {
        const fs::path file = ground(degrees, true);
        expectWholeProgress(
            "reading", 2, [&](Progress& progress) { readDem(file, 1, progress); },
            degrees ? std::vector{0.5} : std::vector<double>());
    }
}

TEST_F(TerrainProgress, IsWholeOfFilledHoles) {
    for (const char* const kind : {"smooth", "holed"}) {
        const Heightfield ground = makeGround(kind, 90, 80, 1);
        const std::vector<float> heights(ground.data(), ground.data() + 90 * 80);
        expectWholeProgress(kind, ground.hasHoles() ? 1 : 0, [&](Progress& progress) {
            std::vector<float> filled = heights;
            fillMissing(filled, 90, 80, {1, 1}, progress);
        });
    }
    expectWholeProgress("one sample", 0, [](Progress& progress) {
        std::vector<float> heights(9, 1.0f);
        solveMembrane({4}, heights, 3, 3, {1, 1}, progress);
    });
}

TEST_F(TerrainProgress, IsWholeOfAMesh) {
    for (const char* const kind : {"flat", "rough", "holed", "spiked"})
        for (const double error : {0.0, 0.5})
            expectWholeProgress(kind, 0, [&](Progress& progress) {
                simplifyTerrain(makeGround(kind, 120, 110, 2), error, progress);
            });
}

TEST_F(TerrainProgress, IsWholeOfAMapOfTheGround) {
    for (const char* const kind : {"rough", "holed"}) {
        const TerrainScene scene = makeScene(makeGround(kind, 60, 50, 2));
        for (const int most : {1, 40})
            expectWholeProgress(kind, most > 1 ? 20 : 1,
                                [&](Progress& progress) { mapOfGround(scene, most, progress); }, {0.7});
    }
}

TEST_F(TerrainProgress, IsWholeOfColours) {
    const Heightfield ground = makeGround("rough", 70, 150, 2);
    const TerrainLook look;
    const TintPlace place;
    expectWholeProgress("tints", 2, [&](Progress& progress) { tintedGround(ground, look, place, progress); });
    expectWholeProgress("tints of a part", 2,
                        [&](Progress& progress) { tintedPart(ground, ground, look, place, 1, progress); });
    GroundColorSource source{look, false, 1, GroundPaint::None, std::nullopt, {}};
    for (const GroundPaint paint : {GroundPaint::Slope, GroundPaint::Aspect, GroundPaint::Hillshade}) {
        expectWholeProgress("paint", 2,
                            [&](Progress& progress) { paintedGround(ground, 1, paint, look, progress); });
        expectWholeProgress("paint of a source", 2, [&](Progress& progress) {
            groundColorsAs(paint, ground, source, {1, 0.5}, progress);
        });
    }
    expectWholeProgress("tints of a source", 2, [&](Progress& progress) {
        groundColorsAs(GroundPaint::None, ground, source, {1, 0.5}, progress);
    });
    source.builtIn = BuiltInOrigin{1, 33};
    expectWholeProgress("built-in colours", 2, [&](Progress& progress) {
        groundColorsAs(GroundPaint::None, makeGround("rough", 33, 33, 2), source, {1, 0.5}, progress);
    });
}

TEST_F(TerrainProgress, IsWholeOfAPicturedGround) {
    RasterSpec spec;
    spec.type = GDT_Byte;
    spec.bands = 3;
    spec.width = spec.height = 60;
    spec.value = [](int c, int r, int b) { return (c + 2 * r + 50 * b) % 256; };
    const fs::path picture = writeRaster(mFolder / "picture.tif", spec);
    SceneFile file = sceneOf(ground(false, false));
    file.image = picture;
    for (const bool shaded : {false, true}) {
        file.look.shadeImage = shaded;
        expectWholeProgress("a scene with a picture", 5,
                            [&](Progress& progress) { loadTerrain(file, progress); });
    }
    Progress quiet;
    const DemGrid dem = readDem(file.dem, 1, quiet);
    const Heightfield heights(dem.width, dem.height, dem.spacing, dem.heights, "ground");
    const PicturedGround pictured{std::make_shared<const LaidPicture>(picture, dem), file.look, {}, true};
    expectWholeProgress("a picture", 1,
                        [&](Progress& progress) { picturedGround(heights, pictured, 4, progress); });
}

TEST_F(TerrainProgress, IsWholeOfTheBuiltInTerrain) {
    expectWholeProgress("relief", 5, [](Progress& progress) { makeRelief(1, 33, progress); });
    Progress quiet;
    const Relief relief = makeRelief(1, 33, quiet);
    expectWholeProgress("colours", 1,
                        [&](Progress& progress) { makeBuiltInColor(relief, 1, nullptr, progress); });
    expectWholeProgress("both", 5, [](Progress& progress) { generateBuiltInTerrain(1, 33, progress); },
                        {0.6});
    expectWholeProgress("made and then kept", 5, [](Progress& progress) { builtInTerrain(1, 33, progress); });
    expectWholeProgress("read back", 0, [](Progress& progress) { builtInTerrain(1, 33, progress); });
}

TEST_F(TerrainProgress, IsWholeOfSurveys) {
    const Heightfield ground = makeGround("rough", 300, 290, 2);
    ViewshedSetting setting;
    setting.eye = {100, 120};
    setting.eyeHeight = 2;
    expectWholeProgress("a viewshed", 7, [&](Progress& progress) { viewshedOf(ground, setting, progress); });
    const HeightPyramid maxima(ground);
    const SightLines lines(ground, maxima, 0);
    expectWholeProgress("hours of sun", 200, [&](Progress& progress) {
        hoursOfSun(lines, {{1, 0.5}, {2, 0.7}}, 24, progress);
    });
}

TEST_F(TerrainProgress, IsWholeOfScenes) {
    for (const bool degrees : {false, true})
        for (const bool open : {false, true}) {
            SceneFile file = sceneOf(ground(degrees, true));
            file.openHoles = open;
            expectWholeProgress(
                "a scene", 5, [&](Progress& progress) { loadTerrain(file, progress); },
                open ? std::vector{0.6} : std::vector{0.6 * 0.7, 0.6});
        }
    SceneFile builtIn;
    builtIn.builtIn = true;
    builtIn.builtInSize = 33;
    expectWholeProgress("the built-in one", 5, [&](Progress& progress) {
        dropCache();
        loadTerrain(builtIn, progress);
    });
}

// Each stage begins where the one before it has ended.
TEST_F(TerrainProgress, IsWholeOfScenesWithBakedLight) {
    SceneFile file = sceneOf(ground(false, false));
    Progress quiet;
    TerrainLightSettings settings;
    settings.azimuths = 8;
    settings.rays = 16;
    settings.bounces = 0;
    settings.kind = TerrainLightKind::Openness;
    saveTerrainLight(mFolder / "a.light", bakeTerrainLight(loadTerrain(file, quiet).ground, settings, quiet));
    file.light = (mFolder / "a.light").string();
    expectWholeProgress("a lit scene", 5, [&](Progress& progress) { loadTerrain(file, progress); },
                        {0.6 * 0.7, 0.6, 0.9});
}

// Made, read back, and shown coarsely until they are made.
TEST_F(TerrainProgress, IsWholeOfGroundInTiles) {
    SceneFile file = sceneOf(ground(false, true), GroundTiles::On);
    for (const bool made : {false, true})
        expectWholeProgress(made ? "made" : "read back", made ? 0 : 1, [&](Progress& progress) {
            if (!made) dropCache();
            loadTerrain(file, progress);
        });
    expectWholeProgress("for a survey, made", 1, [&](Progress& progress) {
        dropCache();
        readGroundInTiles(file, progress);
    });
    Progress quiet;
    readGroundInTiles(file, quiet);
    expectWholeProgress("for a survey, read back", 0,
                        [&](Progress& progress) { readGroundInTiles(file, progress); });
    dropCache();
    file.standInSide = 64;
    const TerrainScene scene = loadTerrain(file, quiet);
    ASSERT_TRUE(scene.standIn);
    expectWholeProgress("one that stands in", 1, [&](Progress& progress) { loadTerrain(file, progress); });
    expectWholeProgress("tiles in its place", 1, [&](Progress& progress) {
        dropCache();
        scene.standIn->makeTiles(progress);
    });
    expectWholeProgress("tiles", 3, [&](Progress& progress) {
        makeTiles({{600, 500},
                   1,
                   64,
                   0,
                   [](int first, int count, float* to) {
                       for (int n = 0; n < 600 * count; ++n) to[n] = static_cast<float>(first + n % 17);
                   }},
                  mFolder / "made.tiles", progress);
    });
}

TEST_F(TerrainProgress, IsWholeOfBakedLight) {
    const Heightfield ground = makeGround("rough", 65, 90, 2);
    for (const bool transfer : {false, true})
        for (const int bounces : {0, 1, 2}) {
            TerrainLightSettings settings;
            settings.order = 2;
            settings.azimuths = 8;
            settings.rays = 16;
            settings.bounces = transfer ? bounces : 0;
            settings.kind = transfer ? TerrainLightKind::Transfer : TerrainLightKind::Openness;
            expectWholeProgress("a bake", 1,
                                [&](Progress& progress) { bakeTerrainLight(ground, settings, progress); });
            runAsPeers(3, [&](Peers& peers) {
                WrittenProgress written;
                bakeTerrainLight(ground, settings, written.progress(), false, &peers);
                if (peers.first()) written.expectWhole("one of several processes", 1);
            });
        }
}

// One that was stopped goes on from where it was.
TEST_F(TerrainProgress, IsWholeOfABakeThatGoesOn) {
    const Heightfield ground = makeGround("rough", 65, 90, 2);
    TerrainLightSettings settings;
    settings.order = 2;
    settings.azimuths = 8;
    settings.rays = 16;
    settings.bounces = 1;
    for (const double end : {0.1, 0.3, 0.9}) {
        Progress* itself = nullptr;
        Progress stopping([&](double fraction, const std::string&) {
            if (fraction >= end) itself->cancel();
        });
        itself = &stopping;
        EXPECT_THROW(bakeTerrainLight(ground, settings, stopping, true), Cancelled);
        WrittenProgress written;
        bakeTerrainLight(ground, settings, written.progress(), true);
        written.expectWhole("one that goes on");
    }
}

TEST_F(TerrainProgress, IsWholeOfFinerLight) {
    const Heightfield fine = makeGround("rough", 301, 131, 2);
    const GroundLevels levels(fine);
    const Heightfield coarse = *levels.part(1, glm::ivec2(0), levels.size(1));
    TerrainLightSettings settings;
    settings.order = 2;
    settings.azimuths = 8;
    settings.rays = 16;
    settings.bounces = 0;
    Progress quiet;
    const TerrainLight light = bakeTerrainLight(coarse, settings, quiet);
    const FineBake bake(levels, coarse, light);
    const FineLightShape shape = fineLightShape(levels, 1, light, 3);
    for (const int processes : {1, 2}) {
        runAsPeers(processes, [&](Peers& peers) {
            WrittenProgress written;
            bakeFineLight(bake, mFolder / "a.finer", mFolder / "a.finer.part", shape, written.progress(),
                          peers);
            if (peers.first()) written.expectWhole("finer light", 0);
        });
        fs::remove(mFolder / "a.finer");
    }
}

}  // namespace
}  // namespace stereonav::test
