// What is painted on the ground, as a user asks for it.
#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "engine/base/file.h"
#include "tests/app/program.h"

namespace stereonav::test {
namespace {

class GroundPaintOptionsTest : public ProgramTest {
protected:
    // One hill in the middle.
    std::string hilly() {
        return grid("hills.asc", 60, 50, 10, [](int i, int j) {
            return std::max(0, 120 - ((i - 30) * (i - 30) + (j - 25) * (j - 25)) / 4);
        });
    }
    // The picture that `words` make of the ground.
    std::string picture(const std::string& dem, std::vector<std::string> words) {
        std::vector<std::string> line{"render", dem,      "--size", "160x90", "--pose", "600,0,300,-90,-25,0",
                                      "--out",  "out.png"};
        line.insert(line.end(), words.begin(), words.end());
        const Outcome outcome = run(line);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        mSaid = outcome.out + outcome.err;
        std::ifstream file(place() / "out.png", std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    std::string mSaid;
};

TEST_F(GroundPaintOptionsTest, ChangePicturesAndNoneLeavesThemAsTheyAre) {
    const std::string dem = hilly(), plain = picture(dem, {});
    EXPECT_EQ(picture(dem, {"--contours", "0"}), plain);
    std::set<std::string> pictures{plain};
    writeTextFile(place() / "walk.geojson",
                  R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"name":"a"},
"geometry":{"type":"LineString","coordinates":[[-250,-200],[0,0],[250,200]]}},
{"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[20,40]}}]})");
    const std::vector<std::vector<std::string>> all{{"--contours", "7"},
                                                    {"--contours", "auto"},
                                                    {"--paint", "slope"},
                                                    {"--paint", "aspect"},
                                                    {"--paint", "hillshade"},
                                                    {"--paint", "natural", "--look", "plain"},
                                                    {"--paint", "hypsometric"},
                                                    {"--paint", "swiss"},
                                                    {"--paint", "grey"},
                                                    {"--paint", "viewshed:50,50,2"},
                                                    {"--tracks", (place() / "walk.geojson").string()},
                                                    {"--tracks", (place() / "walk.geojson").string(),
                                                     "--contours", "10", "--paint", "slope", "--edges", "0"}};
    for (const auto& words : all) EXPECT_TRUE(pictures.insert(picture(dem, words)).second) << words[1];
}

TEST_F(GroundPaintOptionsTest, RefuseWhatDoesNotGo) {
    const std::string dem = hilly();
    const auto refused = [&](std::vector<std::string> words, const std::string& part) {
        std::vector<std::string> line{"render", dem, "--size", "64x48", "--out", "out.png"};
        line.insert(line.end(), words.begin(), words.end());
        const Outcome outcome = run(line);
        EXPECT_EQ(outcome.status, 1) << words[1];
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_FALSE(std::filesystem::exists(place() / "out.png"));
    };
    refused({"--contours", "-1"}, "--contours: expected auto or metres");
    refused({"--contours", "many"}, "--contours: expected auto or metres");
    refused({"--paint", "slopes"},
            "--paint: expected one of slope, aspect, hillshade, natural, hypsometric, swiss, grey, "
            "viewshed:X,Y,HEIGHT, hours:DATE");
    refused({"--paint", "slope:3"}, "--paint: expected one of");
    refused({"--paint", "viewshed:3"}, "viewshed expects a place");
    refused({"--paint", "viewshed:99999,3"}, "--paint: expected a place on the ground");
    refused({"--paint", "hours:soon"}, "hours expects a date");
    refused({"--paint", "hours:2026-06-21"}, "does not say where it lies on the Earth");
    refused({"--paint", "slope", "--image", "some.png"}, "slope does not go with --image");
    refused({"--paint", "swiss", "--image", "some.png"}, "swiss does not go with --image");
    refused({"--tracks", "none.gpx"}, "none.gpx");
    writeTextFile(place() / "far.geojson", R"({"type":"LineString","coordinates":[[9250,200],[9000,0]]})");
    refused({"--tracks", (place() / "far.geojson").string()}, "all of it lies outside the ground");
    writeTextFile(place() / "one.gpx",
                  R"(<gpx version="1.1" creator="t" xmlns="http://www.topografix.com/GPX/1/1">
<trk><trkseg><trkpt lat="1" lon="1"/></trkseg></trk></gpx>)");
    refused({"--tracks", (place() / "one.gpx").string()}, "no line of it has 2 places that differ");
    writeTextFile(place() / "empty.geojson", R"({"type":"FeatureCollection","features":[]})");
    refused({"--tracks", (place() / "empty.geojson").string()}, "expected tracks, lines, areas or places");
}

TEST_F(GroundPaintOptionsTest, TellWhatLiesOutside) {
    const std::string dem = hilly();
    writeTextFile(place() / "out.geojson", R"({"type":"LineString","coordinates":[[-100,0],[1000,0]]})");
    picture(dem, {"--tracks", (place() / "out.geojson").string()});
    EXPECT_NE(mSaid.find("lie outside the ground and are not drawn"), std::string::npos) << mSaid;
}

TEST_F(GroundPaintOptionsTest, FollowATrack) {
    const std::string dem = hilly();
    writeTextFile(place() / "walk.geojson",
                  R"({"type":"LineString","coordinates":[[-200,-150],[0,50],[200,150]]})");
    const auto hash = [&](std::vector<std::string> words) {
        std::vector<std::string> line{"play", dem, "--size", "64x48", "--hash", "--frames", "3"};
        line.insert(line.end(), words.begin(), words.end());
        const Outcome outcome = run(line);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.out.substr(outcome.out.find("hash "));
    };
    const std::string file = (place() / "walk.geojson").string();
    const std::set<std::string> hashes{hash({}), hash({"--follow", file}),
                                       hash({"--follow", file, "--follow-height", "120"}),
                                       hash({"--follow", file, "--tracks", file})};
    EXPECT_EQ(hashes.size(), 4u);
    EXPECT_EQ(hash({"--follow", file, "--follow-height", "50"}), hash({"--follow", file}));
    const Outcome alone = run({"play", dem, "--hash", "--follow-height", "20"});
    EXPECT_NE(alone.err.find("needs --follow"), std::string::npos) << alone.err;
}

}  // namespace
}  // namespace stereonav::test
