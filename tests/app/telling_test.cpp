// How every command tells what it did: words, one JSON document, or nothing. The window's is in
// view_screen_window_test.cpp, as it needs somebody to close it.
#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/options/command.h"
#include "app/output/command_result.h"
#include "tests/app/small_runs.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

class CommandTelling : public SmallRuns {};

TEST_F(CommandTelling, EveryCommandIsTried) {
    const auto all = runs("");
    for (const Command& command : commands())
        EXPECT_TRUE(all.contains(command.name) || command.command == command::kView) << command.name;
    for (const Command& command : commands())
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

// Documents are passed on: they do not say where the scene lies on this machine.
TEST_F(CommandTelling, DocumentsLeaveOutTheScenesFolder) {
    std::filesystem::create_directory(mFolder / "patients");
    const std::string ground = (mFolder / "patients/hills.asc").string();
    std::filesystem::copy(hills(), ground);
    for (auto& [command, small] : runs(ground)) {
        if (command == "cache") continue;  // tells of what it keeps
        SCOPED_TRACE(command);
        Words more =
            command == "compare" ? Words{"--json", "-", "--csv", "table.csv", "--quiet"} : Words{"--json"};
        if (command == "measure") more.insert(more.end(), {"--geojson", "lines.geojson"});
        const Outcome outcome = runWith(command, small, more);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.out.find("patients"), std::string::npos) << outcome.out;
        EXPECT_EQ(outcome.out.find(maskedTube()), std::string::npos) << outcome.out;
    }
    for (const char* file : {"table.csv", "line.csv", "lines.geojson"})
        EXPECT_EQ(contentOf(place() / file).find("patients"), std::string::npos) << file;
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
                                           command != "measure" && command != "profile" && command != "cache")
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

// A frame of 65,536 slices takes minutes: each line says how much of it is done.
TEST_F(CommandTelling, ALongFrameTellsHowMuchOfItIsDone) {
    setenv("STEREONAV_PROGRESS_SECONDS", "0.1", 1);
    for (const Words& words : {Words{"render", "cloud", "--out", "a.png"}, Words{"info", "cloud"}}) {
        Words all = words;
        all.insert(all.end(), {"--slices", "65536", "--light-size", "2048", "--size", "64x48"});
        std::filesystem::remove(mFolder / "stderr");  // left by the run before
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
