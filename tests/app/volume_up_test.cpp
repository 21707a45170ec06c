// --up and --tilt through the real program.
#include <map>
#include <nlohmann/json.hpp>

#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;

class VolumeUp : public VolumeTest {
protected:
    void SetUp() override {
        VolumeTest::SetUp();
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
    }
    // Two millimetres a voxel, longer than wide, and heavier at one end than at the other.
    std::string club() const {
        const std::string head =
            "NRRD0004\ntype: short\ndimension: 3\nsizes: 12 14 20\nspace: left-posterior-superior\n"
            "space directions: (2,0,0) (0,2,0) (0,0,2)\nspace origin: (10,20,30)\nencoding: raw\n"
            "endian: little\n\n";
        std::string samples;
        for (int k = 0; k < 20; ++k)
            for (int j = 0; j < 14; ++j)
                for (int i = 0; i < 12; ++i) {
                    const double away = std::hypot(i - 5.5, j - 6.5);
                    const auto v = static_cast<std::int16_t>(away < 1 + 0.2 * k && k > 1 && k < 18 ? 900 : 5);
                    samples += static_cast<char>(v & 255);
                    samples += static_cast<char>(v >> 8);
                }
        return input("club.nrrd", head + samples);
    }
    std::string picture(const std::string& scene, const std::vector<std::string>& options) const {
        std::vector<std::string> arguments{"render", scene, "--size", "48x36", "--out", "up.png"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Outcome done = run(arguments);
        EXPECT_EQ(done.status, 0) << done.err;
        return contentOf(place() / "up.png");
    }
    Json info(const std::vector<std::string>& options) const {
        std::vector<std::string> arguments{"info", club(), "--size", "48x36", "--json"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Outcome done = run(arguments);
        EXPECT_EQ(done.status, 0) << done.err;
        return done.status == 0 ? Json::parse(done.out).at("volume") : Json();
    }
};

// The grid has a voxel more around it for the surface: its first one is at 8, 18, 28 mm.
TEST_F(VolumeUp, TheGridTurnsAboutTheOriginAndNothingElseDoes) {
    const std::map<std::string, std::vector<double>> origins{
        {"x", {-28, 18, 8}},  {"-x", {28, 18, -8}}, {"y", {8, -28, 18}},
        {"-y", {8, 28, -18}}, {"z", {8, 18, 28}},   {"-z", {-8, 18, -28}},
    };
    const Json straight = info({});
    for (const auto& [axis, origin] : origins) {
        SCOPED_TRACE(axis);
        const Json volume = info({"--up", axis});
        for (int n = 0; n < 3; ++n) EXPECT_NEAR(volume.at("origin_mm")[n].get<double>(), origin[n], 1e-9);
        for (const char* same : {"size", "range", "isovalue", "kind"})
            EXPECT_EQ(volume.at(same), straight.at(same)) << same;
        EXPECT_NE(volume.at("notes").dump().find("points to " + axis + " is up"), std::string::npos);
    }
}

TEST_F(VolumeUp, PicturesStandAsTheyAreAskedTo) {
    const std::string scene = club();
    const std::string straight = picture(scene, {});
    EXPECT_TRUE(picture(scene, {"--up", "z"}) == straight);
    EXPECT_TRUE(picture(scene, {"--up=-z"}) == picture(scene, {"--up", "-z"}));
    std::vector<std::string> seen{straight};
    for (const std::string axis : {"-z", "x", "-x", "y", "-y"}) {
        seen.push_back(picture(scene, {"--up", axis}));
        for (std::size_t n = 0; n + 1 < seen.size(); ++n) EXPECT_TRUE(seen[n] != seen.back()) << axis;
    }
    const auto medium = [&](std::vector<std::string> options) {
        options.insert(options.end(), {"--medium", "head", "--slices", "32", "--light-size", "32"});
        return picture(scene, options);
    };
    EXPECT_TRUE(medium({"--up", "-z"}) != medium({}));
}

TEST_F(VolumeUp, LightIsOfTheVolumeAsItStood) {
    const std::string scene = club(), light = (mFolder / "up.bake").string();
    ASSERT_EQ(run({"bake", scene, "--up", "-z", "--samples", "16", "--out", light}).status, 0);
    picture(scene, {"--up", "-z", "--light", light});
    std::filesystem::remove(place() / "up.png");
    expectRefused({"render", scene, "--light", light, "--out", "a.png"}, {"up.bake", "another volume"});
}

TEST_F(VolumeUp, RefusesWhatItCanNotMean) {
    for (const std::string axis : {"w", "", "Z", "zz", "+z"})
        expectRefused({"render", club(), "--up", axis, "--out", "a.png"}, {"--up", "x, -x, y, -y, z or -z"});
    for (const std::string& scene : {std::string("colon"), maskedTube()}) {
        expectRefused({"render", scene, "--up", "-z", "--out", "a.png"}, {"--up", "colon", "--isosurface"});
        expectRefused({"centreline", scene, "--up", "x", "--out", "a.txt"}, {"--up", "centreline --help"});
    }
    EXPECT_NE(picture(maskedTube(), {"--up", "x", "--isosurface"}), "");
    std::filesystem::remove(place() / "up.png");
    expectRefused({"render", hills(), "--up", "x", "--out", "a.png"}, {"--up", "terrain"});
    expectRefused({"render", "cloud", "--up", "x", "--out", "a.png"}, {"--up", "cloud"});
    expectRefused({"report", "--up", "x"}, {"--up", "--scene"});
    expectRefused({"bake", hills(), "--up", "x"}, {"--up", "terrain"});
}

TEST_F(VolumeUp, TheSkyTiltsAsInTheWindow) {
    const std::string scene = ball(), light = (mFolder / "t.bake").string();
    ASSERT_EQ(run({"bake", scene, "--what", "transfer", "--samples", "64", "--out", light}).status, 0);
    const auto shown = [&](std::vector<std::string> options) {
        options.insert(options.end(), {"--light", light});
        return picture(scene, options);
    };
    const std::string straight = shown({}), tilted = shown({"--tilt", "60"});
    EXPECT_TRUE(shown({"--tilt", "0"}) == straight);
    EXPECT_TRUE(tilted != straight);
    EXPECT_TRUE(shown({"--tilt", "-60"}) != tilted);
    // The overcast sky is the same all around until it is tilted.
    EXPECT_TRUE(shown({"--tilt", "60", "--turn", "90"}) != tilted);
    std::filesystem::remove(place() / "up.png");
    for (const std::string tilt : {"91", "-91", "nan", "inf"})
        expectRefused({"render", scene, "--light", light, "--tilt", tilt, "--out", "a.png"},
                      {"--tilt", "-90 to 90"});
    expectRefused({"render", scene, "--light", light, "--turn", "nan", "--out", "a.png"}, {"--turn"});
    expectRefused({"render", scene, "--tilt", "30", "--out", "a.png"}, {"--tilt", "--light"});
    expectRefused({"render", "cloud", "--tilt", "30", "--out", "a.png"}, {"--tilt"});
    expectRefused({"render", hills(), "--tilt", "30", "--out", "a.png"}, {"--tilt", "terrain"});
}

// What baking does not look at is not offered.
TEST_F(VolumeUp, HelpNamesWhatApplies) {
    for (const std::string command : {"render", "play", "compare", "view", "info", "bake", "report"}) {
        const std::string help = run({command, "--help"}).out;
        EXPECT_NE(help.find("--up"), std::string::npos) << command;
        EXPECT_NE(help.find("-z"), std::string::npos) << command;
    }
    EXPECT_NE(run({"render", "--help"}).out.find("--tilt"), std::string::npos);
    const std::string help = run({"bake", "--help"}).out;
    for (const char* of :
         {"--light", "--sky", "--probe", "--samples", "--isovalue", "--isosurface", "--series", "--label",
          "--seed", "--no-cache", "--threads", "--vertical-scale", "--open-holes"})
        EXPECT_NE(help.find(of), std::string::npos) << of;
    for (const char* other :
         {"--fov", "--separation", "--zero-parallax", "--sun", "--image", "--transfer", "--opacity",
          "--shading", "--ambient", "--modulate", "--exposure", "--turn", "--tilt"}) {
        EXPECT_EQ(help.find(other), std::string::npos) << other;
        expectRefused({"bake", ball(), other, "1"}, {other, "bake --help"});
    }
}

}  // namespace
}  // namespace stereonav::test
