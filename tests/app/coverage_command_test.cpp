// `stereonav coverage` as a user runs it.
#include <nlohmann/json.hpp>

#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

using CoverageCommand = VolumeTest;
using Json = nlohmann::json;

TEST_F(CoverageCommand, TellsPercentsAndPatches) {
    const std::string mask = maskedTube();
    const Outcome outcome =
        run({"coverage", mask, "--no-cache", "--fov", "90", "--patch", "5", "--json", "--out", "a.csv"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json json = Json::parse(outcome.out);
    const double one = json.at("one_way_percent"), two = json.at("two_way_percent"),
                 after = json.at("after_patches_percent");
    EXPECT_GT(one, 30);
    EXPECT_GE(two, one);
    EXPECT_GE(after, two);
    EXPECT_LE(after, 100.0001);
    double last = 1e9;
    for (const Json& patch : json.at("patches")) {
        EXPECT_GE(patch.at("area_mm2"), 5);
        EXPECT_LE(patch.at("area_mm2"), last);
        last = patch.at("area_mm2");
        EXPECT_EQ(patch.at("place_mm").size(), 3u);
        EXPECT_GE(patch.at("along_mm"), 0);
    }
    EXPECT_EQ(linesIn(contentOf(place() / "a.csv")), 1 + static_cast<int>(json.at("patches").size()));
}

TEST_F(CoverageCommand, WiderViewsShowMore) {
    const std::string mask = maskedTube();
    double before = 0;
    for (const char* fov : {"60", "90", "140"}) {
        const Json json = Json::parse(run({"coverage", mask, "--no-cache", "--fov", fov, "--json"}).out);
        EXPECT_GT(json.at("one_way_percent"), before) << fov;
        before = json.at("one_way_percent");
    }
}

TEST_F(CoverageCommand, BadInputGivesOneLine) {
    const std::string mask = maskedTube();
    expectRefused({"coverage"}, {"expected a CT study", "built-in terrain"});
    expectRefused({"coverage", "cloud"}, {"cloud", "expected a CT study"});
    expectRefused({"coverage", hills()}, {"hills.asc", "expected a CT study"});
    expectRefused({"coverage", mask, "--out", "a.txt"}, {"--out", ".csv"});
    expectRefused({"coverage", mask, "--fov", "200"}, {"--fov", "170"});
    expectRefused({"coverage", mask, "--angle", "91"}, {"--angle", "90"});
    expectRefused({"coverage", mask, "--within", "0"}, {"--within"});
    expectRefused({"coverage", mask, "--step", "0"}, {"--step"});
    expectRefused({"coverage", mask, "--no-cache", "--path", "none.gltf"}, {"none.gltf"});
    expectRefused({"coverage", ball(), "--no-cache"}, {"ball.nrrd", "no colon was found"});
}

}  // namespace
}  // namespace stereonav::test
