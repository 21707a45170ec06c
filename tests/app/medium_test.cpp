// Volume light through the real program: media that are built in, volumes and terrain shown as media.
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/picture_values.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

// Milky and thin, or with a surface; 48 mm are a few optical depths.
constexpr const char* kMilk = "reference_mm 20\n0 0.9 0.8 0.7 0\n1000 0.9 0.8 0.7 0.8\n";
constexpr const char* kSkin = "reference_mm 20\n0 0.9 0.8 0.7 0 surface 1\n1000 0.9 0.8 0.7 0.99 surface 1\n";
// Plain: light is compared with light, not with what a tone curve makes of it.
const std::vector<std::string> kSmall{"--size",       "40x30", "--slices", "24",
                                      "--light-size", "24",    "--look",   "plain"};

class MediumCommands : public VolumeTest {
protected:
    void SetUp() override {
        VolumeTest::SetUp();
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
    }

    Outcome runWell(std::vector<std::string> arguments) const {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        return outcome;
    }
    Outcome runSmall(std::vector<std::string> arguments) const {
        arguments.insert(arguments.end(), kSmall.begin(), kSmall.end());
        return runWell(std::move(arguments));
    }

    // The picture's bytes.
    std::string picture(const std::string& scene, std::vector<std::string> options) const {
        const std::string file = (mFolder / "picture.png").string();
        options.insert(options.begin(), {"render", scene, "--out", file});
        runSmall(std::move(options));
        return contentOf(file);
    }
    Shown shown(const std::string& scene, const std::vector<std::string>& options) const {
        picture(scene, options);
        return readLinearImage(mFolder / "picture.png");
    }
    std::string hashOf(const std::string& scene, std::vector<std::string> options) const {
        options.insert(options.begin(), {"play", scene, "--hash"});
        const std::string out = runSmall(std::move(options)).out;
        const std::size_t at = out.find("hash ");
        EXPECT_NE(at, std::string::npos) << out;
        return at == std::string::npos ? "" : out.substr(at);
    }
};

// From the south, at the height of the ball's middle: what is to the left and to the right is alike.
const std::vector<std::string> kFromTheSouth{"--pose", "-0.001,-0.15,-0.001,0,0,0"};

// Emission sends on what arrives everywhere; surface that times the light's radiance (0.85 where nothing is
// said) and Blinn-Phong; direct what of the radiance gets there, indirect as much and more.
TEST_F(MediumCommands, EachModelIsAKnownPartOfTheOthers) {
    const std::string milk = input("milk.txt", kMilk);
    const auto model = [&](const char* name, const char* color) {
        return shown(ball(), {"--medium", milk, "--model", name, "--light-color", color});
    };
    const Shown emission = shown(ball(), {"--medium", milk, "--model", "emission"});
    const Shown dark = model("surface", "0"), surface = model("surface", "0.85");
    const Shown direct = model("direct", "0.85"), indirect = model("indirect", "0.85");
    EXPECT_GT(sumOf(emission).x, 1.3f * sumOf(dark).x) << "there is something to compare";
    // The light that is sent on, times a factor.
    const auto times = [&](float factor) {
        return mapped(dark, emission,
                      [=](const glm::vec3& d, const glm::vec3& e) { return d + factor * (e - d); });
    };
    constexpr float kAmbient = 0.1f, kDiffuse = 0.9f, kSpecular = 0.2f;  // MediumLook's
    expectNoBrighter(times(0.85f * kAmbient), surface, "surface, away from the light");
    expectNoBrighter(surface, times(0.85f * (kAmbient + kDiffuse + kSpecular)), "surface, facing it");
    expectNoBrighter(dark, direct, "direct");
    expectNoBrighter(direct, times(0.85f), "direct");
    expectNoBrighter(direct, indirect, "indirect");
    EXPECT_LT(sumOf(direct).y, 0.95f * sumOf(times(0.85f)).y) << "light is lost on its way";
    EXPECT_GT(sumOf(indirect).y, 1.02f * sumOf(direct).y) << "a part of it by scattering";
    expectAlike(shown(ball(), {"--medium", milk}), indirect, 0, "the default");
}

// An even slope that a low sun grazes is even: no stripes of the light's texels. By second differences of
// grey levels, of which rounding alone leaves 0.3.
TEST_F(MediumCommands, AnEvenSlopeUnderALowSunHasNoRipples) {
    const std::string slope =
        grid("slope.asc", 200, 200, 30.0, [](int i, int j) { return 300 + 4.5 * i + 1.5 * (199 - j); });
    for (const char* sun : {"270,12", "240,8"}) {
        runWell({"render", slope, "--medium", "snow", "--size", "320x200", "--sun", sun, "--pose",
                 "3000,-1500,2300,0,-35,0", "--out", "slope.png"});
        const Plane<PackedColor> picture = readColorImage(place() / "slope.png");
        const auto grey = [&](int x, int y) {
            return std::round(255 * srgbFromLinear(unpackColor(picture.at(x, y)).y));
        };
        double across = 0, down = 0;
        int pixels = 0;
        for (int y = 70; y < 170; ++y)
            for (int x = 60; x < 260; ++x) {
                across += std::abs(grey(x - 2, y) - 2 * grey(x, y) + grey(x + 2, y));
                down += std::abs(grey(x, y - 2) - 2 * grey(x, y) + grey(x, y + 2));
                ++pixels;
            }
        EXPECT_LT(across / pixels, 0.4) << sun;
        EXPECT_LT(down / pixels, 0.4) << sun;
    }
}

TEST_F(MediumCommands, LightAddsUpAndIsAsItsColourSays) {
    const std::string milk = input("milk.txt", kMilk);
    const auto lit = [&](const char* color) {
        return shown(ball(), {"--medium", milk, "--light-color", color});
    };
    const Shown dark = lit("0"), white = lit("1");
    const glm::vec3 color(1, 0.5f, 0.2f);
    expectAlike(
        lit("1,0.5,0.2"),
        mapped(dark, white, [&](const glm::vec3& d, const glm::vec3& w) { return d + color * (w - d); }), 2,
        "coloured light");
}

// Light from the eye's own side turns straight back: Henyey-Greenstein's (1 - g^2) / (1 + g)^3 of it for
// direct light (within 1 % at the picture's edges), and of a sum of three g, one for each colour.
TEST_F(MediumCommands, APhaseFunctionScalesWhatTurnsBack) {
    const std::string milk = input("milk.txt", kMilk);
    const auto seen = [&](const char* phase) {
        std::vector<std::string> options{"--medium", milk,      "--model", "direct",        "--light-from",
                                         "180,0",    "--phase", phase,     "--light-color", "1.5"};
        options.insert(options.end(), kFromTheSouth.begin(), kFromTheSouth.end());
        return shown(ball(), options);
    };
    std::vector<std::string> noLight{"--medium", milk, "--model", "direct", "--light-color", "0"};
    noLight.insert(noLight.end(), kFromTheSouth.begin(), kFromTheSouth.end());
    const Shown dark = shown(ball(), noLight), even = seen("none");
    const auto back = [](float g) { return (1 - g * g) / std::pow(1 + g, 3.0f); };
    const auto scaled = [&](const glm::vec3& g) {
        const glm::vec3 share(back(g.x), back(g.y), back(g.z));
        return mapped(dark, even,
                      [=](const glm::vec3& d, const glm::vec3& e) { return d + share * (e - d); });
    };
    expectAlike(seen("hg 0"), even, 1.1f, "hg 0");
    expectAlike(seen("hg 0.2"), scaled(glm::vec3(0.2f)), 2.5f, "hg 0.2");
    expectAlike(seen("hg -0.1 0.2 0.5"), scaled({-0.1f, 0.2f, 0.5f}), 2.5f, "hg by colour");
}

TEST_F(MediumCommands, LightComesFromWhereItIsSaid) {
    const std::string milk = input("milk.txt", kMilk);
    const auto from = [&](std::vector<std::string> options) {
        options.insert(options.end(), {"--medium", milk});
        options.insert(options.end(), kFromTheSouth.begin(), kFromTheSouth.end());
        return shown(ball(), options);
    };
    const Shown east = from({"--light-from", "90,10"}), above = from({"--light-from", "90,89"});
    expectAlike(mirrored(from({"--light-from", "270,10"})), east, 1.1f, "west is east mirrored");
    // Compares the halves of one eye: the one on the light's side is brighter.
    const auto halves = [](const Shown& picture, bool across) {
        glm::vec2 sum(0);
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width / 2; ++x) {
                const float light = picture.pixels[static_cast<std::size_t>(y) * picture.width + x].x;
                sum[across ? (x >= picture.width / 4) : (y >= picture.height / 2)] += light;
            }
        return sum;
    };
    EXPECT_GT(halves(east, true)[1], 1.1f * halves(east, true)[0]);
    EXPECT_GT(halves(above, false)[0], 1.1f * halves(above, false)[1]);
    expectAlike(from({"--lamp", "head"}), from({"--lamp", "-0.001,-0.15,-0.001"}), 1.1f, "the head's lamp");
    EXPECT_NE(picture(ball(), {"--medium", milk, "--cone", "90"}), picture(ball(), {"--medium", milk}));
}

// Twice the slices are half as far from many.
TEST_F(MediumCommands, SlicesConverge) {
    const std::string milk = input("milk.txt", kMilk);
    const auto sliced = [&](const char* count) {
        const std::string file = (mFolder / "picture.png").string();
        runWell({"render", ball(), "--medium", milk, "--slices", count, "--size", "40x30", "--light-size",
                 "24", "--look", "plain", "--out", file});
        return readLinearImage(file);
    };
    const Shown many = sliced("384");
    const auto awayOf = [&](const Shown& some) {
        double sum = 0;
        for (std::size_t n = 0; n < some.pixels.size(); ++n)
            sum += std::abs(static_cast<double>(some.pixels[n].x - many.pixels[n].x));
        return sum;
    };
    const double few = awayOf(sliced("6")), twice = awayOf(sliced("12"));
    EXPECT_GT(few, 0);
    EXPECT_LT(twice, 0.75 * few);
}

// The lamp of the chosen look fades sooner: what is far is darker against what is near, both eyes alike; and
// the wall is redder. Depths are the same.
TEST_F(MediumCommands, AColonsWallIsMoistInTheChosenLook) {
    const auto looking = [&](const char* look, const char* mode) {
        const std::string file = (mFolder / "wall.png").string();
        runWell({"render", "colon", "--look", look, "--mode", mode, "--size", "64x36", "--out", file});
        return readLinearImage(file);
    };
    for (const char* mode : {"ml", "mr"}) {
        const Shown plain = looking("plain", mode), moist = looking("auto", mode);
        const auto mean = [](const Shown& shown, bool far) {
            glm::dvec3 sum(0);
            int count = 0;
            for (int y = 0; y < 36; ++y)
                for (int x = 0; x < 64; ++x)
                    if (const bool middle = std::abs(x - 32) < 8 && std::abs(y - 14) < 6; middle == far)
                        sum += glm::dvec3(shown.pixels[static_cast<std::size_t>(64 * y + x)]), ++count;
            return sum / static_cast<double>(count);
        };
        const glm::dvec3 nearPlain = mean(plain, false), nearMoist = mean(moist, false);
        const glm::dvec3 farPlain = mean(plain, true), farMoist = mean(moist, true);
        EXPECT_LT(farMoist.x / nearMoist.x, 0.85 * farPlain.x / nearPlain.x) << mode;
        EXPECT_GT(nearMoist.x / nearMoist.z, 1.3 * nearPlain.x / nearPlain.z) << mode;
    }
}

// Plain clips what is brighter than white; the chosen look shows it, and leaves dark pixels as they are.
TEST_F(MediumCommands, BrightMediaAreNotClipped) {
    const std::string bright = input("bright.txt", "reference_mm 2\n0 1 1 1 0\n400 1 1 1 0\n600 1 1 1 0.9\n");
    for (const std::vector<std::string>& scene :
         {std::vector<std::string>{ball(), "--medium", bright, "--light-color", "2"},
          {"cloud", "--light-color", "1.2"},
          {"wax"}})
        for (const std::string mode : {"ml", "mr"}) {
            SCOPED_TRACE(scene[0] + " " + mode);
            const auto looking = [&](const char* look) {
                const std::string file = (mFolder / (std::string(look) + ".png")).string();
                std::vector<std::string> arguments{"render"};
                arguments.insert(arguments.end(), scene.begin(), scene.end());
                for (const char* word : {"--look", look, "--mode", mode.c_str(), "--size", "80x45",
                                         "--slices", "64", "--light-size", "64", "--out"})
                    arguments.emplace_back(word);
                arguments.push_back(file);
                runWell(arguments);
                return readLinearImage(file);
            };
            const Shown plain = looking("plain"), chosen = looking("auto");
            int clipped = 0, dark = 0;
            for (std::size_t n = 0; n < plain.pixels.size(); ++n)
                for (int c = 0; c < 3; ++c) {
                    const float was = plain.pixels[n][c], is = chosen.pixels[n][c];
                    clipped += was == 1;
                    EXPECT_LT(is, 1);
                    if (scene.size() < 3 || scene[0] == "cloud") continue;  // another body, another sky
                    EXPECT_LE(is, was);
                    if (was > 0.55f) continue;
                    ++dark;
                    EXPECT_EQ(is, was);
                }
            EXPECT_GT(clipped, 50);
            EXPECT_GT(dark, scene[0] == ball() ? 500 : -1);
        }
}

TEST_F(MediumCommands, WhatIsTheDefaultChangesNothingAndNoiseDoes) {
    const std::string milk = input("milk.txt", kMilk);
    const std::string usual = picture(ball(), {"--medium", milk});
    EXPECT_EQ(picture(ball(), {"--medium", milk, "--phase", "none"}), usual);
    EXPECT_EQ(picture(ball(), {"--medium", milk, "--noise", "none"}), usual);
    EXPECT_NE(picture(ball(), {"--medium", milk, "--noise", "fur"}), usual);
    // The other way to two eyes: the left one is the same, the right one nearly.
    const Shown both = shown(ball(), {"--medium", milk}),
                splat = shown(ball(), {"--medium", milk, "--method", "depthsplat"});
    for (int y = 0; y < both.height; ++y)
        for (int x = 0; x < both.width / 2; ++x) {
            const std::size_t n = static_cast<std::size_t>(y) * both.width + x;
            ASSERT_LE(std::abs(levels(both.pixels[n].x) - levels(splat.pixels[n].x)), 1.1f) << x << " " << y;
        }
}

// The same frames twice and with one thread, to the byte; the cloud moves between frames though the eye
// does not, on the path's clock and not by how many frames there were.
TEST_F(MediumCommands, AnAnimatedCloudPlaysTheSameTwice) {
    const std::string path =
        input("still.path", "5 0 -3000 0 0.7071 0 0 0.7071\n9 0 -3000 0 0.7071 0 0 0.7071\n");
    const std::vector<std::string> options{"--path", path, "--frames", "3"};
    const std::string first = hashOf("cloud", options);
    EXPECT_EQ(hashOf("cloud", options), first);
    std::vector<std::string> one = options;
    one.insert(one.end(), {"--threads", "1"});
    EXPECT_EQ(hashOf("cloud", one), first);

    runSmall({"play", "cloud", "--path", path, "--frames", "3", "--out", "three"});
    runSmall({"play", "cloud", "--path", path, "--fps", "1", "--out", "five"});
    const auto frame = [&](const char* folder, int n) {
        return contentOf(place() / folder / ("frame_0000" + std::to_string(n) + ".png"));
    };
    EXPECT_TRUE(frame("three", 0) != frame("three", 1));
    EXPECT_TRUE(frame("three", 1) != frame("three", 2));
    EXPECT_TRUE(frame("three", 1) == frame("five", 2)) << "both two seconds after the start";
    EXPECT_TRUE(frame("three", 2) == frame("five", 4));
    runSmall({"play", "cloud", "--path", path, "--frames", "2", "--noise", "none", "--out", "still"});
    EXPECT_TRUE(frame("still", 0) == frame("still", 1)) << "without noise nothing moves";
}

TEST_F(MediumCommands, CompareListsTheFourWaysToTwoEyes) {
    const std::string out =
        runSmall({"compare", "cloud", "--frames", "2", "--repeats", "1", "--json", "a.json", "--csv", "a.csv",
                  "--plot", "plot.png", "--images", "pictures"})
            .out;
    const Json methods = Json::parse(contentOf(place() / "a.json")).at("methods");
    ASSERT_EQ(methods.size(), 4u);
    const std::vector<std::string> names{"sweep", "own-samples", "two-sweeps", "depthsplat"};
    for (std::size_t n = 0; n < names.size(); ++n) {
        const Json& method = methods[n];
        EXPECT_EQ(method.at("name"), names[n]);
        EXPECT_NE(out.find("\n" + names[n] + " "), std::string::npos) << out;
        EXPECT_LT(method.at("rms_levels").get<double>(), 1.0) << names[n] << ": within one grey level";
        EXPECT_GT(method.at("left_ms").get<double>(), 0.0) << names[n];
        EXPECT_GT(method.at("full_right_ms").get<double>(), 0.0) << names[n];
        for (const char* none : {"true_psnr_db", "left_true_psnr_db"})
            EXPECT_TRUE(method.at(none).is_null()) << "there is no finer truth";
        for (const char* felt : {"flicker_db", "rivalry_db", "edge_rivalry_db"})
            EXPECT_GT(method.at(felt).get<double>(), 40.0) << names[n] << " " << felt;
        EXPECT_GT(method.at("pair_ms").get<double>(), 0.0) << names[n];
        for (const char* end : {"_left.png", "_right.png", "_right_difference_x20.png"})
            EXPECT_TRUE(fs::exists(place() / "pictures" / (names[n] + end))) << names[n] << end;
    }
    EXPECT_EQ(methods[2].at("flicker_db"), 100.0);
    EXPECT_EQ(methods[2].at("rivalry_db"), 100.0);
    EXPECT_EQ(methods[2].at("psnr_db"), 100.0) << "it is what the others are measured against";
    EXPECT_GT(methods[3].at("warp_ms").get<double>(), 0.0);
    EXPECT_EQ(linesIn(contentOf(place() / "a.csv")), 5);
    EXPECT_TRUE(fs::exists(place() / "plot.png"));
    runSmall({"compare", "wax", "--frames", "1", "--repeats", "1", "--methods", "depthsplat,sweep", "--json",
              "b.json"});
    EXPECT_EQ(Json::parse(contentOf(place() / "b.json")).at("methods")[0].at("name"), "depthsplat");
}

TEST_F(MediumCommands, CompareHasNoFinerTruthOfThem) {
    expectRefused({"compare", "cloud", "--truth-rays", "16"}, {"--truth-rays", "medium"});
}

TEST_F(MediumCommands, InfoTellsWhatIsSwept) {
    const Json json =
        Json::parse(runWell({"info", "wax", "--json", "--slices", "77", "--model", "direct"}).out);
    EXPECT_EQ(json.at("scene"), "wax");
    EXPECT_EQ(json.at("medium").at("slices"), 77);
    EXPECT_EQ(json.at("medium").at("model"), "direct");
    EXPECT_EQ(json.at("medium").at("animated"), false);
    EXPECT_GT(json.at("medium").at("largest_extinction_per_m").get<double>(), 0.0);
    EXPECT_EQ(json.at("plan").at("method"), "sweep");
    const std::string text = runWell({"info", "cloud"}).out;
    for (const char* word : {"medium", "transfer", "indirect", "moving", "slices", "frame plan", "sweep"})
        EXPECT_NE(text.find(word), std::string::npos) << word << " in\n" << text;
    const Json ball_ = Json::parse(
        runWell({"info", ball(), "--medium", input("milk.txt", kMilk), "--json", "--lamp", "head"}).out);
    EXPECT_EQ(ball_.at("volume").at("kind"), "isosurface");
    EXPECT_NE(ball_.at("medium").at("light").get<std::string>().find("head"), std::string::npos);
}

TEST_F(MediumCommands, InfoCountsTheSweepsBuffers) {
    const auto held = [&](const char* lightSize) {
        const Json medium = Json::parse(runWell({"info", "wax", "--json", "--size", "64x48", "--slices", "32",
                                                 "--light-size", lightSize})
                                            .out)
                                .at("medium");
        std::size_t sum = 0;
        for (const auto& [what, bytes] : medium.at("held").items()) sum += bytes.get<std::size_t>();
        EXPECT_EQ(medium.at("bytes"), sum);
        return medium.at("held");
    };
    const Json small = held("32"), large = held("128");
    // Both eyes have four floats of light and one of depth.
    EXPECT_EQ(small.at("pictures"), 2 * 64 * 48 * 5 * sizeof(float));
    EXPECT_EQ(large.at("pictures"), small.at("pictures"));
    EXPECT_GT(small.at("field").get<std::size_t>(), 1000u);
    // At least the light's own plane.
    EXPECT_GE(large.at("sweep").get<std::size_t>(),
              small.at("sweep").get<std::size_t>() + (128 * 128 - 32 * 32) * sizeof(float));
}

TEST_F(MediumCommands, ATerrainIsAHeightVolumeUnderMist) {
    const std::string ground = picture(hills(), {"--medium", "ground"});
    EXPECT_TRUE(ground != picture(hills(), {"--medium", "ground", "--mist", "140,1"}));
    EXPECT_TRUE(ground != picture(hills(), {"--medium", "ground", "--sun", "90,10"}));
    const std::string sand = input("sand.txt", "reference_mm 30000\n100 1 0.9 0.6 0.9\n150 1 1 0.8 0.9\n");
    EXPECT_TRUE(ground != picture(hills(), {"--medium", sand}));
    const Json json =
        Json::parse(runWell({"info", hills(), "--medium", "ground", "--mist", "140,1", "--json"}).out);
    EXPECT_EQ(json.at("medium").at("layers"), 2);
}

TEST_F(MediumCommands, TheEyeFliesInsideAColon) {
    const std::string tube = maskedTube();
    const std::string wall =
        input("wall.txt", "reference_mm 1\n-500 0.8 0.4 0.3 0\n-100 0.8 0.4 0.3 0.6\n100 0.8 0.5 0.4 0.9\n");
    const std::string lit = picture(tube, {"--medium", wall});
    EXPECT_TRUE(lit != picture(tube, {"--medium", wall, "--model", "emission"}));
    EXPECT_TRUE(lit != picture(tube, {"--medium", wall, "--light-color", "0.3"}));
    EXPECT_EQ(hashOf(tube, {"--medium", wall, "--frames", "2"}),
              hashOf(tube, {"--medium", wall, "--frames", "2"}));
}

TEST_F(MediumCommands, BakedLightIsSeenWhereTheMediumHasASurface) {
    const std::string bake = (mFolder / "irradiance.bake").string();
    const Outcome baked = run({"bake", ball(), "--samples", "16", "--sky", "0.3,0.5,1", "--out", bake});
    ASSERT_EQ(baked.status, 0) << baked.err;
    const std::string skin = input("skin.txt", kSkin), milk = input("milk.txt", kMilk);
    EXPECT_TRUE(picture(ball(), {"--medium", skin}) != picture(ball(), {"--medium", skin, "--light", bake}));
    EXPECT_TRUE(picture(ball(), {"--medium", milk}) == picture(ball(), {"--medium", milk, "--light", bake}))
        << "without a surface there is nothing that baked light falls on";
}

TEST_F(MediumCommands, NoiseComesFromAFile) {
    const std::string milk = input("milk.txt", kMilk);
    const std::string noise =
        input("noise.txt",
              "# ripples\nseed 3\nsize 0.02 displacement 0.002\n"
              "size 0.01 extinction 0.5 color 0.2 0.1 0 indirect 0 0 0.3 velocity 0 0 1\n");
    EXPECT_TRUE(picture(ball(), {"--medium", milk, "--noise", noise}) != picture(ball(), {"--medium", milk}));
    EXPECT_EQ(Json::parse(runWell({"info", ball(), "--medium", milk, "--noise", noise, "--json"}).out)
                  .at("medium")
                  .at("animated"),
              true);
    const auto refused = [&](const std::string& text, const std::vector<std::string>& words) {
        expectRefused({"render", "cloud", "--noise", input("bad.txt", text), "--out", "a.png"}, words);
    };
    refused("", {"bad.txt", "at least one scale"});
    refused("seed 1\n\nsize x\n", {"bad.txt:3", "expected a number", "\"x\""});
    refused("size 1\nsize 0 displacement 1\n", {"bad.txt:2", "above 0"});
    refused("displacement 1\n", {"bad.txt:1", "size above 0"});
    refused("size 1 colour 1 1 1\n", {"bad.txt:1", "colour", "color"});
    refused("size 1 color 1 1\n", {"bad.txt:1", "expected a number"});
    refused("size nan\n", {"bad.txt:1", "expected a number"});
    refused("seed -1\nsize 1\n", {"bad.txt:1", "seed"});
    refused("size 1\nsize 1\nsize 1\nsize 1\nsize 1\n", {"bad.txt"});
}

TEST_F(MediumCommands, BadValuesAreRefusedInOneLine) {
    const auto refused = [&](const std::vector<std::string>& options, const std::vector<std::string>& words) {
        std::vector<std::string> all{"render", "cloud", "--out", "a.png"};
        all.insert(all.end(), options.begin(), options.end());
        expectRefused(all, words);
    };
    refused({"--model", "phong"}, {"phong", "emission, surface, direct, indirect"});
    refused({"--phase", "hg 1.5"}, {"1.5"});
    refused({"--phase", "milk"}, {"milk"});
    refused({"--light-from", "90"}, {"--light-from", "\"90\"", "315,30"});
    refused({"--light-from", "0,91"}, {"--light-from"});
    refused({"--light-from", "nan,3"}, {"--light-from"});
    refused({"--lamp", "ceiling"}, {"--lamp", "head", "ceiling"});
    refused({"--lamp", "1,2,inf"}, {"--lamp"});
    refused({"--lamp", "head", "--light-from", "0,10"}, {"--lamp", "--light-from"});
    refused({"--light-color", "1,2"}, {"--light-color", "three"});
    refused({"--light-color", "-1"}, {"--light-color"});
    refused({"--slices", "0"}, {"--slices", "65536"});
    refused({"--slices", "65537"}, {"--slices"});
    refused({"--light-size", "7"}, {"--light-size", "8"});
    refused({"--light-size", "5000"}, {"--light-size", "4096"});
    refused({"--cone", "180"}, {"--cone", "180"});
    refused({"--cone", "-1"}, {"--cone"});
    refused({"--shading-width", "17"}, {"--shading-width", "0 to 16", "17", "1 is the default"});
    refused({"--shading-width", "-1"}, {"--shading-width"});
    refused({"--shading-width", "nan"}, {"--shading-width"});
    refused({"--noise", "sand"}, {"--noise", "sand", "cloud, fur or none"});
    refused({"--medium", "jelly"}, {"jelly", "wax"});
    refused({"--medium", "ground"}, {"--medium", "terrain"});
    refused({"--mist", "900,2"}, {"--mist", "terrain"});
    refused({"--method", "linear"}, {"linear", "sweep, own-samples, two-sweeps, depthsplat"});
    refused({"--transfer", "metal"}, {"--transfer", "medium"});
    refused({"--isosurface"}, {"--isosurface", "built in"});
    refused({"--light", "a.bake"}, {"--light", "built in"});
    refused({"--sun", "0,10"}, {"--sun", "terrain"});
}

TEST_F(MediumCommands, OptionsOfMediaAreRefusedElsewhere) {
    const std::string scene = hills();
    expectRefused({"render", scene, "--model", "direct", "--out", "a.png"}, {"--model", "--medium"});
    expectRefused({"render", scene, "--slices", "10", "--out", "a.png"}, {"--slices", "--medium"});
    expectRefused({"render", scene, "--method", "sweep", "--out", "a.png"}, {"sweep"});
    expectRefused({"render", scene, "--medium", "ground", "--mist", "50,1", "--out", "a.png"},
                  {"--mist", "100", "149"});
    expectRefused({"render", scene, "--medium", "ground", "--mist", "50", "--out", "a.png"},
                  {"--mist", "900,2"});
    expectRefused({"render", scene, "--medium", "ground", "--light", "auto", "--out", "a.png"}, {"--light"});
    expectRefused({"render", ball(), "--medium", "cloud", "--light", "lazy", "--out", "a.png"}, {"lazy"});
    expectRefused({"render", ball(), "--medium", "cloud", "--ambient", "3", "--out", "a.png"}, {"--ambient"});
    expectRefused({"bake", "cloud", "--out", "a.bake"}, {"cloud", "medium"});
    expectRefused({"mesh", "wax", "--out", "a.glb"}, {"wax", "terrain"});
    expectRefused({"centreline", "wax", "--out", "a.vtp"}, {"wax", "CT study"});
    expectRefused({"compare", "cloud", "--methods", "sweep,full"}, {"full", "depthsplat"});
}

}  // namespace
}  // namespace stereonav::test
