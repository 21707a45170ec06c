// The commands on small studies: a colon from a mask, and a volume seen from outside.
#include <nlohmann/json.hpp>
#include <set>

#include "tests/app/asked_memory.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

class VolumeCommands : public VolumeTest {
protected:
    void SetUp() override {
        VolumeTest::SetUp();
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
    }
    Outcome runWell(const std::vector<std::string>& arguments) const {
        Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        return outcome;
    }
    Json info(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments{"info", "--size", "48x36", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return Json::parse(runWell(arguments).out);
    }
    std::string hashOf(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments{"play", "--size", "64x48", "--frames", "3", "--hash"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const std::string out = runWell(arguments).out;
        const std::size_t at = out.find("hash ");
        return at == std::string::npos ? "" : out.substr(at + 5, 16);
    }
};

// In a lumen that is narrow almost everywhere the eyes come together: the plan is of such frames.
TEST_F(VolumeCommands, TheFramePlanMeasuresWhatFramesDo) {
    const std::string narrow = nrrd("narrow.nrrd", {40, 40, 160, 1, "uchar", ""}, [](int i, int j, int k) {
        const double radius = k % 40 < 4 ? 7.2 : 2.2;
        return k >= 3 && k < 157 && std::hypot(i - 19.5, j - 19.5) < radius ? 1 : 0;
    });
    const Json plan = Json::parse(runWell({"info", narrow, "--size", "160x120", "--json"}).out).at("plan");
    const double planned = plan.at("hole_percent").get<double>();
    runWell({"compare", narrow, "--frames", "5", "--methods", "linear", "--size", "160x120", "--json",
             "compared.json"});
    const Json compared = Json::parse(contentOf(place() / "compared.json"));
    const double holes = compared.at("methods")[0].at("hole_percent").get<double>();
    EXPECT_LT(holes, 15);
    EXPECT_NEAR(planned, holes, 0.5 * holes);
}

TEST_F(VolumeCommands, InfoOfAMask) {
    const Json volume = info({maskedTube()}).at("volume");
    EXPECT_EQ(volume.at("kind"), "colon");
    EXPECT_EQ(volume.at("segments").size(), 1u);
    int voxels = 0;
    for (int k = 0; k < 24; ++k)
        for (int j = 0; j < 24; ++j)
            for (int i = 0; i < 24; ++i) voxels += inTube(i, j, k) ? 1 : 0;
    EXPECT_EQ(volume.at("segments")[0].at("voxels"), voxels);
    EXPECT_NEAR(volume.at("volume_ml").get<double>(), voxels * 8e-3, 1e-9);
    EXPECT_EQ(volume.at("spacing_mm").size(), 3u);
    for (const Json& spacing : volume.at("spacing_mm")) EXPECT_NEAR(spacing.get<double>(), 2.0, 1e-6);
    // The tube is 40 mm long; the line keeps away from its ends by less than its radius.
    EXPECT_GT(volume.at("centreline_mm").get<double>(), 40 - 2 * 8);
    EXPECT_LT(volume.at("centreline_mm").get<double>(), 44);
    EXPECT_TRUE(volume.at("polyps").empty());
    const std::string text = runWell({"info", maskedTube(), "--size", "48x36"}).out;
    for (const char* word : {"a colon, from inside", "spacing", "segments", "ml", "centreline", "frame plan"})
        EXPECT_NE(text.find(word), std::string::npos) << word;
}

TEST_F(VolumeCommands, InfoOfAVolumeSeenFromOutside) {
    const Json volume = info({ball(), "--isosurface", "--isovalue", "640"}).at("volume");
    EXPECT_EQ(volume.at("kind"), "isosurface");
    EXPECT_NEAR(volume.at("isovalue").get<double>(), 640, 0.5);
    EXPECT_TRUE(volume.at("segments").empty());
}

TEST_F(VolumeCommands, EveryCommandTakesAStudy) {
    for (const std::vector<std::string>& scene : {std::vector<std::string>{maskedTube()},
                                                  {ball(), "--isosurface"},
                                                  {maskedTube(), "--transfer", "wall_95"}}) {
        SCOPED_TRACE(scene.back());
        const auto with = [&](std::vector<std::string> arguments) {
            arguments.insert(arguments.end(), scene.begin(), scene.end());
            return arguments;
        };
        runWell(with({"render", "--size", "60x40", "--out", "pair.png"}));
        EXPECT_GT(fs::file_size(place() / "pair.png"), 500u);
        runWell(with({"play", "--size", "32x24", "--frames", "2", "--out", "frames"}));
        EXPECT_TRUE(fs::exists(place() / "frames/frame_00001.png"));
        const std::string one = hashOf(with({"--threads", "1"}));
        EXPECT_EQ(one.size(), 16u);
        EXPECT_EQ(hashOf(with({"--threads", "2"})), one);
        runWell(with({"compare", "--size", "48x36", "--frames", "2", "--repeats", "1", "--json", "a.json"}));
        std::vector<std::string> names;
        const Json json = Json::parse(contentOf(place() / "a.json"));
        for (const Json& method : json.at("methods")) names.push_back(method.at("name"));
        const std::vector<std::string> wanted =
            scene.size() == 3 ? std::vector<std::string>{"full", "linear", "selective", "depthsplat"}
                              : std::vector<std::string>{"full", "paper", "linear", "mcmillan", "nofill"};
        EXPECT_EQ(names, wanted);
        fs::remove_all(place());
        fs::create_directory(place());
    }
}

// Casting every ray with a jump gives what casting it from the eye gives.
TEST_F(VolumeCommands, DepthSplattingWorksOnOpaqueScenesToo) {
    runWell({"compare", maskedTube(), "--methods", "full,depthsplat", "--size", "64x48", "--frames", "3",
             "--repeats", "1", "--json", "a.json"});
    const Json methods = Json::parse(contentOf(place() / "a.json")).at("methods");
    ASSERT_EQ(methods.size(), 2u);
    EXPECT_EQ(methods[1].at("name"), "depthsplat");
    EXPECT_GT(methods[1].at("psnr_db").get<double>(), 45.0);
}

TEST_F(VolumeCommands, TheWayBackIsAnotherFlight) {
    const std::string there = hashOf({maskedTube()}), back = hashOf({maskedTube(), "--backwards"});
    EXPECT_EQ(there.size(), 16u);
    EXPECT_EQ(back.size(), 16u);
    EXPECT_NE(there, back);
    EXPECT_EQ(hashOf({maskedTube(), "--backwards"}), back) << "from the cache as well";
    EXPECT_EQ(hashOf({maskedTube()}), there);
    EXPECT_EQ(hashOf({maskedTube(), "--no-cache"}), there);
}

// Grey values: the lumen is kept in the cache, never beside the study; read back where what was found is
// gone, found again where it is damaged; what the commands make of it stays the same.
TEST_F(VolumeCommands, TheLumenOfACtIsKeptInTheCache) {
    fs::create_directory(mFolder / "studies");
    const std::string study =
        nrrd("studies/ct.nrrd", {}, [](int i, int j, int k) { return inTube(i, j, k) ? -1000 : 40; });
    const fs::path cache = mFolder / "cache/stereonav";
    const auto keptAs = [&](const std::string& start) {
        for (const auto& entry : fs::directory_iterator(cache))
            if (entry.path().filename().string().starts_with(start) && entry.path().extension() != ".of")
                return entry.path();
        return fs::path();
    };
    const auto openedSaying = [&](const std::string& words) {
        const Json volume = info({study}).at("volume");
        EXPECT_EQ(volume.at("kind"), "colon");
        std::string notes;
        for (const Json& note : volume.at("notes")) notes += note.get<std::string>() + "\n";
        EXPECT_NE(notes.find(words), std::string::npos) << notes;
        fs::remove(keptAs("colon-"));
        return volume.at("segments").dump() + volume.at("centreline_mm").dump();
    };
    const std::string first = openedSaying("lumen kept as " + cache.string());
    const fs::path lumen = keptAs("lumen-");
    ASSERT_TRUE(fs::exists(lumen));
    EXPECT_EQ(openedSaying("lumen read back from " + lumen.string()), first);
    const std::string whole = contentOf(lumen);
    std::ofstream(lumen, std::ios::binary) << whole.substr(0, whole.size() - 9);
    EXPECT_EQ(openedSaying(lumen.string() + " is damaged"), first);
    EXPECT_EQ(contentOf(lumen), whole);
    EXPECT_EQ(info({lumen.string()}).at("volume").at("segments")[0].at("voxels"),
              Json::parse(first.substr(0, first.find(']') + 1))[0].at("voxels"))
        << "other programs, and this one, read it as a mask";
    EXPECT_EQ(std::distance(fs::directory_iterator(mFolder / "studies"), fs::directory_iterator()), 1)
        << "something was written beside the study";
}

// A colon that bends has a box with places far from its lumen, whose values the cache does not keep: what is
// said of the study is the same fresh, with the lumen alone kept, and with all of it from the cache.
TEST_F(VolumeCommands, FactsAreTheSameFromTheCache) {
    const SmallStudy large{96, 96, 24, 1, "short", ""};
    const std::string study = nrrd("ct.nrrd", large, [](int i, int j, int k) {
        const bool along = std::hypot(j - 12, k - 12) < 6 && i > 5 && i < 90;
        const bool down = std::hypot(i - 84, k - 12) < 6 && j > 11 && j < 90;
        if (along || down) return -1000;
        const bool far = j - i > 30;  // part of the box, in the corner between both
        return far && (i + j + k) % 2 ? 1500 : far ? -90 : 40;
    });
    const auto facts = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{study};
        arguments.insert(arguments.end(), more.begin(), more.end());
        Json volume = info(arguments).at("volume");
        for (const char* key : {"bytes", "held", "notes"}) volume.erase(key);  // what the run itself did
        return volume;
    };
    const Json fresh = facts({"--no-cache"});
    ASSERT_EQ(fresh.at("kind"), "colon");
    EXPECT_EQ(fresh.at("range"), Json({-1000.0, 1500.0}));
    EXPECT_EQ(facts({}), fresh);
    EXPECT_EQ(facts({}), fresh) << "from the cache";
    EXPECT_NE(runWell({"info", study, "--size", "48x36"}).out.find("-1000 .. 1500 in the lumen's box"),
              std::string::npos);
}

// Each reading of a study asks for its memory. A colon's medium shows the study's own values, of which the
// cache has too few; a mask has none.
TEST_F(VolumeCommands, AMediumReadsItsStudyOnce) {
    const SmallStudy size{24, 24, 24, 2, "short", ""};
    const std::string ct =
        nrrd("ct.nrrd", size, [](int i, int j, int k) { return inTube(i, j, k) ? -1000 : 40; });
    const std::string asked = (mFolder / "asked").string();
    const auto readings = [&](const std::string& study) {
        fs::remove(asked);
        {
            const AskedMemory noted(asked);
            runWell({"render", study, "--medium", "tissue", "--slices", "16", "--size", "32x24", "--out",
                     "a.png"});
        }
        std::ifstream lines(asked);
        int count = 0;
        for (double taken = 0, bytes = 0; lines >> taken >> bytes;)
            count += bytes == 24.0 * 24 * 24 * 2;  // two bytes a voxel
        return count;
    };
    EXPECT_EQ(readings(ct), 1);
    EXPECT_EQ(readings(ct), 1) << "from the cache";
    EXPECT_LE(readings(maskedTube()), 1);
    EXPECT_EQ(readings(maskedTube()), 0) << "from the cache";
}

// Every command on a study in a folder that nobody may write to leaves it as it is, cache or no cache.
TEST_F(VolumeCommands, NothingIsWrittenBesideAnyStudy) {
    fs::create_directory(mFolder / "studies");
    const std::string ct =
        nrrd("studies/ct.nrrd", {}, [](int i, int j, int k) { return inTube(i, j, k) ? -1000 : 40; });
    for (const char* cache : {"cache", "no/cache"}) {
        if (std::string(cache) == "no/cache") input("no", "a file where a folder should be");
        setenv("XDG_CACHE_HOME", (mFolder / cache).c_str(), 1);
        info({ct});
        runWell({"render", ct, "--size", "32x24", "--out", "a.png"});
        runWell({"centreline", ct, "--out", "a.txt"});
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(mFolder / "studies"), fs::directory_iterator()), 1);
}

TEST_F(VolumeCommands, AMaskOfSeveralLabelsOpensWithOne) {
    const std::string mask = nrrd("labels.nrrd", {24, 24, 24, 2, "uchar", ""}, [](int i, int j, int k) {
        return inTube(i, j, k) ? 5 : i < 3 ? 9 : 0;
    });
    const Json volume = info({mask, "--label", "5"}).at("volume");
    EXPECT_EQ(volume.at("segments").size(), 1u);
    EXPECT_EQ(volume.at("kind"), "colon");
}

TEST_F(VolumeCommands, HelpTellsOfStudies) {
    for (const std::string command : {"info", "render", "play", "compare", "view"}) {
        const std::string help = runWell({command, "--help"}).out;
        for (const char* word : {"--seed", "LPS", "--isovalue", "--opacity", "--series", "--backwards"})
            EXPECT_NE(help.find(word), std::string::npos) << command << ' ' << word;
    }
}

}  // namespace
}  // namespace stereonav::test
