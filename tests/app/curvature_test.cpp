// `--curvature` through the real program: the sea's horizon in a picture, each command that has the option,
// and what is refused.
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/app/program.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;

class Curvature : public ProgramTest {
protected:
    void SetUp() override {
        ProgramTest::SetUp();
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
    }

    // 400 km of sea.
    std::string sea() const {
        return grid("sea.asc", 41, 41, 10000, [](int, int) { return 0; });
    }
    // Returns how many rows show the sea in a picture of 8x120 pixels and 5 degrees that looks level to the
    // north from 1000 m.
    int rowsOfSea(std::vector<std::string> options) const {
        const std::string file = (mFolder / "sea.bmp").string();
        options.insert(options.begin(), {"render", sea(), "--out", file, "--size", "8x120", "--mode", "ml",
                                         "--fov", "5", "--pose", "0,-190000,1000,0,0,0"});
        const Outcome outcome = run(options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        const std::string bmp = contentOf(file);
        const auto byte = [&](std::size_t n) {
            return static_cast<int>(static_cast<unsigned char>(bmp.at(n)));
        };
        const std::size_t first = static_cast<std::size_t>(byte(10) + 256 * byte(11));
        const auto at = [&](int row) { return first + static_cast<std::size_t>(row) * 24 + 12; };
        // From the bottom up: the horizon is where colours change most.
        int horizon = 0, most = 0;
        for (int row = 1; row < 120; ++row) {
            int change = 0;
            for (std::size_t c = 0; c < 3; ++c) change += std::abs(byte(at(row) + c) - byte(at(row - 1) + c));
            if (change > most) most = change, horizon = row;
        }
        return horizon;
    }
};

// The dip is 2 sqrt(fall h); on a level Earth the ground ends at 390 km, 0.15 degrees below level.
TEST_F(Curvature, TheSeaEndsWhereItsHorizonIs) {
    const auto rows = [](double dip) {
        const double half = std::tan(2.5 * std::numbers::pi / 180);
        return 60 * (1 - std::tan(dip) / half);
    };
    const double fall = 1 / (2 * 6371008.8);
    EXPECT_NEAR(rowsOfSea({}), rows(1000 / 390e3), 1.01);
    EXPECT_NEAR(rowsOfSea({"--curvature"}), rows(2 * std::sqrt(0.87 * fall * 1000)), 1.01);
    EXPECT_NEAR(rowsOfSea({"--curvature", "--refraction", "0"}), rows(2 * std::sqrt(fall * 1000)), 1.01);
    // Heights drawn four times as large sink four times as much.
    EXPECT_NEAR(rowsOfSea({"--curvature", "--vertical-scale", "4"}),
                rows(2 * std::sqrt(4 * 0.87 * fall * 1000)), 1.01);
    EXPECT_GT(rowsOfSea({}) - rowsOfSea({"--curvature"}), 15);
}

TEST_F(Curvature, EveryCommandThatHasItShowsIt) {
    const std::string dem =
        grid("far.asc", 60, 60, 2000, [](int i, int j) { return 300 + (i * 37 + j * 91) % 250; });
    const auto hash = [&](std::vector<std::string> more) {
        std::vector<std::string> words{"play", dem, "--frames", "2", "--size", "48x32", "--hash"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.out.substr(outcome.out.find("hash"));  // after the times
    };
    EXPECT_NE(hash({}), hash({"--curvature"}));
    EXPECT_NE(hash({"--curvature", "--refraction", "0"}), hash({"--curvature"}));
    EXPECT_NE(hash({"--level-of-detail", "1"}), hash({"--level-of-detail", "1", "--curvature"}));
    EXPECT_EQ(hash({"--curvature", "--threads", "1"}), hash({"--curvature"}));
    // The right eye is made of the left one as well as on a level Earth.
    const Outcome compared = run({"compare", dem, "--curvature", "--frames", "1", "--size", "100x80",
                                  "--methods", "linear", "--json", "-", "--quiet"});
    ASSERT_EQ(compared.status, 0) << compared.err;
    EXPECT_NE(compared.out.find("psnr"), std::string::npos);
    EXPECT_EQ(Json::parse(compared.out).at("curvature").at("refraction"), 0.13);
}

TEST_F(Curvature, IsNamedByWhatUsesIt) {
    const std::string dem = hills();
    const auto factsOf = [&](std::vector<std::string> words) {
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return Json::parse(outcome.out);
    };
    const std::vector<std::string> render{"render", dem, "--out", "a.png", "--size", "16x12", "--json"},
        play{"play", dem, "--frames", "1", "--size", "16x12", "--hash", "--json"},
        info{"info", dem, "--json"};
    for (const std::vector<std::string>& level : {render, play, info}) {
        std::vector<std::string> round = level;
        round.insert(round.end(), {"--curvature", "--refraction", "0.2"});
        const bool inTerrain = level.front() == "info";
        const Json before = factsOf(level), after = factsOf(round);
        const Json& facts = inTerrain ? after.at("terrain") : after;
        EXPECT_FALSE((inTerrain ? before.at("terrain") : before).contains("curvature")) << level.front();
        ASSERT_TRUE(facts.contains("curvature")) << level.front();
        EXPECT_EQ(facts.at("curvature").at("refraction"), 0.2);
        EXPECT_EQ(facts.at("curvature").at("radius_m"), 6371008.8);
    }
}

TEST_F(Curvature, WhatDoesNotKnowOfItIsRefused) {
    const std::string dem = hills();
    const auto refused = [&](std::vector<std::string> words, const std::vector<std::string>& said) {
        words.insert(words.end(), {"--size", "32x24"});
        expectRefused(words, said);
    };
    refused({"render", dem, "--out", "a.png", "--refraction", "0.2"}, {"--refraction", "--curvature"});
    for (const char* share : {"1", "1.5", "-0.1", "nan"})
        refused({"render", dem, "--out", "a.png", "--curvature", "--refraction", share},
                {"--refraction", share});
    refused({"render", dem, "--out", "a.png", "--curvature", "--medium", "ground"}, {"--curvature"});
    refused({"render", "colon", "--out", "a.png", "--curvature"}, {"--curvature", "terrain"});
    input("mark.glb", "");
    const std::string scene = input(
        "s.toml", "[terrain]\ndem = \"hills.asc\"\n[[landmark]]\nmesh = \"mark.glb\"\nposition_m = [0, 0]\n");
    refused({"render", scene, "--out", "a.png", "--curvature"}, {"--curvature", "landmarks"});
    expectRefused({"bake", dem, "--out", "b.snl", "--curvature"}, {"--curvature"});
}

}  // namespace
}  // namespace stereonav::test
