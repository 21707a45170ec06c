// The commands as a user runs them: what they print and what they leave.
#include <csignal>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/app/program.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

class Commands : public ProgramTest {
protected:
    std::set<std::string> left() const {
        std::set<std::string> names;
        for (const auto& entry : fs::recursive_directory_iterator(place()))
            if (entry.is_regular_file()) names.insert(fs::relative(entry.path(), place()).string());
        return names;
    }

    Outcome runWell(const std::vector<std::string>& arguments) const {
        Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        return outcome;
    }
};

TEST_F(Commands, HelpAndVersion) {
    EXPECT_NE(runWell({"--version"}).out.find("stereonav 0."), std::string::npos);
    for (const std::string command : {"info", "render", "play", "compare", "view", "mesh"}) {
        EXPECT_NE(runWell({"--help"}).out.find(command), std::string::npos);
        EXPECT_NE(runWell({command, "--help"}).out.find("--threads"), std::string::npos);
    }
}

TEST_F(Commands, InfoTellsWhatWasReadAndThePlan) {
    const Json json =
        Json::parse(runWell({"info", hills(), "--size", "64x48", "--threads", "1", "--json"}).out);
    const Json& terrain = json.at("terrain");
    EXPECT_EQ(terrain.at("size"), Json({32, 24}));
    EXPECT_EQ(terrain.at("spacing_m"), Json({30.0, 30.0}));
    EXPECT_EQ(terrain.at("height_range_m"), Json({100.0, 149.0}));
    EXPECT_EQ(terrain.at("missing_samples"), 0);
    const Json& plan = json.at("plan");
    EXPECT_EQ(plan.at("size"), Json({64, 48}));
    EXPECT_EQ(plan.at("threads"), 1);
    EXPECT_GT(plan.at("cast_right_ms").get<double>(), 0.0);
    EXPECT_GT(plan.at("warp_right_ms").get<double>(), 0.0);
    EXPECT_NE(plan.at("reason").get<std::string>().find(
                  plan.at("method").get<std::string>() == "full" ? "casting" : "takes"),
              std::string::npos);
    const std::string text = runWell({"info", hills(), "--size", "64x48"}).out;
    for (const char* word :
         {"32 x 24", "spacing", "heights", "projection", "sky", "frame plan", "threads", "right eye"})
        EXPECT_NE(text.find(word), std::string::npos) << word;
}

TEST_F(Commands, InfoCountsMissingSamples) {
    const auto scene =
        grid("pits.asc", 16, 16, 10, [](int i, int j) { return i == 5 && j < 3 ? -9999 : i + j; });
    const auto terrainOf = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"info", scene, "--size", "16x16", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return Json::parse(runWell(arguments).out).at("terrain");
    };
    EXPECT_EQ(terrainOf({}).at("missing_samples"), 3);
    EXPECT_EQ(terrainOf({}).at("filled_samples"), 3);
    EXPECT_EQ(terrainOf({}).at("open_holes"), false);
    EXPECT_EQ(terrainOf({"--open-holes"}).at("filled_samples"), 0);
    EXPECT_EQ(terrainOf({"--open-holes"}).at("open_holes"), true);
}

TEST_F(Commands, RenderWritesThePictureAndNothingElse) {
    fs::create_directories(place() / "deep/er");
    runWell({"render", hills(), "--size", "60x40", "--mode", "sbsl", "--out", "deep/er/pair.png"});
    runWell({"render", hills(), "--size", "60x40", "--mode", "arcd", "--pose", "-20,0,400,30,-20,5", "--out",
             "red.jpg"});
    EXPECT_EQ(left(), (std::set<std::string>{"deep/er/pair.png", "red.jpg"}));
    // the size of a PNG stands in bytes 16 to 23, most significant first
    const std::string png = contentOf(place() / "deep/er/pair.png");
    ASSERT_GT(png.size(), 24u);
    EXPECT_EQ(png.substr(16, 8), std::string("\0\0\0\x78\0\0\0\x28", 8));
}

TEST_F(Commands, PlayWritesFramesAndVideos) {
    runWell({"play", hills(), "--size", "33x21", "--frames", "3", "--mode", "ml", "--out", "frames"});
    EXPECT_EQ(left(), (std::set<std::string>{"frames/frame_00000.png", "frames/frame_00001.png",
                                             "frames/frame_00002.png"}));
    fs::remove_all(place() / "frames");
    for (const std::string name : {"flight.mp4", "flight.avi", "flight.mkv"})
        runWell({"play", hills(), "--size", "33x21", "--frames", "3", "--mode", "sbsl", "--video", name});
    EXPECT_EQ(left(), (std::set<std::string>{"flight.avi", "flight.mkv", "flight.mp4"}));
    for (const std::string& name : left()) EXPECT_GT(fs::file_size(place() / name), 300u) << name;
}

// The last word of the line that starts with "hash ".
std::string hashIn(const Outcome& outcome) {
    const std::size_t at = outcome.out.find("hash ");
    return at == std::string::npos ? "" : outcome.out.substr(at + 5, 16);
}

TEST_F(Commands, PlaybackIsTheSameEveryTimeOnAnyNumberOfThreads) {
    for (const std::string method : {"auto", "paper", "full"}) {
        std::vector<std::string> arguments{"play", hills(),  "--size",   "96x64", "--frames",
                                           "4",    "--hash", "--method", method,  "--threads"};
        std::set<std::string> hashes;
        for (const std::string threads : {"1", "2", "2", "3"}) {
            std::vector<std::string> run = arguments;
            run.push_back(threads);
            hashes.insert(hashIn(runWell(run)));
        }
        EXPECT_EQ(hashes.size(), 1u) << method;
        EXPECT_EQ(hashes.begin()->size(), 16u);
        arguments[5] = "5";  // another number of frames is another flight
        arguments.push_back("2");
        EXPECT_EQ(hashes.count(hashIn(runWell(arguments))), 0u) << method;
    }
    EXPECT_TRUE(left().empty());
}

// With a highlight the right eye is shaded again, which must not depend on the threads either.
TEST_F(Commands, PlaybackOfGlossyGroundIsTheSameOnAnyNumberOfThreads) {
    hills();
    const auto scene = [&](const std::string& specular) {
        return input("scene" + specular + ".toml",
                     "[terrain]\ndem = \"hills.asc\"\n[look]\nspecular = " + specular + "\n");
    };
    const auto hashOf = [&](const std::string& file, const std::string& threads) {
        return hashIn(
            runWell({"play", file, "--size", "96x64", "--frames", "3", "--hash", "--threads", threads}));
    };
    const std::string glossy = hashOf(scene("0.6"), "1");
    EXPECT_EQ(glossy.size(), 16u);
    EXPECT_EQ(hashOf(scene("0.6"), "2"), glossy);
    EXPECT_NE(hashOf(scene("0.0"), "2"), glossy);
    const Json plan =
        Json::parse(runWell({"info", scene("0.6"), "--size", "32x24", "--json"}).out).at("plan");
    EXPECT_EQ(plan.at("view_dependent"), true);
    EXPECT_EQ(plan.at("planes").size(), 5u);
}

TEST_F(Commands, CompareGivesEveryFieldForEveryMethod) {
    const Outcome outcome = runWell({"compare",
                                     hills(),
                                     "--size",
                                     "64x48",
                                     "--frames",
                                     "2",
                                     "--repeats",
                                     "1",
                                     "--threads",
                                     "2",
                                     "--relative-separation",
                                     "1/30",
                                     "--json",
                                     "a.json",
                                     "--csv",
                                     "a.csv",
                                     "--butteraugli",
                                     "--plot",
                                     "plot.png",
                                     "--images",
                                     "pictures"});
    const Json json = Json::parse(contentOf(place() / "a.json"));
    EXPECT_EQ(json.at("size"), Json({64, 48}));
    EXPECT_EQ(json.at("threads"), 2);
    EXPECT_NE(json.at("scene").get<std::string>().find("hills.asc"), std::string::npos);
    EXPECT_NEAR(json.at("separation_m").get<double>() * 30, json.at("zero_parallax_m").get<double>(), 1e-9);
    const std::set<std::string> wanted{"full", "paper", "linear", "mcmillan", "nofill"};
    std::set<std::string> names;
    for (const Json& method : json.at("methods")) {
        const std::string name = method.at("name");
        names.insert(name);
        for (const char* field :
             {"left_ms",         "warp_ms",           "fill_ms",          "right_ms",
              "full_right_ms",   "hole_percent",      "psnr_db",          "ssim",
              "rgb_mean",        "rgb_p99",           "rgb_max",          "edge_psnr_db",
              "true_psnr_db",    "left_true_psnr_db", "pair_ms",          "holes_of_warped_percent",
              "surface_psnr_db", "flicker_db",        "rivalry_db",       "edge_rivalry_db",
              "butteraugli",     "butteraugli_max",   "edge_butteraugli", "flat_butteraugli"}) {
            if (name == "full" && std::string(field) == "holes_of_warped_percent") {
                EXPECT_TRUE(method.at(field).is_null()) << "a full cast warps nothing";
                continue;
            }
            ASSERT_TRUE(method.at(field).is_number()) << name << " " << field;
            EXPECT_GE(method.at(field).get<double>(), 0.0) << name << " " << field;
        }
        for (const std::string end : {".png", "_holes.png", "_difference_x5.png", "_butteraugli.png"})
            EXPECT_TRUE(fs::exists(place() / "pictures" / (name + end))) << name << end;
        EXPECT_EQ(method.at("left_true_psnr_db"), json.at("methods")[0].at("left_true_psnr_db"))
            << "one left eye for all";
        EXPECT_NE(outcome.out.find("\n" + name + " "), std::string::npos) << "not in the table";
        if (name == "full") {
            EXPECT_EQ(method.at("psnr_db"), 100.0);
            EXPECT_LT(method.at("true_psnr_db").get<double>(), 100.0);
        }
    }
    for (const std::string& name : wanted) EXPECT_EQ(names.count(name), 1u) << name;
    EXPECT_EQ(json.at("truth_rays"), 64);
    for (const char* name : {"truth_64_rays.png", "left_truth_64_rays.png"})
        EXPECT_TRUE(fs::exists(place() / "pictures" / name)) << name;
    const std::string csv = contentOf(place() / "a.csv");
    EXPECT_EQ(linesIn(csv), static_cast<long>(names.size()) + 1);
    EXPECT_TRUE(fs::exists(place() / "plot.png"));
    for (const std::string& name : left()) EXPECT_EQ(name.find(".part"), std::string::npos) << name;
}

TEST_F(Commands, CompareTakesSomeMethodsInTheirOrder) {
    const Outcome outcome = runWell({"compare", "--size", "32x24", "--frames", "1", "--repeats", "1",
                                     "--json", "a.json", "--methods", "linear,full,linear", hills()});
    const Json methods = Json::parse(contentOf(place() / "a.json")).at("methods");
    ASSERT_EQ(methods.size(), 2u);
    EXPECT_EQ(methods[0].at("name"), "linear");
    EXPECT_TRUE(methods[0].at("butteraugli").is_null()) << "not asked for";
    EXPECT_EQ(outcome.out.find("butteraugli"), std::string::npos) << "a column of nothing";
    EXPECT_EQ(methods[1].at("name"), "full");
}

TEST_F(Commands, PlaysARecordedPath) {
    const std::string path = input("flight.path", "0 0 0 500 0.5 0 0 0.87\n2 60 0 500 0.5 0 0 0.87\n");
    runWell({"play", hills(), "--size", "32x24", "--path", path, "--fps", "2", "--out", "frames"});
    EXPECT_EQ(left().size(), 5u) << "0, 0.5, 1, 1.5 and 2 seconds";
}

// A flight that would last for hours is stopped once its first frame is there.
TEST_F(Commands, AnInterruptLeavesNothingHalfWritten) {
    const pid_t child = start({"play", hills(), "--size", "640x480", "--frames", "1000000", "--out", "frames",
                               "--video", "flight.mp4"});
    ASSERT_GT(child, 0);
    EXPECT_TRUE(waitFor([&] { return fs::exists(place() / "frames/frame_00000.png") || hasEnded(child); }));
    kill(child, SIGINT);
    const Outcome outcome = awaitStopped(child);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err, "stereonav: stopped\n");
    for (const std::string& name : left()) {
        EXPECT_EQ(name.rfind("frames/frame_", 0), 0u) << name;
        EXPECT_GT(fs::file_size(place() / name), 1000u) << name;
    }
}

TEST_F(Commands, FliesTheBuiltInTerrain) {
    setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
    const Json json = Json::parse(runWell({"info", "--size", "32x24", "--json"}).out);
    EXPECT_EQ(json.at("scene"), "terrain");
    EXPECT_EQ(json.at("terrain").at("missing_samples"), 0);
}

// What a user without a display gets from the bare command.
TEST_F(Commands, WithoutArgumentsAndDisplayTheFlightGoesToAFolder) {
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    const Outcome outcome = run({});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("true_psnr_db"), std::string::npos) << outcome.out;
    const std::set<std::string> names = left();
    for (const char* name : {"out/flight.mp4", "out/compare.json", "out/compare.csv",
                             "out/error_against_time.png", "out/frame_00000.png"})
        EXPECT_EQ(names.count(name), 1u) << name;
    EXPECT_EQ(Json::parse(contentOf(place() / "out/compare.json")).at("scene"), "terrain");
}

}  // namespace
}  // namespace stereonav::test
