// Scene files: every key arrives in its units, and everything wrong is one clear line with its place.
#include "terrain/read/scene_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/image/packed_color.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;
using std::numbers::pi;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class SceneFileTest : public testing::Test {
protected:
    void SetUp() override {
        mFolder = fs::temp_directory_path() / ("stereonav_scene_test_" + std::to_string(getpid()));
        fs::create_directories(mFolder);
    }
    void TearDown() override { fs::remove_all(mFolder); }

    fs::path written(const std::string& content) const {
        const fs::path file = mFolder / "scene.toml";
        std::ofstream(file, std::ios::binary) << content;
        return file;
    }
    SceneFile read(const std::string& content) const { return readSceneFile(written(content)); }

    // The message without the folder, or "" when there was none.
    std::string errorOf(const std::string& content) const {
        try {
            read(content);
        } catch (const Error& error) {
            std::string text = error.what();
            EXPECT_EQ(text.find('\n'), std::string::npos) << text;
            EXPECT_THAT(text, StartsWith(mFolder.string()));
            return text.substr(mFolder.string().size() + 1);
        }
        return "";
    }
    // Returns the error of `content` after a good terrain, so that its line 1 is line 3 of the file.
    std::string errorAfterTerrain(const std::string& content) const {
        return errorOf("[terrain]\nbuiltin = true\n" + content);
    }
    fs::path mFolder;
};

TEST_F(SceneFileTest, TheShortestSceneHasTheDefaults) {
    const SceneFile scene = read("[terrain]\ndem = \"a.tif\"\n");
    EXPECT_EQ(scene.file, mFolder / "scene.toml");
    EXPECT_EQ(scene.dem, mFolder / "a.tif");
    EXPECT_FALSE(scene.builtIn);
    EXPECT_EQ(scene.verticalScale, 1.0);
    EXPECT_FALSE(scene.openHoles);
    EXPECT_TRUE(scene.image.empty() && scene.sky.empty() && scene.path.empty() && scene.landmarks.empty());
    EXPECT_FALSE(scene.startPosition || scene.separation || scene.zeroParallax);
    EXPECT_EQ(scene.verticalFov, SceneFile().verticalFov);
    EXPECT_EQ(scene.look.sunAzimuth, TerrainLook().sunAzimuth);
    EXPECT_EQ(scene.look.fogColor, TerrainLook().fogColor);
    EXPECT_EQ(scene.clearance, 0.0);
}

TEST_F(SceneFileTest, TheSampleWithEveryKeyArrivesInMetresAndRadians) {
    const fs::path folder = fs::path(STEREONAV_SOURCE_DIR) / "data" / "scenes";
    const SceneFile scene = readSceneFile(folder / "every_key.toml");
    EXPECT_EQ(scene.dem, folder / "mountains.tif");
    EXPECT_EQ(scene.image, folder / "mountains.jpg");
    EXPECT_EQ(scene.sky, folder / "clouds.hdr");
    EXPECT_EQ(scene.path, folder / "flight.glb");
    EXPECT_NEAR(scene.look.sunAzimuth, 315 * pi / 180, 1e-12);
    EXPECT_NEAR(scene.look.sunElevation, pi / 4, 1e-12);
    EXPECT_NEAR(scene.look.fogColor.x, linearFromSrgb(0.81f), 1e-6);
    EXPECT_NEAR(scene.look.fogColor.z, linearFromSrgb(0.88f), 1e-6);
    ASSERT_EQ(scene.landmarks.size(), 1u);
    EXPECT_EQ(scene.landmarks[0].mesh, folder / "tower.glb");
    EXPECT_EQ(scene.landmarks[0].positionWorld, glm::dvec2(100, -250));
    EXPECT_EQ(scene.landmarks[0].z, 1200.0);
    EXPECT_NEAR(scene.landmarks[0].heading, pi / 2, 1e-12);
    EXPECT_EQ(scene.startPosition, glm::dvec3(0, -2000, 300));
    EXPECT_NEAR(scene.startPitch, -pi / 18, 1e-12);
    EXPECT_EQ(scene.clearance, 5.0);
    EXPECT_EQ(scene.separation, 20.0);
    EXPECT_EQ(scene.zeroParallax, 600.0);
    EXPECT_NEAR(scene.verticalFov, pi / 4, 1e-12);
}

TEST_F(SceneFileTest, TheSampleSaysTheDefaultsItDocuments) {
    const SceneFile scene = readSceneFile(fs::path(STEREONAV_SOURCE_DIR) / "data/scenes/every_key.toml");
    const TerrainLook look;
    EXPECT_EQ(scene.verticalScale, 1.0);
    EXPECT_FALSE(scene.openHoles || scene.look.shadeImage);
    EXPECT_TRUE(scene.startAboveGround);
    EXPECT_NEAR(scene.look.sunAzimuth, look.sunAzimuth, 0.005);
    EXPECT_NEAR(scene.look.sunElevation, look.sunElevation, 0.005);
    EXPECT_EQ(scene.look.ambient, look.ambient);
    EXPECT_EQ(scene.look.fogDistance, look.fogDistance);
    EXPECT_NEAR(scene.look.fogColor.y, look.fogColor.y, 0.01);
    EXPECT_EQ(scene.look.specular, look.specular);
    EXPECT_EQ(scene.look.shininess, look.shininess);
    EXPECT_NEAR(scene.verticalFov, SceneFile().verticalFov, 0.02);
}

TEST_F(SceneFileTest, TheBuiltInSampleIsTheBuiltInTerrain) {
    const SceneFile file = readSceneFile(fs::path(STEREONAV_SOURCE_DIR) / "data/scenes/built_in.toml");
    for (const char* name : {"", "terrain"}) {
        const SceneFile named = sceneFileFromName(name);
        EXPECT_TRUE(named.builtIn && file.builtIn);
        EXPECT_EQ(named.seed, file.seed);
        EXPECT_EQ(named.builtInSize, file.builtInSize);
        EXPECT_EQ(named.look.fogDistance, file.look.fogDistance);
        EXPECT_TRUE(named.dem.empty());
    }
}

TEST_F(SceneFileTest, AnAbsoluteFileStaysWhereItIs) {
    EXPECT_EQ(read("[terrain]\ndem = \"/data/a.tif\"\n").dem, fs::path("/data/a.tif"));
}

TEST_F(SceneFileTest, SeveralLandmarksKeepTheirOrder) {
    const SceneFile scene = read(
        "[terrain]\nbuiltin = true\n[[landmark]]\nmesh = \"a.glb\"\n[[landmark]]\nmesh = \"b.glb\"\nscale = "
        "2\n");
    ASSERT_EQ(scene.landmarks.size(), 2u);
    EXPECT_EQ(scene.landmarks[0].mesh.filename(), "a.glb");
    EXPECT_FALSE(scene.landmarks[0].z);
    EXPECT_EQ(scene.landmarks[1].scale, 2.0);
}

TEST_F(SceneFileTest, UnknownKeysAreReportedTogetherWithTheNearest) {
    EXPECT_EQ(
        errorOf("[terrain]\ndme = \"a.tif\"\nbuiltin = true\n[look]\nambiant = 0.3\n[sky]\nfov_deg = 50\n"),
        "scene.toml:2: unknown keys \"dme\" in [terrain] (nearest: \"dem\"), line 5: \"ambiant\" in [look] "
        "(nearest: \"ambient\"), line 7: \"fov_deg\" in [sky] (belongs in [stereo]); correct or remove them");
}

TEST_F(SceneFileTest, UnknownSectionsAndTopLevelKeysAreReportedToo) {
    EXPECT_EQ(errorOf("dem = \"a.tif\"\n"),
              "scene.toml:1: unknown key \"dem\" (belongs in [terrain]); correct or remove them");
    EXPECT_THAT(errorAfterTerrain("[sterio]\nfov_deg = 40\n"), HasSubstr("\"sterio\" (nearest: \"stereo\")"));
    EXPECT_THAT(errorAfterTerrain("[[landmark]]\nmesh = \"a.glb\"\nhight = 3\n"),
                HasSubstr("scene.toml:5: unknown key \"hight\" in [landmark] (nearest: "));
}

struct BadCase {
    const char* content;  // behind a good terrain; its first line is line 3
    const char* message;  // expected within the error
};
const BadCase kBadValues[] = {
    {"vertical_scale = -2", "scene.toml:3: \"vertical_scale\": expected a number from 1e-6 to 1e6, got -2"},
    {"vertical_scale = nan", "3: \"vertical_scale\": expected a number from 1e-6 to 1e6, got nan"},
    {"vertical_scale = inf", "got inf"},
    {"vertical_scale = \"2\"", "\"vertical_scale\": expected a number from 1e-6 to 1e6, got \"2\""},
    {"seed = -1", "\"seed\": expected a whole number from 0 to 9223372036854775806, got -1"},
    {"seed = 1.5", "got 1.5"},
    {"seed = 99999999999999999999", "\"seed\": expected a whole number"},
    {"size = 16", "\"size\": expected a whole number from 17 to 2049, got 16"},
    {"size = 100000", "got 100000"},
    {"nodata = \"ignore\"", "3: \"nodata\": expected \"fill\" or \"open\", got \"ignore\""},
    {"nodata = 3", "\"nodata\": expected text in quotes, got 3"},
    {"dem = \"a.tif\"", "expected either \"dem\" or builtin = true, got both; remove one of them"},
    {"[sky]\nimage = \"\"", "\"image\": expected text in quotes, got \"\""},
    {"[color]\nimage = [1, 2]", "scene.toml:4: \"image\": expected text in quotes, got a list of 2"},
    {"[color]\nshade_image = 1", "4: \"shade_image\": expected true or false, got 1"},
    {"[sky]\nimage = 1979-05-27", "4: \"image\": expected text in quotes, got a date or time"},
    {"[look]\nambient = 1.5", "4: \"ambient\": expected a number from 0 to 1, got 1.5"},
    {"[look]\nsun_elevation_deg = 91",
     "\"sun_elevation_deg\": expected a number from -90 to 90 degrees, got 91"},
    {"[look]\nfog_distance_m = -1", "\"fog_distance_m\": expected a number from 0 to 1e9 metres, got -1"},
    {"[look]\nfog_color = [0.1, 0.2]",
     "4: \"fog_color\": expected a list of 3 numbers from 0 to 1, got a list of 2"},
    {"[look]\nfog_color = [0.1, 0.2, 3.0]", "\"fog_color\": expected a list of 3 numbers from 0 to 1, got 3"},
    {"[look]\nshininess = 0", "\"shininess\": expected a number from 1 to 10000, got 0"},
    {"[[landmark]]\nscale = 2",
     "3: \"mesh\": expected a mesh for the landmark, found none; add mesh = \"file.glb\""},
    {"[[landmark]]\nmesh = \"a.glb\"\nscale = 0", "5: \"scale\": expected a number above 0"},
    {"[[landmark]]\nmesh = \"a.glb\"\nposition_m = [1, 2, 3]",
     "expected a list of 2 numbers from -1e9 to 1e9 metres, got a list of 3"},
    {"[[landmark]]\nmesh = \"a.glb\"\nposition_m = [1, nan]",
     "expected a list of 2 numbers from -1e9 to 1e9 metres, got nan"},
    {"[landmark]\nmesh = \"a.glb\"", "3: \"landmark\": expected sections [[landmark]], got a table"},
    {"[[stereo]]\nfov_deg = 40", "\"stereo\": expected a section [stereo], got a list of 1"},
    {"[start]\npitch_deg = 5",
     "4: \"pitch_deg\": needs a start position; add position_m = [x, y, z] under [start]"},
    {"[start]\nposition_m = [1, 2, inf]",
     "\"position_m\": expected a list of 3 numbers from -1e9 to 1e9 metres, got inf"},
    {"[start]\nposition_m = [1, 2, 3]\npitch_deg = 90.5",
     "5: \"pitch_deg\": expected a number from -90 to 90 degrees, got 90.5"},
    {"[flight]\nclearance_m = 0", "\"clearance_m\": expected a number from 1e-9 to 1e9 metres, got 0"},
    {"[stereo]\nfov_deg = 0", "\"fov_deg\": expected a number from 1 to 170 degrees, got 0"},
    {"[stereo]\nfov_deg = 180", "\"fov_deg\": expected a number from 1 to 170 degrees, got 180"},
    {"[stereo]\nseparation_m = -0.1", "\"separation_m\": expected a number from 0 to 1e9 metres, got -0.1"},
    {"[stereo]\nzero_parallax_m = 0",
     "\"zero_parallax_m\": expected a number from 1e-9 to 1e9 metres, got 0"},
};

TEST_F(SceneFileTest, WrongValuesAreNamedWithTheirLine) {
    for (const BadCase& bad : kBadValues)
        EXPECT_THAT(errorAfterTerrain(bad.content + std::string("\n")), HasSubstr(bad.message))
            << bad.content;
}

TEST_F(SceneFileTest, TheFirstWrongValueOfTheFileIsReported) {
    EXPECT_THAT(errorAfterTerrain("[stereo]\nfov_deg = 0\n[look]\nambient = 7\n"),
                HasSubstr("scene.toml:4:"));
}

TEST_F(SceneFileTest, WithoutATerrainItSaysWhatToWrite) {
    for (const char* content : {"", "# only a remark\n", "[look]\nambient = 0.2\n"})
        EXPECT_EQ(errorOf(content),
                  "scene.toml: expected a terrain, found none; write dem = \"file.tif\" or builtin = true "
                  "under [terrain]");
    EXPECT_THAT(errorOf("[look]\n[terrain]\nbuiltin = false\n"),
                AllOf(StartsWith("scene.toml:2: expected a terrain, found none")));
    EXPECT_THAT(errorOf("[terrain]\ndem = \"a.tif\"\nseed = 4\n"),
                HasSubstr("3: \"seed\": is for the built-in terrain only"));
}

TEST_F(SceneFileTest, SyntaxErrorsAreOneLineWithTheirPlace) {
    const std::string message = errorOf("[terrain]\nbuiltin = true\nsize 33\n");
    EXPECT_THAT(
        message,
        AllOf(StartsWith("scene.toml:3: "), Not(HasSubstr("toml::")), Not(HasSubstr("-->")),
              EndsWith("correct the line; TOML has [section] lines and key = value, text in quotes")));
    for (const char* content : {"[terrain\n", "[terrain]\ndem = \"a.tif\n", "[terrain]\ndem = a.tif\n",
                                "= 3\n", "[terrain]\nsize = 3\nsize = 4\n", "a = [1, 2\n", "\xff\xfe\x00\x01",
                                "[[terrain]\n", "[terrain]\nseed = 99999999999999999999\n"})
        EXPECT_THAT(errorOf(content), AllOf(StartsWith("scene.toml"), Not(HasSubstr("toml::")))) << content;
}

TEST_F(SceneFileTest, HostileNestingAndSizesAreRefused) {
    EXPECT_THAT(errorOf("a = " + std::string(100000, '[')),
                HasSubstr("scene.toml:1: brackets are nested too deeply"));
    std::string lines = "a = ";
    for (int k = 0; k < 20000; ++k) lines += "[\n";
    EXPECT_THAT(errorOf(lines), HasSubstr("brackets are nested too deeply"));
    EXPECT_THAT(errorOf(std::string(5000, 'a') + " = 1\n"), HasSubstr("the line is too long"));
    EXPECT_THAT(errorOf(std::string(2 << 20, '\n')), HasSubstr("expected a scene of at most 256 KiB"));
}

// A line of them is read by a person; to find each one's place all before it is counted.
TEST_F(SceneFileTest, OfManyUnknownKeysSomeAreTold) {
    std::string keys = "[terrain]\nbuiltin = true\n", landmarks = keys;
    for (int n = 0; n < 15000; ++n) keys += fmt::format("a{} = 1\n", n);
    const std::string message = errorOf(keys);
    EXPECT_THAT(message, AllOf(HasSubstr("unknown keys \"a"), HasSubstr(", and 14980 more; correct")));
    EXPECT_LT(message.size(), 2000u);
    for (int n = 0; n < 10000; ++n) landmarks += "[[landmark]]\n";
    EXPECT_THAT(errorOf(landmarks), HasSubstr("scene.toml:3: \"mesh\""));
    EXPECT_THAT(errorOf("[terrain]\nbuiltin = true\n" + std::string(4000, 'k') + " = 1\n"),
                AllOf(HasSubstr("kkk...\" in [terrain]"), Not(HasSubstr(std::string(100, 'k')))));
}

// Whatever is in the file, it is read or refused with an Error.
TEST_F(SceneFileTest, DamagedFilesAreReadOrRefused) {
    const std::string good = readTextFile(fs::path(STEREONAV_SOURCE_DIR) / "data/scenes/every_key.toml");
    std::mt19937 random(7);
    int refused = 0;
    for (int k = 0; k < 400; ++k) {
        std::string bad = good;
        for (int changes = 1 + k % 3; changes > 0; --changes) {
            const std::size_t at = random() % bad.size();
            if (random() % 2)
                bad[at] = static_cast<char>(random());
            else
                bad.erase(at, random() % 40);
        }
        if (k % 5 == 0) bad.resize(random() % bad.size());
        try {
            read(bad);
        } catch (const Error& error) {
            ++refused;
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        }
    }
    EXPECT_GT(refused, 100);
    EXPECT_LT(refused, 400);
}

TEST_F(SceneFileTest, NamesOfScenes) {
    const fs::path dem = mFolder / "hills.tif";
    std::ofstream(dem) << "x";
    EXPECT_EQ(sceneFileFromName(dem.string()).dem, dem);
    EXPECT_FALSE(sceneFileFromName(dem.string()).builtIn);
    written("[terrain]\nbuiltin = true\nseed = 9\n");
    EXPECT_EQ(sceneFileFromName((mFolder / "scene.toml").string()).seed, 9u);
    const auto messageOf = [](const std::string& name) -> std::string {
        try {
            sceneFileFromName(name);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(
        messageOf("no/such.tif"),
        "no/such.tif: no such file; name a scene file (.toml), an elevation model (.tif, .hgt, .dem, .asc, "
        ".png) or a folder of such, or nothing for the built-in terrain");
    EXPECT_THAT(messageOf("no/such.toml"), StartsWith("no/such.toml: no such file"));
    EXPECT_EQ(sceneFileFromName(mFolder.string()).dem, mFolder) << "its elevation files are one ground";
    fs::create_directory(mFolder / "none");
    EXPECT_THAT(messageOf((mFolder / "none").string()), HasSubstr("found a folder without elevation files"));
}

}  // namespace
}  // namespace stereonav
