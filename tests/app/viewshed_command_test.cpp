// `stereonav viewshed` as a user runs it.
#include <cmath>
#include <nlohmann/json.hpp>

#include "terrain/read/dem_reader.h"
#include "tests/app/program.h"

namespace stereonav::test {
namespace {

using ViewshedCommand = ProgramTest;
using Json = nlohmann::json;

// A wall of 50 m in column 20. Sample (i, j from the north) lies at (10 i + 5, 295 - 10 j).
int wallAt(int i, int) {
    return i == 20 ? 50 : 0;
}

TEST_F(ViewshedCommand, WritesWhatIsSeenWhereItIs) {
    const std::string dem = grid("wall.asc", 40, 30, 10, wallAt);
    const Outcome outcome = run({"viewshed", dem, "--from", "55,145,20", "--out", "shed.tif", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json json = Json::parse(outcome.out);
    // All in front of the wall, and the wall itself, which is higher than the eye.
    EXPECT_EQ(json["seen_samples"], 21 * 30);
    EXPECT_EQ(json["samples"], 40 * 30);
    EXPECT_NEAR(json["seen_percent"].get<double>(), 100.0 * 21 / 40, 1e-9);
    EXPECT_NEAR(json["seen_m2"].get<double>(), 21 * 30 * 100.0, 1e-6);
    Progress progress;
    const DemGrid read = readDem(place() / "shed.tif", 1, progress);
    ASSERT_EQ(read.width, 40);
    ASSERT_EQ(read.height, 30);
    EXPECT_EQ(read.spacing, glm::dvec2(10));
    EXPECT_EQ(read.sourceOffset, glm::dvec2(200, 150));
    for (int j = 0; j < 30; ++j)
        for (int i = 0; i < 40; ++i)
            ASSERT_EQ(read.heights[static_cast<std::size_t>(j * 40 + i)], i <= 20 ? 255 : 0) << i << " " << j;
}

TEST_F(ViewshedCommand, TwoPlacesAndTheWallBetween) {
    const std::string dem = grid("wall.asc", 40, 30, 10, wallAt);
    const auto sight = [&](const std::string& from, const std::string& to) {
        const Outcome outcome = run({"viewshed", dem, "--from", from, "--to", to, "--json"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return Json::parse(outcome.out);
    };
    // The wall stands at 205; from 20 m at 105 to 100 m at 305 the line is 60 m high there.
    const Json over = sight("105,145,20", "305,145,100"), under = sight("105,145,20", "305,145,60");
    EXPECT_TRUE(over["sees"]);
    EXPECT_NEAR(over["clearance_m"].get<double>(), 10, 1e-9);
    EXPECT_NEAR(over["clearance_at_m"].get<double>(), 100, 1e-9);
    EXPECT_NEAR(over["distance_m"].get<double>(), 200, 1e-9);
    EXPECT_FALSE(under["sees"]);
    EXPECT_NEAR(under["clearance_m"].get<double>(), -10, 1e-9);
    EXPECT_EQ(sight("305,145,60", "105,145,20")["clearance_m"], under["clearance_m"]);
    EXPECT_TRUE(std::filesystem::is_empty(place()));
}

// 80 km of sea: the horizon of an eye at 100 m is at 38.3 km with air, and all is seen without curvature.
TEST_F(ViewshedCommand, CurvatureAndRefractionAreOptions) {
    const std::string sea = grid("sea.asc", 81, 3, 1000, [](int, int) { return 0; });
    const auto seen = [&](std::vector<std::string> more) {
        std::vector<std::string> words{"viewshed", sea, "--from", "500,1500,100", "--out", "s.tif", "--json"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return Json::parse(outcome.out)["seen_samples"].get<int>();
    };
    const auto horizon = [](double refraction) {
        return static_cast<int>(std::sqrt(2 * 6371008.8 * 100 / (1 - refraction)) / 1000);
    };
    EXPECT_EQ(seen({}), 3 * 81);
    EXPECT_EQ(seen({"--curvature"}), 3 * (horizon(0.13) + 1));
    EXPECT_EQ(seen({"--curvature", "--refraction", "0"}), 3 * (horizon(0) + 1));
    EXPECT_GT(horizon(0.13), horizon(0));
    EXPECT_EQ(seen({"--reach", "10500"}), 3 * 11);
}

TEST_F(ViewshedCommand, BadOptionsGiveOneLineAndNoFile) {
    const std::string dem = hills();
    expectRefused({"viewshed", dem, "--from", "5000,100", "--out", "s.tif"},
                  {"--from", "5000", "on the ground"});
    expectRefused({"viewshed", dem, "--from", "100,100", "--to", "-9,3"}, {"--to", "-9"});
    expectRefused({"viewshed", dem, "--from", "100,100"}, {"--out", "--to"});
    expectRefused({"viewshed", dem, "--from", "100", "--out", "s.tif"}, {"--from", "\"100\""});
    expectRefused({"viewshed", dem, "--from", "100,100,-1", "--out", "s.tif"}, {"--from", "-1"});
    expectRefused({"viewshed", dem, "--out", "s.tif"}, {"--from"});
    expectRefused({"viewshed", dem, "--from", "100,100", "--out", "s.png"}, {"--out", ".tif"});
    expectRefused({"viewshed", dem, "--from", "100,100", "--out", "s.tif", "--refraction", "0.2"},
                  {"--refraction", "--curvature"});
    expectRefused(
        {"viewshed", dem, "--from", "100,100", "--out", "s.tif", "--curvature", "--refraction", "1"},
        {"--refraction"});
    expectRefused({"viewshed", "colon", "--from", "1,1", "--out", "s.tif"}, {"colon", "terrain"});
    expectRefused({"viewshed", "nowhere.tif", "--from", "1,1", "--out", "s.tif"}, {"nowhere.tif"});
}

}  // namespace
}  // namespace stereonav::test
