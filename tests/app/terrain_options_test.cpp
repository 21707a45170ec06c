// Options of terrains through the real program: each changes what is seen or is refused in one line.
#include <array>
#include <set>

#include "tests/app/program.h"

namespace stereonav::test {
namespace {

class TerrainOptions : public ProgramTest {
protected:
    void SetUp() override {
        ProgramTest::SetUp();
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
    }

    // A picture of the ground: its western half red, its eastern green. A bitmap of 32x24.
    std::string photo() const {
        std::string bmp("BM\x36\x09\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x20\0\0\0\x18\0\0\0\x01\0\x18\0", 30);
        bmp += std::string(24, '\0');
        for (int n = 0; n < 32 * 24; ++n)
            bmp += n % 32 < 16 ? std::string("\0\0\xff", 3) : std::string("\0\xff\0", 3);
        return input("photo.bmp", bmp);
    }
    std::string scene(const std::string& name, const std::string& more) const {
        hills();
        photo();
        return input(name, "[terrain]\ndem = \"hills.asc\"\n" + more);
    }
    // A picture's bytes: straight down on the hills, north up, unless a pose is given.
    std::string bytes(const std::string& of, std::vector<std::string> options) const {
        const std::string file = (mFolder / "picture.bmp").string();
        options.insert(options.begin(), {"render", of, "--out", file, "--size", "48x36", "--mode", "ml"});
        if (std::find(options.begin(), options.end(), "--pose") == options.end())
            options.insert(options.end(), {"--pose", "0,0,900,0,-90,0"});
        const Outcome outcome = run(options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        return contentOf(file);
    }
    // Red, green and blue of a pixel of 48x36, from the upper left.
    static std::array<int, 3> pixel(const std::string& bmp, int x, int y) {
        const auto byte = [&](std::size_t n) {
            return static_cast<int>(static_cast<unsigned char>(bmp.at(n)));
        };
        const std::size_t first = byte(10) + 256 * byte(11);
        const std::size_t at = first + (35 - y) * 48 * 3 + x * 3;
        return {byte(at + 2), byte(at + 1), byte(at)};
    }
    void refused(const std::string& of, std::vector<std::string> options,
                 const std::vector<std::string>& words) const {
        options.insert(options.begin(), {"render", of, "--out", "a.png", "--size", "32x24"});
        expectRefused(options, words);
    }
};

TEST_F(TerrainOptions, TheSunOverAPhotoIsRefusedWithTheWayOut) {
    const std::string ground = hills(), picture = photo();
    refused(ground, {"--image", picture, "--sun", "90,10"}, {"--sun", "--shade-image", "--light", "bake"});
    refused(scene("photo.toml", "[color]\nimage = \"photo.bmp\"\n"), {"--sun", "90,10"},
            {"--sun", "--shade-image"});
    // The way out.
    const std::string east = bytes(ground, {"--image", picture, "--shade-image", "--sun", "90,10"});
    EXPECT_TRUE(east != bytes(ground, {"--image", picture, "--shade-image", "--sun", "270,10"}));
    EXPECT_TRUE(east != bytes(ground, {"--image", picture}));
}

TEST_F(TerrainOptions, TheSunTurnsWhateverItFallsOn) {
    // A tint, the built-in terrain, highlights on a photo, a photo under baked light and as a medium.
    const auto turns = [&](const std::string& of, const std::vector<std::string>& options, const char* what) {
        std::set<std::string> pictures;
        for (const char* sun : {"90,20", "270,20"}) {
            std::vector<std::string> all = options;
            all.insert(all.end(), {"--sun", sun});
            pictures.insert(bytes(of, all));
        }
        EXPECT_EQ(pictures.size(), 2u) << what;
    };
    turns(hills(), {}, "tint");
    turns(input("small.toml", "[terrain]\nbuiltin = true\nsize = 65\n"), {"--pose", "0,0,9000,0,-60,0"},
          "built in");
    turns(scene("glossy.toml", "[color]\nimage = \"photo.bmp\"\n[look]\nspecular = 0.8\nshininess = 3\n"), {},
          "highlights");
    turns(hills(), {"--image", photo(), "--medium", "ground", "--slices", "60", "--light-size", "32"},
          "medium");
    const std::string light = (mFolder / "hills.light").string();
    ASSERT_EQ(run({"bake", hills(), "--samples", "16", "--bounces", "0", "--out", light}).status, 0);
    turns(hills(), {"--image", photo(), "--light", light}, "baked light");
}

// What the built-in terrain holds without a sun is what it holds under the usual one.
TEST_F(TerrainOptions, TheBuiltInTerrainsSunIsTheUsualOne) {
    const std::string small = input("small.toml", "[terrain]\nbuiltin = true\nsize = 65\n");
    const std::vector<std::string> pose{"--pose", "0,0,9000,0,-60,0"};
    const std::string usual = bytes(small, pose);
    const std::string said =
        input("said.toml", "[terrain]\nbuiltin = true\nsize = 65\n[look]\nsun_elevation_deg = 45.2637\n");
    const std::string near = bytes(said, pose);
    ASSERT_EQ(usual.size(), near.size());
    int most = 0;
    for (std::size_t n = 0; n < usual.size(); ++n)
        most = std::max(most,
                        std::abs(static_cast<unsigned char>(usual[n]) - static_cast<unsigned char>(near[n])));
    EXPECT_LE(most, 1) << "half a thousandth of a degree from it";
}

// A ground as small as this is thin beside its samples, and what lies behind shines through: grey, on both
// colours.
TEST_F(TerrainOptions, AMediumHasTheColourOfThePlace) {
    const std::vector<std::string> medium{"--image", photo(),    "--medium",     "ground",
                                          "--model", "emission", "--light-size", "16"};
    const std::string picture = bytes(hills(), medium);
    const std::string surface = bytes(hills(), {"--image", photo()});
    for (int y = 6; y < 30; y += 4)
        for (const int x : {10, 14, 18, 29, 33, 37}) {
            const bool west = x < 24;
            const std::array<int, 3> hard = pixel(surface, x, y), soft = pixel(picture, x, y);
            EXPECT_NEAR(hard[0], west ? 255 : 0, 2) << x << " " << y;
            EXPECT_NEAR(hard[1], west ? 0 : 255, 2) << x << " " << y;
            EXPECT_GT((soft[0] - soft[1]) * (west ? 1 : -1), 20) << x << " " << y;
        }
}

TEST_F(TerrainOptions, WhatHasNoEffectIsRefused) {
    const std::string ground = hills(), picture = photo();
    refused("terrain", {"--open-holes"}, {"--open-holes", "no holes"});
    refused(ground, {"--shade-image"}, {"--shade-image", "--image"});
    refused(ground, {"--image", picture, "--shade-image", "--medium", "ground"}, {"--shade-image", "medium"});
    refused(ground, {"--image", picture, "--medium", "snow"}, {"--image", "--medium ground"});
    refused(ground, {"--medium", "ground", "--shading-width", "2"}, {"--shading-width"});
    refused(ground, {"--medium", "ground", "--sun", "90,10", "--light-from", "90,10"},
            {"--sun", "--light-from"});
    refused(ground, {"--medium", "ground", "--sun", "90,10", "--lamp", "head"}, {"--sun", "--lamp"});
    expectRefused({"render", "colon", "--shade-image", "--out", "a.png"}, {"--shade-image", "study"});
}

}  // namespace
}  // namespace stereonav::test
