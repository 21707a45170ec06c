// Names of files, tags, comments and names in files, as a stranger may choose them, in every command: what is
// printed is text (ECMA-48 sequences do nothing), documents can be read, and tables start no formula.
#include "tests/app/foreign_words.h"

#include <nlohmann/json.hpp>

#include "../support/dicom_files.h"
#include "engine/base/file.h"
#include "tests/app/small_runs.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;

class ForeignWords : public SmallRuns {
protected:
    std::string named(const std::string& name) const { return (mFolder / (kForeignWords + name)).string(); }
    std::string renamed(const std::string& file, const std::string& name) const {
        std::filesystem::copy(file, named(name), std::filesystem::copy_options::overwrite_existing);
        return named(name);
    }
    Outcome runTelling(const Words& words, int status = 0) const {
        SCOPED_TRACE(words.front());
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.status, status) << outcome.err;
        expectTextAlone(outcome.out);
        expectTextAlone(outcome.err);
        return outcome;
    }
    // The facts of a scene, as words and as a document.
    Json tellFacts(const std::string& scene, Words more = {}) const {
        Words words{"info", scene, "--size", "16x12"};
        words.insert(words.end(), more.begin(), more.end());
        runTelling(words);
        words.emplace_back("--json");
        const Json json = Json::parse(runTelling(words).out, nullptr, false);
        EXPECT_TRUE(json.is_object());
        return json;
    }
    void refuse(const Words& words) const {
        const Outcome outcome = runTelling(words, 1);
        EXPECT_EQ(linesIn(outcome.err), 1) << outcome.err;
        EXPECT_EQ(outcome.err.rfind("stereonav: ", 0), 0u) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_EQ(outcome.err.find("json.exception"), std::string::npos) << outcome.err;
    }
    // Gives what is read these names instead, and what is written too.
    Words withForeignNames(const std::string& command, Words words) const {
        words.insert(words.begin(), command);
        for (std::size_t n = 1; n < words.size(); ++n) {
            const bool out = words[n - 1] == "--out" || words[n - 1] == "--csv" || words[n - 1] == "--svg";
            if (out) words[n] = kForeignWords + words[n];
            if (words[n].ends_with("tube.nrrd")) words[n] = renamed(words[n], "tube.nrrd");
            if (words[n].ends_with("placed.asc")) {
                renamed(words[n].substr(0, words[n].size() - 3) + "prj", "placed.prj");
                words[n] = renamed(words[n], "placed.asc");
            }
        }
        return words;
    }
    // Lines as GeoJSON, with such names.
    std::string track(const Words& names) const {
        Json features = Json::array();
        for (const std::string& name : names)
            features.push_back(
                {{"type", "Feature"},
                 {"properties", {{"name", name}}},
                 {"geometry",
                  {{"type", "LineString"}, {"coordinates", Json::array({{-100, -100}, {200, 150}})}}}});
        return input("lines.geojson", Json{{"type", "FeatureCollection"}, {"features", features}}.dump());
    }
};

TEST_F(ForeignWords, AsNamesOfFilesInEveryCommand) {
    for (const auto& [command, small] : runs(renamed(hills(), "hills.asc")))
        if (command != "report") runTelling(withForeignNames(command, small.words));
}

TEST_F(ForeignWords, AsNamesOfWhatIsWritten) {
    const std::string ground = renamed(hills(), "hills.asc");
    for (const char* name : {"a.png", "a.jpg", "a.tif"})
        runTelling({"render", ground, "--size", "16x12", "--out", kForeignWords + name});
    for (const char* name : {"a.glb", "a.gltf"}) runTelling({"mesh", ground, "--out", kForeignWords + name});
    runTelling({"play", ground, "--size", "16x12", "--frames", "1", "--out", kForeignWords + "a.mp4"});
    runTelling({"compare", ground, "--size", "16x12", "--frames", "1", "--repeats", "1", "--methods", "paper",
                "--csv", kForeignWords + "c.csv", "--plot", kForeignWords + "c.png", "--json",
                kForeignWords + "c.json"});
    EXPECT_TRUE(Json::parse(contentOf(place() / (kForeignWords + "c.json"))).is_object());
    expectPrintable(contentOf(place() / (kForeignWords + "c.csv")));
    refuse({"render", ground, "--size", "16x12", "--out", kForeignWords + ".xyz"});
    refuse({"render", ground, "--size", "16x12", "--out", kForeignWords + "/a.png"});
}

TEST_F(ForeignWords, AsNamesOfFilesThatAreNone) {
    for (const char* extension : {".tif", ".asc", ".nrrd", ".nii", ".nii.gz", ".dcm", ".toml", ".gltf",
                                  ".glb", ".vrt", "", ".light"}) {
        refuse({"info", named(extension)});
        std::ofstream(named(extension)) << "no such file" << kForeignWords;
        refuse({"info", named(extension)});
    }
    const std::string ground = hills();
    std::ofstream(named("t.gpx")) << "<gpx>" << kForeignWords;
    refuse({"measure", ground, "--track", named("t.gpx")});
    refuse({"measure", ground, "--track", named("none.gpx")});
    std::ofstream(named("r.json")) << "{" << kForeignWords;
    refuse({"report", "--quick", "--compare", named("r.json"), "--out", "page"});
    refuse({"findings", maskedTube(), "--no-cache", "--file", named("r.json")});
}

TEST_F(ForeignWords, AsWordsOfTheCommandLine) {
    const std::string ground = hills();
    refuse({kForeignWords});
    refuse({"info", ground, "--" + kForeignWords});
    refuse({"info", ground, "--size", kForeignWords});
    refuse({"info", ground, "--method", kForeignWords});
    refuse({"info", ground, "--set", kForeignWords + "=1"});
    refuse({"measure", ground, "--line", kForeignWords});
}

TEST_F(ForeignWords, InHeadersOfStudies) {
    SmallStudy study{24, 24, 24, 2, "uchar", ""};
    for (const std::string& words : {kForeignWords, kForeignUtf8}) {
        std::string oneLine = words;
        std::erase(oneLine, '\n');
        study.extra = "comment:=" + oneLine + "\nstereonav_" + oneLine + ":=" + oneLine + "\ncontent: \"" +
                      oneLine + "\"\n";
        const std::string mask =
            nrrd("tags.nrrd", study, [](int i, int j, int k) { return inTube(i, j, k) ? 1 : 0; });
        tellFacts(mask, {"--no-cache"});
        runTelling({"centreline", mask, "--no-cache", "--out", "line.txt"});
        study.extra = "space units: \"" + oneLine + "\"\nkinds: " + oneLine + "\n";
        study.type = oneLine;
        refuse({"info", nrrd("type.nrrd", study, [](int, int, int) { return 0; })});
        study.type = "uchar";
        study.extra = "data file: " + oneLine + ".raw\n";
        refuse({"info", nrrd("detached.nrrd", study, [](int, int, int) { return 0; })});
        study.extra = "Segment0_Name:=D\u00fcnndarm" + oneLine + "\nSegment0_LabelValue:=1\n";
        const std::string labels =
            nrrd("labels.nrrd", study, [](int i, int j, int k) { return inTube(i, j, k) ? 1 : 0; });
        const Outcome other = run({"info", labels, "--label", "9"});
        EXPECT_EQ(other.status, 1);
        expectTextAlone(other.err);
        EXPECT_NE(other.err.find("1 \"D\u00fcnndarm\\x1b[2J"), std::string::npos) << other.err;
    }
}

TEST_F(ForeignWords, InSeriesOfSlices) {
    for (const std::string& words : {kForeignWords, kForeignUtf8})
        for (int series = 0; series < 2; ++series)
            for (int k = 0; k < 3; ++k) {
                DicomSpec s;
                s.slice.uid += "." + std::to_string(series);
                s.slice.position.z = 3 * k;
                s.slice.description = words;
                s.slice.modality = words.substr(0, 14);
                for (int n = 0; n < 30; ++n) s.slice.pixels.push_back(static_cast<std::uint16_t>(n * 40));
                const std::string folder = words == kForeignUtf8 ? "utf8/" : "bytes/";
                writeDicom(mFolder / folder / fmt::format("{}{}.dcm", series, k), s);
            }
    for (const char* folder : {"utf8", "bytes"}) {
        const std::string study = (mFolder / folder).string();
        const Outcome several = run({"info", study, "--isosurface"});
        expectTextAlone(several.out);
        expectTextAlone(several.err);
        for (const bool json : {false, true}) {
            Words words{"info", study, "--series-pictures", kForeignWords + "pictures"};
            if (json) words.emplace_back("--json");
            const Outcome listed = run(words);
            expectTextAlone(listed.out);
            expectTextAlone(listed.err);
        }
    }
}

TEST_F(ForeignWords, InMeshes) {
    const std::string mesh = (mFolder / "m.gltf").string();
    ASSERT_EQ(run({"mesh", hills(), "--out", mesh}).status, 0);
    Json model = Json::parse(contentOf(mesh));
    model["asset"]["generator"] = model["asset"]["copyright"] = kForeignUtf8;
    for (const char* part : {"nodes", "meshes", "materials", "images", "scenes"})
        if (model.contains(part))
            for (Json& one : model[part]) one["name"] = kForeignUtf8;
    writeTextFile(mesh, model.dump());
    tellFacts(mesh);
    for (const char* part : {"extensionsRequired", "extensionsUsed"}) model[part] = {kForeignUtf8};
    writeTextFile(mesh, model.dump());
    refuse({"info", mesh});
    model.erase("extensionsRequired");
    model["images"] = Json::array({{{"uri", kForeignUtf8 + ".png"}}});
    model["buffers"] = Json::array({{{"uri", kForeignUtf8 + ".bin"}, {"byteLength", 12}}});
    writeTextFile(mesh, model.dump());
    refuse({"info", mesh});
}

TEST_F(ForeignWords, InScenesAndTheirPlaces) {
    const std::string ground = hills();
    const std::string quoted = Json(kForeignUtf8).dump(-1, ' ', true);  // TOML has the escapes of JSON
    for (const std::string& scene :
         {"[terrain]\ndem = " + quoted, "[terrain]\n" + quoted + " = 1", "[" + quoted + "]",
          "scene = " + quoted, "[terrain]\ndem = \"hills.asc\"\nnodata = " + quoted,
          "[terrain]\ndem = \"" + kForeignWords})
        refuse({"info", input("scene.toml", scene)});
    const std::string method = "[terrain]\ndem = \"hills.asc\"\n[options]\nmethod = " + quoted;
    refuse({"render", input("scene.toml", method), "--size", "16x12", "--out", "a.png"});
    input("hills.prj", "LOCAL_CS[\"" + kForeignUtf8 + "\",UNIT[\"metre\",1]]");
    const Outcome placed = run({"info", ground, "--size", "16x12"});
    expectTextAlone(placed.out);
    expectTextAlone(placed.err);
    const Outcome document = run({"info", ground, "--size", "16x12", "--json"});
    expectTextAlone(document.out);
    ASSERT_EQ(document.status, placed.status);
    if (document.status == 0) {
        EXPECT_TRUE(Json::parse(document.out, nullptr, false).is_object());
    }
}

TEST_F(ForeignWords, InNamesOfTracksAndTables) {
    const std::string ground = renamed(hills(), "hills.asc");
    const std::string lines = track({kForeignUtf8, "=cmd|' /C calc'!A0"});
    const Outcome measured = runTelling(
        {"measure", ground, "--track", lines, "--csv", "m.csv", "--geojson", kForeignWords + "m.geojson"});
    EXPECT_NE(measured.out.find("=cmd"), std::string::npos) << measured.out;
    const std::string csv = contentOf(place() / "m.csv");
    expectPrintable(csv);
    EXPECT_NE(csv.find(",\"'=cmd|' /C calc'!A0\","), std::string::npos) << csv;
    const Json json = Json::parse(contentOf(place() / (kForeignWords + "m.geojson")), nullptr, false);
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("features").at(1).at("properties").at("name"), "=cmd|' /C calc'!A0") << "no table";
    runTelling({"measure", ground, "--track", lines, "--json"});
    runTelling({"profile", ground, "--track", track({kForeignUtf8}), "--csv", "p.csv", "--svg", "p.svg"});
    expectPrintable(contentOf(place() / "p.csv"));
    expectPrintable(contentOf(place() / "p.svg"));
}

TEST_F(ForeignWords, InFindings) {
    const std::string mask = renamed(maskedTube(), "tube.nrrd");
    const Words words{
        "findings", mask,     "--no-cache", "--at",  "0,7,0",  "--comment", "=1+1" + kForeignWords,
        "--file",   "f.json", "--csv",      "f.csv", "--page", "f.html"};
    runTelling(words);
    EXPECT_TRUE(Json::parse(contentOf(place() / "f.json"), nullptr, false).is_object());
    for (const char* file : {"f.json", "f.csv", "f.html"}) {
        SCOPED_TRACE(file);
        expectPrintable(contentOf(place() / file));
    }
    EXPECT_NE(contentOf(place() / "f.csv").find("\"'=1+1"), std::string::npos);
    runTelling({"findings", mask, "--no-cache", "--file", "f.json"});
    runTelling({"findings", mask, "--no-cache", "--file", "f.json", "--json"});
}

}  // namespace
}  // namespace stereonav::test
