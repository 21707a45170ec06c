// What is guessed of ground is told: one line on standard error, in `info` and in documents; and the inputs
// that are read with such a word.
#include <nlohmann/json.hpp>

#include "tests/app/program.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;

class TerrainNotes : public ProgramTest {
protected:
    // Heights of 1000 m and more, and counts of scenes of the same place.
    std::string folder() {
        const std::filesystem::path parts = mFolder / "parts";
        std::filesystem::create_directory(parts);
        grid("parts/N46E007_dem.asc", 32, 24, 30, [](int i, int j) { return 1000 + 9 * i + 4 * j; });
        grid("parts/N46E007_num.asc", 32, 24, 30, [](int i, int j) { return 5 + (i * 7 + j * 3) % 20; });
        return parts.string();
    }
};

TEST_F(TerrainNotes, AreOneLineEachWhereNothingIsQuiet) {
    const std::string parts = folder();
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"info", parts},
          {"render", parts, "--out", "a.png", "--size", "32x24"},
          {"play", parts, "--hash", "--size", "32x24", "--frames", "2"},
          {"mesh", parts, "--out", "m.glb"},
          {"measure", parts, "--line", "100,100,700,500"},
          {"profile", parts, "--line", "100,100,700,500"},
          {"viewshed", parts, "--from", "300,300", "--out", "s.tif"}}) {
        Outcome outcome = run(words);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(linesIn(outcome.err), 1) << words[0] << ": " << outcome.err;
        EXPECT_EQ(outcome.err.rfind("stereonav: " + parts + ": left aside", 0), 0u) << outcome.err;
        EXPECT_NE(outcome.err.find("N46E007_num.asc"), std::string::npos) << outcome.err;
        std::vector<std::string> quiet = words;
        quiet.push_back("--quiet");
        outcome = run(quiet);
        EXPECT_EQ(outcome.status, 0);
        EXPECT_EQ(outcome.err, "") << words[0];
    }
    const Json terrain = Json::parse(run({"info", parts, "--look", "plain", "--json"}).out).at("terrain");
    ASSERT_EQ(terrain.at("notes").size(), 1u);
    EXPECT_EQ(terrain.at("height_range_m"), Json::array({1000.0, 1000.0 + 9 * 31 + 4 * 23}));
    EXPECT_NE(run({"info", parts}).out.find("left aside"), std::string::npos);
}

// Both segments and the straight way between; drawn are the segments alone.
TEST_F(TerrainNotes, ATrackOfTwoSegmentsIsFollowed) {
    const std::string dem = grid("level.asc", 60, 40, 10, [](int, int) { return 50; });
    const std::string inner =
        R"(<trkseg/><trkseg><trkpt lat="0" lon="-200"/><trkpt lat="0" lon="-100"/></trkseg>
<trkseg><trkpt lat="7" lon="7"/></trkseg><trkseg><trkpt lat="0" lon="50"/><trkpt lat="0" lon="150"/></trkseg>)";
    const std::string track =
        input("two.gpx", R"(<gpx version="1.1" creator="t" xmlns="http://www.topografix.com/GPX/1/1"><trk>)" +
                             inner + "</trk></gpx>");
    // Without a place on the Earth degrees are metres from its middle.
    const Json profile = Json::parse(run({"profile", dem, "--track", track, "--json"}).out);
    EXPECT_NEAR(profile["plan_m"].get<double>(), 350, 1e-6);
    const Json measured = Json::parse(run({"measure", dem, "--track", track, "--json"}).out);
    EXPECT_EQ(measured["measures"].size(), 1u);
    const Outcome followed =
        run({"play", dem, "--follow", track, "--hash", "--size", "32x24", "--frames", "2"});
    EXPECT_EQ(followed.status, 0) << followed.err;
    const Outcome drawn = run({"render", dem, "--tracks", track, "--out", "a.png", "--size", "64x48"});
    EXPECT_EQ(drawn.status, 0) << drawn.err;
    EXPECT_NE(run({"info", dem}).out, "");
}

}  // namespace
}  // namespace stereonav::test
