// `report` as a user runs it: what it leaves, what it refuses, what stopping it leaves. With hardly any time
// given, so that each part measures no more than it must.
#include <csignal>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/app/volume_input.h"
#include "tests/support/xml_check.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

class Report : public VolumeTest {
protected:
    Outcome report(std::vector<std::string> more) const {
        std::vector<std::string> arguments{"report", "--quick", "--minutes", "0.01"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    std::set<std::string> left() const {
        std::set<std::string> names;
        for (const auto& entry : fs::recursive_directory_iterator(place()))
            if (entry.is_regular_file()) names.insert(fs::relative(entry.path(), place()).string());
        return names;
    }
};

TEST_F(Report, LeavesAPageAndItsFigures) {
    const Outcome outcome = report({"--parts", "right-eye,felt,stability", "--out", "page"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(left(), (std::set<std::string>{"page/index.html", "page/report.csv", "page/report.json"}));
    const std::string page = contentOf(place() / "page/index.html");
    EXPECT_EQ(xmlProblem(page), "");
    for (const char* words :
         {"Right eye, terrain", "Right eye, colon", "Flicker, terrain", "Rivalry of the eyes, colon",
          "Butteraugli, colon, translucent", "What would be noticed, terrain",
          "Right eye, colon, translucent", "On the Pareto front", "The default, linear",
          "The default, selective", "data:image/png;base64,", "<svg"})
        EXPECT_NE(page.find(words), std::string::npos) << words;

    const Json json = Json::parse(contentOf(place() / "page/report.json"));
    std::set<std::string> ids;
    for (const Json& figure : json.at("figures")) {
        EXPECT_TRUE(ids.insert(figure.at("id").get<std::string>()).second) << figure.at("id");
        EXPECT_LE(figure.at("low").get<double>(), figure.at("median").get<double>()) << figure.at("id");
        EXPECT_LE(figure.at("median").get<double>(), figure.at("high").get<double>()) << figure.at("id");
        EXPECT_GE(figure.at("low").get<double>(), 0) << figure.at("id");
    }
    for (const char* id : {"right_eye/terrain/linear/time", "right_eye/colon/full/error", "machine/mood/time",
                           "flicker/terrain/linear/error", "flicker/terrain/linear/left eye's",
                           "rivalry/colon/full/error", "butteraugli/colon translucent/selective/time"})
        EXPECT_TRUE(ids.contains(id)) << id;
    for (const char* fact :
         {"commit", "compiler", "libraries", "processor", "threads", "load at the start", "date", "seed"})
        EXPECT_FALSE(json.at("machine").at(fact).get<std::string>().empty()) << fact;
    EXPECT_EQ(linesIn(contentOf(place() / "page/report.csv")), static_cast<long>(ids.size()) + 1);
}

TEST_F(Report, ChartsTheDialSmallerPicturesAndFilters) {
    ASSERT_EQ(report({"--parts", "quality,casting"}).status, 0);
    const Json json = Json::parse(contentOf(place() / "report/report.json"));
    std::map<std::string, double> of;
    for (const Json& figure : json.at("figures")) of[figure.at("id")] = figure.at("median");
    for (const std::string scene : {"terrain", "colon", "colon translucent"}) {
        EXPECT_EQ(of.at("quality/" + scene + "/full/error"), 0) << scene;
        EXPECT_GT(of.at("quality/" + scene + "/50 dB/bound dB"), 50) << scene;
        // 50 dB are 0.81 levels
        EXPECT_LT(of.at("quality/" + scene + "/50 dB/error"), 0.81) << scene;
        EXPECT_GT(of.at("resolution/" + scene + "/0.5/error"), of.at("resolution/" + scene + "/1/error"))
            << scene;
        const double jagged = of.at("edges/" + scene + "/edges 0/error");
        const double smooth = of.at("edges/" + scene + "/edges 4/error");
        if (scene == "colon translucent")  // whose edges are soft
            EXPECT_LE(smooth, jagged) << scene;
        else
            EXPECT_LT(smooth, 0.7 * jagged) << scene;
    }
    EXPECT_GT(of.at("filtering/terrain/bilinear alone/error"),
              of.at("filtering/terrain/bilinear, 4 rays/error"));
    EXPECT_EQ(of.at("casting/normals/at the place/error"), 0) << "what the others are held against";
    EXPECT_GT(of.at("casting/normals/corners/error"), 0);
    EXPECT_LT(of.at("casting/normals/corners/error"), of.at("casting/normals/nearest corner/error"));
}

TEST_F(Report, HasAScenesOwnChartAndAFullCastWithoutError) {
    const std::string scene =
        input("flat.asc", "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 30\n1 2 3\n2 3 4\n3 4 9\n");
    const Outcome outcome =
        report({"--parts", "right-eye", "--scene", scene, "--curvature", "--refraction", "0.25"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json json = Json::parse(contentOf(place() / "report/report.json"));
    int found = 0;
    for (const Json& figure : json.at("figures")) {
        const std::string id = figure.at("id");
        if (!id.starts_with("right_eye/") || !id.ends_with("/full/error")) continue;
        EXPECT_EQ(figure.at("median"), 0.0) << id;
        found += id == "right_eye/flat.asc/full/error";
        const std::string setting = figure.at("setting");
        EXPECT_EQ(setting.find("refraction 0.25") != std::string::npos, !id.starts_with("right_eye/colon"))
            << id << " " << setting;
    }
    EXPECT_EQ(found, 1);
    EXPECT_EQ(json.at("machine").at("round Earth"), "refraction 0.25");
}

// Scenes that are named, built in, files or scene files: a medium with all its ways to two eyes, each of them
// once. A scene file is what its first lines name, as its options say.
TEST_F(Report, MeasuresNamedScenesOnceAndFollowsSceneFiles) {
    ball();
    const std::string study =
        input("study.toml", "scene = \"ball.nrrd\"\n[options]\nisosurface = true\nisovalue = 700\n");
    const std::string medium = input("medium.toml", "scene = \"wax\"\n[options]\nslices = 40\n");
    const Outcome outcome =
        report({"--parts", "volume-light,left-out", "--scene", "wax", "--scene", "terrain", "--scene", "wax",
                "--scene", study, "--scene", medium, "--up", "-z"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    std::set<std::string> ids;
    const Json json = Json::parse(contentOf(place() / "report/report.json"));
    for (const Json& figure : json.at("figures")) ids.insert(figure.at("id").get<std::string>());
    for (const char* id :
         {"pair/wax/sweep/time", "pair/wax/own-samples/error", "pair/wax/two-sweeps/error",
          "pair/wax/depthsplat/error", "flicker/wax/sweep/error", "rivalry/wax/depthsplat/error",
          "butteraugli/wax/two-sweeps/error", "pair-separation/wax/1/8/error", "scene/terrain/loading",
          "medium/wax/shading width/0/error", "medium/wax/shading width/1/time", "scene/study.toml/loading",
          "pair/medium.toml/sweep/time"})
        EXPECT_TRUE(ids.contains(id)) << id;
    for (const Json& figure : json.at("figures")) {
        if (figure.at("id") == "medium/wax/shading width/0/error") {
            EXPECT_EQ(figure.at("median"), 0.0) << "shaded at each sample";
        }
    }
    EXPECT_FALSE(ids.contains("scene/terrain 2/loading"));
    EXPECT_FALSE(ids.contains("pair/wax 2/sweep/time"));
    const std::string page = contentOf(place() / "report/index.html");
    for (const char* words : {"a surface, from outside", "surface at 700", "what points to -z is up"})
        EXPECT_NE(page.find(words), std::string::npos) << words;
}

// Errors do not depend on the machine: more paths, more texels and the program's lookup are nearer to the
// truth.
TEST_F(Report, HoldsBakedLightAgainstPathsFromEveryPixel) {
    const Outcome outcome = report({"--parts", "light"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    std::map<std::string, double> of;
    const Json json = Json::parse(contentOf(place() / "report/report.json"));
    for (const Json& figure : json.at("figures"))
        of[figure.at("id").get<std::string>()] = figure.at("median").get<double>();
    const auto expectFalling = [&](const std::string& chart, const std::vector<std::string>& ways) {
        for (std::size_t n = 0; n + 1 < ways.size(); ++n) {
            const std::string worse = chart + ways[n] + "/error", better = chart + ways[n + 1] + "/error";
            ASSERT_TRUE(of.contains(worse) && of.contains(better)) << worse << " " << better;
            EXPECT_GT(of[worse], of[better]) << worse;
            EXPECT_GT(of[better], 0) << better;
        }
    };
    expectFalling("light/pixels/", {"traced 1", "traced 4", "traced 16", "traced 64"});
    expectFalling("light/pixels/", {"baked 16", "baked 64", "baked 256"});
    expectFalling("light/terrain/", {"stride 4", "as it is"});
    expectFalling("light/terrain/", {"bounces 0", "as it is"});
    expectFalling("light/pixels/", {"transfer 256", "baked 1/8", "baked 256", "baked 8"});
    expectFalling("light/lookup/", {"nearest", "tricubic", "trilinear"});
    expectFalling("light/lookup/", {"nearest isovalue", "trilinear", "trilinear, 8"});
    const std::string page = contentOf(place() / "report/index.html");
    EXPECT_EQ(xmlProblem(page), "");
    for (const char* words :
         {"Path tracing", "Lookup of baked light", "The default, baked 256", "The default, trilinear"})
        EXPECT_NE(page.find(words), std::string::npos) << words;
}

TEST_F(Report, ReadsRowsOfStability) {
    const std::string rows =
        input("rows.jsonl",
              "{\"id\": \"a/1\", \"case\": \"a case\", \"quantity\": \"error\", \"worst\": 0.5, "
              "\"bound\": 1, \"unit\": \"m\", \"pass\": true}\n"
              "{\"id\": \"a/2\", \"case\": \"another <case>\", \"quantity\": \"error\", \"worst\": null, "
              "\"bound\": 1, \"unit\": \"m\", \"pass\": false}\n");
    ASSERT_EQ(report({"--parts", "stability", "--stability", rows}).status, 0);
    const std::string page = contentOf(place() / "report/index.html");
    EXPECT_EQ(xmlProblem(page), "");
    for (const char* words : {"2 rows", "1 FAIL", "a case", "another &lt;case&gt;"})
        EXPECT_NE(page.find(words), std::string::npos) << words;
}

TEST_F(Report, SaysInOneLineWhatIsWrong) {
    const std::string text = input("text.json", "no json"), row = input("row.jsonl", "\n{\"id\": 1}\n");
    const std::pair<std::vector<std::string>, std::string> cases[] = {
        {{"--compare", text}, "text.json"},
        {{"--compare", "/nowhere/old.json"}, "/nowhere/old.json"},
        {{"--parts", "nonsense"}, "there is no part \"nonsense\""},
        {{"--parts", "light", "--curvature"}, "none of these parts shows ground"},
        {{"--scene", "/nowhere/scene.tif"}, "/nowhere/scene.tif"},
        {{"--parts", "stability", "--stability", row}, "row.jsonl:2"},
        {{"--out", "/proc/nowhere"}, "--out"},
    };
    for (const auto& [arguments, words] : cases) {
        const Outcome outcome = report(arguments);
        EXPECT_EQ(outcome.status, 1) << words;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
        EXPECT_EQ(linesIn(outcome.err), 1) << outcome.err;
        EXPECT_TRUE(left().empty()) << *left().begin();
    }
}

TEST_F(Report, LeavesNothingWhenItIsStopped) {
    const pid_t child = start({"report", "--out", "page"});
    awaitWork(child, 1);
    kill(child, SIGINT);
    const Outcome outcome = awaitStopped(child);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("stopped"), std::string::npos) << outcome.err;
    EXPECT_TRUE(left().empty()) << *left().begin();
}

// Neither a terrain nor a volume: what only these have is left out.
TEST_F(Report, OfAMeshHasAllThatItCanHave) {
    const std::string mesh = (mFolder / "hills.glb").string();
    ASSERT_EQ(run({"mesh", hills(), "--out", mesh}).status, 0);
    const Outcome outcome = report({"--parts", "left-out,casting,plan", "--scene", mesh, "--out", "page"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const std::string page = contentOf(place() / "page/index.html");
    for (const char* words : {"hills.glb", "triangles", "Warp or cast"})
        EXPECT_NE(page.find(words), std::string::npos) << words;
}

}  // namespace
}  // namespace stereonav::test
