// How every command tells what it did: words, one JSON document, or nothing. The window's is in
// view_screen_window_test.cpp, as it needs somebody to close it.
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "app/options/option_table.h"
#include "app/output/command_result.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

class CommandTelling : public VolumeTest {
protected:
    // A small run of each command, and what it leaves to be read off its document.
    struct Small {
        Words words;
        Words fields;
    };
    // Near Krakow.
    std::string placedHills() const {
        const std::string file = input("placed.asc",
                                       "ncols 3\nnrows 3\nxllcorner 20\nyllcorner 50\ncellsize 0.001\n"
                                       "1 2 3\n4 5 6\n7 8 9\n");
        input("placed.prj",
              "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],"
              "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]]");
        return file;
    }
    std::map<std::string, Small> runs(const std::string& ground) const {
        return {{"info", {{ground, "--size", "16x12"}, {"scene", "terrain", "plan"}}},
                {"render",
                 {{ground, "--size", "16x12", "--out", "a.png"}, {"picture", "left_ms", "holes_percent"}}},
                {"play",
                 {{ground, "--size", "16x12", "--frames", "2", "--out", "frames"},
                  {"folder", "frames", "median_left_ms"}}},
                {"compare",
                 {{ground, "--size", "16x12", "--frames", "1", "--repeats", "1", "--methods", "paper"}, {}}},
                {"report",
                 {{"--quick", "--minutes", "0.01", "--parts", "stability", "--out", "page"},
                  {"page", "figures", "time_s"}}},
                {"mesh", {{ground, "--out", "a.glb"}, {"mesh", "triangles", "largest_error_m"}}},
                {"viewshed",
                 {{ground, "--from", "20,20", "--out", "shed.tif"}, {"viewshed", "seen_samples", "crs"}}},
                {"measure", {{ground, "--line", "20,20,60,60", "--csv", "line.csv"}, {"measures", "csv"}}},
                {"profile",
                 {{ground, "--line", "20,20,60,60", "--svg", "line.svg"}, {"points", "along_m", "svg"}}},
                {"sun", {{placedHills(), "--at", "2026-06-21"}, {"azimuth_deg", "next_sunset_utc"}}},
                {"centreline",
                 {{"colon", "--out", "line.txt"}, {"centreline", "points", "length_mm", "segments"}}},
                {"coverage",
                 {{maskedTube(), "--no-cache", "--out", "patches.csv"},
                  {"one_way_percent", "two_way_percent", "after_patches_percent", "patches", "table"}}},
                {"findings",
                 {{maskedTube(), "--no-cache", "--at", "0,7,0", "--csv", "findings.csv"},
                  {"findings", "crads", "notice", "table"}}},
                {"register",
                 {{maskedTube(), "--no-cache", "--with", maskedTube()}, {"length_mm", "other", "cost"}}},
                {"unfold",
                 {{maskedTube(), "--no-cache", "--out", "wall.png"},
                  {"picture", "size", "area_error_percent", "hidden_percent"}}},
                {"bake",
                 {{ground, "--what", "openness", "--resolution", "0.25", "--out", "a.light"},
                  {"light", "what", "baked_before", "samples"}}}};
    }
    Outcome runWith(const std::string& command, const Small& small, const Words& more) const {
        Words all{command};
        all.insert(all.end(), small.words.begin(), small.words.end());
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    }
};

TEST_F(CommandTelling, EveryCommandIsTried) {
    const auto all = runs("");
    for (const CommandFacts& command : commandFacts())
        EXPECT_TRUE(all.contains(command.name) || command.command == command::kView) << command.name;
    for (const CommandFacts& command : commandFacts())
        for (const char* key : {"json", "quiet"}) {
            EXPECT_NE(findOption(command.command, key), nullptr) << command.name << " --" << key;
        }
}

TEST_F(CommandTelling, AsJsonIsOneDocument) {
    // No name of a file breaks the document: quotes, and bytes that are no UTF-8.
    std::filesystem::copy(hills(), mFolder / "hi\"l\xff.asc");
    for (const auto& [command, small] : runs((mFolder / "hi\"l\xff.asc").string())) {
        SCOPED_TRACE(command);
        const Outcome outcome =
            runWith(command, small, command == "compare" ? Words{"--json", "-", "--quiet"} : Words{"--json"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        const Json json = Json::parse(outcome.out, nullptr, false);
        ASSERT_TRUE(json.is_object()) << outcome.out;
        for (const std::string& field : small.fields) EXPECT_TRUE(json.contains(field)) << field;
        if (command == "info" || command == "compare") continue;
        EXPECT_EQ(json.at("command"), command);
    }
    EXPECT_TRUE(std::filesystem::exists(place() / "a.png")) << "the files are written as without";
}

TEST_F(CommandTelling, QuietSaysNothing) {
    setenv("STEREONAV_PROGRESS_SECONDS", "0.1", 1);
    for (const auto& [command, small] : runs(hills())) {
        SCOPED_TRACE(command);
        const Outcome outcome = runWith(command, small, {"--quiet"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        // What is asked for is printed: facts and the table.
        EXPECT_EQ(outcome.out.empty(), command != "info" && command != "compare" && command != "sun" &&
                                           command != "measure" && command != "profile")
            << outcome.out;
    }
    unsetenv("STEREONAV_PROGRESS_SECONDS");
    const Outcome compared = run({"compare", hills(), "--size", "16x12", "--frames", "1", "--repeats", "1",
                                  "--methods", "paper", "--csv", "a.csv", "--quiet"});
    EXPECT_EQ(compared.out, "") << "a file was asked for";
    const Outcome hash = run({"play", hills(), "--size", "16x12", "--frames", "1", "--hash", "--quiet"});
    EXPECT_EQ(hash.out.substr(0, 5), "hash ");
    EXPECT_EQ(linesIn(hash.out), 1);
}

TEST_F(CommandTelling, ErrorsStayOneLine) {
    for (const std::string option : {"--json", "--quiet"})
        expectRefused({"info", "none.tif", option}, {"none.tif"});
    expectRefused({"render", hills(), "--size", "16x12", "--out", "-", "--json"}, {"--out", "--json"});
}

// A frame of so many slices takes minutes: each line says how much of it is done.
TEST_F(CommandTelling, ALongFrameTellsHowMuchOfItIsDone) {
    setenv("STEREONAV_PROGRESS_SECONDS", "0.1", 1);
    for (const Words& words : {Words{"render", "cloud", "--out", "a.png"}, Words{"info", "cloud"}}) {
        Words all = words;
        all.insert(all.end(), {"--slices", "65536", "--light-size", "2048", "--size", "64x48"});
        std::filesystem::remove(mFolder / "stderr");  // of the run before
        const pid_t child = start(all);
        const auto said = [&] { return contentOf(mFolder / "stderr").find("% of this step"); };
        EXPECT_TRUE(waitFor([&] { return hasEnded(child) || said() != std::string::npos; }));
        EXPECT_FALSE(hasEnded(child)) << "it ended by itself";
        kill(child, SIGTERM);
        EXPECT_EQ(awaitStopped(child).status, 1) << words.front();
    }
    unsetenv("STEREONAV_PROGRESS_SECONDS");
}

// No number is null, and a stream has no size.
TEST_F(CommandTelling, DocumentsHoldAnything) {
    testing::internal::CaptureStdout();
    CommandResult result("render", {true, false}, {});
    result.say("words");
    result.add("nan_ms", std::nan(""));
    result.add("infinite_ms", FactNumbers{std::numeric_limits<double>::infinity(), 1.0});
    result.addFile("picture", "-");
    result.add("name", std::string("a\"\n\xc3("));
    result.finish();
    std::fflush(stdout);
    const Json json = Json::parse(testing::internal::GetCapturedStdout());
    EXPECT_TRUE(json.at("nan_ms").is_null());
    EXPECT_TRUE(json.at("infinite_ms").at(0).is_null());
    EXPECT_TRUE(json.at("picture").at("bytes").is_null());
    EXPECT_EQ(json.at("name").get<std::string>().substr(0, 3), "a\"\n");
}

}  // namespace
}  // namespace stereonav::test
