// What is painted on a shown terrain, exchanged between frames: each exchanged paint is what the scene shows
// that was loaded with it.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <optional>

#include "app/scene/terrain/terrain_loading.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/camera/stereo_rig.h"
#include "engine/image/image_file.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/line_measurer.h"
#include "engine/scene/live_paint.h"
#include "engine/scene/surface_paint.h"
#include "terrain/light/terrain_light.h"
#include "terrain/scene/terrain_scene.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/wait_for.h"

namespace stereonav {
namespace {

class GroundPaintingTest : public testing::Test {
protected:
    GroundPaintingTest() {
        std::string text = "ncols 60\nnrows 50\nxllcorner 0\nyllcorner 0\ncellsize 10\n";
        for (int j = 0; j < 50; ++j)
            for (int i = 0; i < 60; ++i)
                text += std::to_string(std::max(0, 120 - ((i - 30) * (i - 30) + (j - 25) * (j - 25)) / 4)) +
                        (i == 59 ? "\n" : " ");
        writeTextFile(mFolder / "hill.asc", text);
        writeTextFile(mFolder / "walk.geojson",
                      R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"name":"walk"},"geometry":{"type":"LineString","coordinates":
[[-250,-200],[0,0],[250,200],[900,0]]}},
{"type":"Feature","properties":{"name":"hut"},"geometry":{"type":"Point","coordinates":[20,40]}}]})");
    }
    std::string walk() const { return (mFolder / "walk.geojson").string(); }
    std::unique_ptr<Scene> loaded(const std::function<void(SceneOptions&)>& set = nullptr) {
        SceneOptions options;
        options.scene = (mFolder / "hill.asc").string();
        if (set) set(options);
        Progress progress;
        return loadTerrainScene(options, SimdTarget::Auto, progress);
    }
    // Returns the picture that the window makes.
    static Plane<PackedColor> pictureOf(const Scene& scene) {
        if (auto* const paint = scene.offered<LivePaint>()) paint->takeUp();
        Lens lens = scene.lens;
        lens.width = 120;
        lens.height = 80;
        const EyeView view = makeEyeView(poseFromAngles({0, -420, 300}, 0, -0.5, 0), lens);
        EyePair frame;
        scene.frames().makeOne(view, 0, frame);
        paintEye(scene, view, frame.left);
        return frame.left.color;
    }
    static bool same(const Plane<PackedColor>& a, const Plane<PackedColor>& b) {
        for (int y = 0; y < a.height(); ++y)
            for (int x = 0; x < a.width(); ++x)
                if (a.at(x, y) != b.at(x, y)) return false;
        return true;
    }
    static void settle(const LivePaint& paint) {
        EXPECT_TRUE(test::waitFor([&] { return !paint.work(); }));
    }

    TemporaryFolder mFolder;
};

TEST_F(GroundPaintingTest, ExchangedPaintIsThatOfASceneLoadedWithIt) {
    const auto scene = loaded();
    LivePaint& paint = *scene->offered<LivePaint>();
    const auto plain = pictureOf(*scene);
    const auto shows = [&](const char* key, const std::string& text,
                           const std::function<void(SceneOptions&)>& set) {
        const long long before = paint.version();
        ASSERT_TRUE(paint.takes(key, text));
        paint.ask(key, text);
        EXPECT_EQ(paint.now(key), text);
        settle(paint);
        EXPECT_EQ(paint.takeProblem(), "");
        EXPECT_GT(paint.version(), before) << key;
        const auto picture = pictureOf(*scene);
        EXPECT_FALSE(same(picture, plain)) << key;
        EXPECT_TRUE(same(picture, pictureOf(*loaded(set)))) << key;
        EXPECT_FALSE(paint.legend()->legends.empty()) << key;
        paint.ask(key, "");
        EXPECT_EQ(paint.now(key), "");
        EXPECT_TRUE(same(pictureOf(*scene), plain)) << key;
        EXPECT_TRUE(paint.legend()->legends.empty()) << key;
    };
    shows("contours", "7", [](SceneOptions& options) { options.ground.contours_m = 7; });
    shows("contours", "auto", [](SceneOptions& options) { options.ground.contoursAuto = true; });
    shows("paint", "viewshed:50,50,2", [](SceneOptions& options) { options.paint = "viewshed:50,50,2"; });
    shows("tracks", walk(), [&](SceneOptions& options) { options.ground.tracks = walk(); });
}

TEST_F(GroundPaintingTest, WhatCanNotBeHadIsToldAndThePictureStays) {
    const auto scene = loaded([](SceneOptions& options) { options.ground.contours_m = 9; });
    LivePaint& paint = *scene->offered<LivePaint>();
    paint.ask("paint", "viewshed:50,50,2");
    settle(paint);
    const auto before = pictureOf(*scene);
    const std::pair<const char*, std::string> wrong[] = {
        {"paint", "viewshed:99999,0"}, {"paint", "hours:2026-06-21"}, {"tracks", "none.gpx"}};
    for (const auto& [key, text] : wrong) {
        paint.ask(key, text);
        settle(paint);
        const std::string problem = paint.takeProblem();
        EXPECT_NE(problem, "") << text;
        EXPECT_EQ(problem.find('\n'), std::string::npos) << problem;
        EXPECT_EQ(paint.takeProblem(), "") << "told once";
        EXPECT_TRUE(same(pictureOf(*scene), before)) << text;
    }
    EXPECT_EQ(paint.now("paint"), "viewshed:50,50,2");
    EXPECT_EQ(paint.now("tracks"), "");
    EXPECT_EQ(paint.now("contours"), "9");
    EXPECT_THROW(paint.ask("contours", "many"), Error);
}

TEST_F(GroundPaintingTest, TheNewestWishCountsAndACancelKeepsWhatIsShown) {
    const auto scene = loaded();
    LivePaint& paint = *scene->offered<LivePaint>();
    for (int n = 0; n < 20; ++n) paint.ask("paint", "viewshed:" + std::to_string(50 + n) + ",100,2");
    settle(paint);
    EXPECT_EQ(paint.now("paint"), "viewshed:69,100,2");
    EXPECT_EQ(paint.takeProblem(), "");
    paint.ask("paint", "viewshed:5,5,2");
    paint.cancel();
    EXPECT_FALSE(paint.work());
    const std::string now = paint.now("paint");  // it may have been done before
    EXPECT_TRUE(now == "viewshed:69,100,2" || now == "viewshed:5,5,2") << now;
    paint.ask("paint", "viewshed:6,6,2");  // and the scene goes while that is worked out
}

TEST_F(GroundPaintingTest, WhatIsSeenFromAPlaceIsSaidInTheFilesCoordinates) {
    const auto scene = loaded();
    LivePaint& paint = *scene->offered<LivePaint>();
    paint.askSeenFrom({12.5, -40}, 3);
    settle(paint);
    EXPECT_EQ(paint.now("paint"), "viewshed:312.5,210,3");
    paint.askSeenFrom({1e6, 0}, 3);
    settle(paint);
    EXPECT_NE(paint.takeProblem().find("expected a place on the ground"), std::string::npos);
    EXPECT_EQ(paint.now("paint"), "viewshed:312.5,210,3");
}

TEST_F(GroundPaintingTest, ColoursOfTheGroundAreThoseOfASceneLoadedWithThem) {
    const char* const all[] = {"", "slope", "swiss", "hillshade", "natural"};
    const auto loadedAs = [&](const std::string& word) {
        return loaded([&](SceneOptions& options) { options.paint = word; });
    };
    std::vector<Plane<PackedColor>> wanted;
    std::vector<Facts> facts;
    for (const char* const word : all) {
        const auto scene = loadedAs(word);
        wanted.push_back(pictureOf(*scene));
        facts.push_back(scene->describe());
    }
    for (const char* const from : all) {
        const auto scene = loadedAs(from);
        LivePaint& paint = *scene->offered<LivePaint>();
        for (const int to : {1, 0, 2, 3, 0, 4, 3, 1}) {
            ASSERT_TRUE(paint.takes("paint", all[to]));
            paint.ask("paint", all[to]);
            settle(paint);
            EXPECT_EQ(paint.takeProblem(), "");
            EXPECT_TRUE(same(pictureOf(*scene), wanted[to])) << from << " to " << all[to];
            EXPECT_EQ(linesOf(scene->describe()), linesOf(facts[to])) << from << " to " << all[to];
        }
    }
    for (std::size_t k = 1; k < wanted.size(); ++k) EXPECT_FALSE(same(wanted[k - 1], wanted[k])) << all[k];
    EXPECT_FALSE(same(wanted[0], wanted[4]));
}

TEST_F(GroundPaintingTest, BothEyesHaveTheNewColours) {
    const auto eyesOf = [](const Scene& scene) {
        if (auto* const paint = scene.offered<LivePaint>()) paint->takeUp();
        Lens lens = scene.lens;
        lens.width = 120;
        lens.height = 80;
        const StereoViews views =
            makeStereoViews(poseFromAngles({0, -420, 300}, 0, -0.5, 0), lens, StereoSetting{12, 500});
        EyePair frame;
        scene.frames().make(views, 0, FrameWay{}, frame);
        return std::pair(std::move(frame.left.color), std::move(frame.right.color));
    };
    const auto scene = loaded();
    LivePaint& paint = *scene->offered<LivePaint>();
    const auto before = eyesOf(*scene);
    paint.ask("paint", "aspect");
    settle(paint);
    const auto now = eyesOf(*scene);
    const auto wanted = eyesOf(*loaded([](SceneOptions& options) { options.paint = "aspect"; }));
    EXPECT_TRUE(same(now.first, wanted.first) && same(now.second, wanted.second));
    EXPECT_FALSE(same(now.second, before.second));
}

TEST_F(GroundPaintingTest, ColoursFollowASunThatTurns) {
    for (const char* const word : {"slope", "hillshade"}) {
        const auto scene = loaded();
        LivePaint& paint = *scene->offered<LivePaint>();
        paint.ask("paint", word);
        settle(paint);
        pictureOf(*scene);
        TurningLight& sun = *scene->offered<TurningLight>();
        const SunPlace evening{4.5, 0.3};
        sun.turnTo(evening);
        pictureOf(*scene);  // asks for them
        settle(paint);
        const auto shown = pictureOf(*scene);
        EXPECT_TRUE(same(shown, pictureOf(*loaded([&](SceneOptions& options) {
                             options.paint = word;
                             options.sun = LightPlace{evening.azimuth, evening.elevation};
                         }))))
            << word;
        paint.ask("paint", "");
        EXPECT_TRUE(same(pictureOf(*scene), pictureOf(*loaded()))) << "until light is worked out";
    }
}

// There and back, waited for or not: the colours are those of the sun that stands there now.
TEST_F(GroundPaintingTest, ASunThatTurnedBackLeavesTheColoursOfBefore) {
    for (const char* const word : {"slope", "hillshade"})
        for (const bool waits : {true, false}) {
            SCOPED_TRACE(std::string(word) + (waits ? ", waited for" : ""));
            const auto scene = loaded();
            LivePaint& paint = *scene->offered<LivePaint>();
            TurningLight& sun = *scene->offered<TurningLight>();
            paint.ask("paint", word);
            settle(paint);
            const auto before = pictureOf(*scene);
            const SunPlace noon = sun.place();
            sun.turnTo({4.5, 0.3});
            pictureOf(*scene);  // asks for them
            if (waits) {
                settle(paint);
                EXPECT_FALSE(same(pictureOf(*scene), before));
            }
            sun.turnTo(noon);
            for (int turns = 0; turns < 3; ++turns) {  // what comes late asks again
                pictureOf(*scene);
                settle(paint);
            }
            EXPECT_TRUE(same(pictureOf(*scene), before));
            EXPECT_EQ(paint.now("paint"), word);
        }
}

// Wishes one after the other, each at once: the last one is shown, and each layer has its own.
TEST_F(GroundPaintingTest, ThereAndBackShowsTheLastWishOfEachLayer) {
    const auto scene = loaded();
    LivePaint& paint = *scene->offered<LivePaint>();
    const auto plain = pictureOf(*scene);
    const auto shown = [&] {
        settle(paint);
        EXPECT_EQ(paint.takeProblem(), "");
        return pictureOf(*scene);
    };
    const auto slope = pictureOf(*loaded([](SceneOptions& options) { options.paint = "slope"; }));
    const auto tracks = pictureOf(*loaded([&](SceneOptions& options) { options.ground.tracks = walk(); }));
    for (const char* const last : {"", "slope"})
        for (int n = 0; n < 10; ++n) {
            for (const char* const word : {"viewshed:50,50,2", "aspect", "", "slope", last}) {
                paint.ask("paint", word);
                EXPECT_EQ(paint.now("paint"), word);
            }
            // Read after what is at work: then that has come, or was dropped.
            paint.ask("tracks", walk());
            paint.ask("contours", "7"), paint.ask("contours", "");
            settle(paint);
            paint.ask("tracks", "");
            EXPECT_TRUE(same(shown(), *last ? slope : plain)) << last << n;
        }
    paint.ask("paint", "");
    paint.ask("tracks", "none.gpx"), paint.ask("tracks", walk());
    settle(paint);
    paint.takeProblem();  // where that was read before the next wish came
    EXPECT_TRUE(same(shown(), tracks));
}

TEST_F(GroundPaintingTest, UnderWorkedOutLightTheOwnColoursComeBackLit) {
    for (const char* const first : {"", "slope"}) {
        const auto scene = loaded([&](SceneOptions& options) { options.paint = first; });
        LivePaint& paint = *scene->offered<LivePaint>();
        auto* const seen = scene->offered<SeenLight>();
        ASSERT_NE(seen, nullptr);
        const SunPlace sun = scene->offered<TurningLight>()->place();
        const auto look = [&] {
            scene->offered<TurningLight>()->turnTo(sun);
            const auto picture = pictureOf(*scene);
            seen->seen({}, {});
            return picture;
        };
        const auto asked = [&](const char* word) {
            paint.ask("paint", word);
            settle(paint);
            return look();
        };
        const auto slope = asked("slope");
        if (*first) {
            EXPECT_EQ(seen->changes(), 0u) << "nothing is worked out for what is not shown";
        }
        const auto plain = asked("");
        ASSERT_TRUE(test::waitFor([&] { return seen->changes() > 0; }));
        const auto lit = look();
        EXPECT_FALSE(same(lit, plain));
        EXPECT_TRUE(same(asked("slope"), slope));
        EXPECT_TRUE(same(asked(""), lit));
    }
}

TEST_F(GroundPaintingTest, OverABakedLightColoursAreLitByIt) {
    Progress progress;
    const auto ground = loaded();
    const TerrainScene& terrain = *ground->offered<const TerrainScene>();
    TerrainLightSettings settings;
    settings.order = 3;
    settings.rays = 16;
    const std::string file = (mFolder / "hill.light").string();
    saveTerrainLight(file, bakeTerrainLight(terrain.ground, settings, progress));
    const auto loadedAs = [&](const std::string& word, const std::optional<LightPlace>& sun) {
        return loaded([&](SceneOptions& options) {
            options.paint = word;
            options.sun = sun;
            options.light = LightChoice{LightChoice::Kind::File, file};
        });
    };
    const auto scene = loadedAs("", {});
    LivePaint& paint = *scene->offered<LivePaint>();
    const SunPlace evening{4.5, 0.3};
    for (const char* const word : {"slope", "hillshade", ""}) {
        paint.ask("paint", word);
        settle(paint);
        EXPECT_TRUE(same(pictureOf(*scene), pictureOf(*loadedAs(word, {})))) << word;
        const SunPlace noon = scene->offered<TurningLight>()->place();
        scene->offered<TurningLight>()->turnTo(evening);
        pictureOf(*scene);
        settle(paint);
        const LightPlace angle{evening.azimuth, evening.elevation};
        EXPECT_TRUE(same(pictureOf(*scene), pictureOf(*loadedAs(word, angle)))) << word;
        scene->offered<TurningLight>()->turnTo(noon);
        pictureOf(*scene);
        settle(paint);
    }
}

TEST_F(GroundPaintingTest, APictureOfTheGroundIsNotPaintedOver) {
    writeColorImage(mFolder / "photo.png", Plane<PackedColor>(8, 8));
    const auto scene =
        loaded([&](SceneOptions& options) { options.image = (mFolder / "photo.png").string(); });
    const LivePaint& paint = *scene->offered<LivePaint>();
    EXPECT_FALSE(paint.takes("paint", "slope"));
    EXPECT_TRUE(paint.takes("paint", "viewshed:50,50,2"));
    EXPECT_TRUE(paint.takes("paint", ""));
}

TEST_F(GroundPaintingTest, NamesAndLinesOfTracksAreTold) {
    const auto scene = loaded([&](SceneOptions& options) { options.ground.tracks = walk(); });
    const auto legend = scene->offered<LivePaint>()->legend();
    ASSERT_EQ(legend->places.size(), 1u);
    EXPECT_EQ(legend->places[0].name, "hut");
    EXPECT_NEAR(legend->places[0].world.x, 20, 1e-9);
    EXPECT_GT(legend->places[0].world.z, 50) << "on the hill";
    ASSERT_EQ(legend->lines.size(), 1u);
    EXPECT_EQ(legend->lines[0].name, "walk");
    EXPECT_EQ(legend->lines[0].world.size(), 4u);
    ASSERT_EQ(legend->notes.size(), 1u) << "one place lies outside";
}

TEST_F(GroundPaintingTest, LinesOfSightGoOverTheHillOrNot) {
    for (const double scale : {1.0, 3.0}) {
        const auto scene = loaded([&](SceneOptions& options) { options.verticalScale = scale; });
        const auto* const measurer = scene->offered<LineMeasurer>();
        const auto sees = [&](const glm::dvec3& from, const glm::dvec3& to, double height) {
            const Facts facts = measurer->sight(from, to, height);
            EXPECT_EQ(facts.size(), 1u);
            return std::get<bool>(facts.at(0).value);
        };
        const glm::dvec3 west(-280, 0, 0), east(280, 0, 0), south(-280, -220, 0);
        EXPECT_FALSE(sees(west, east, 2)) << "the hill is between";
        EXPECT_TRUE(sees(west, east, 125)) << "it is 120 m high in the file, however it is shown";
        EXPECT_FALSE(sees(west, east, 110));
        EXPECT_TRUE(sees(west, south, 2)) << "beside it";
        EXPECT_THROW(measurer->sight(west, {1e6, 0, 0}, 2), Error);
    }
}

}  // namespace
}  // namespace stereonav
