// Which libraries the program loads for what it is asked to do, and what it holds: nothing that a scene does
// not need. The libraries are those that the dynamic loader itself names (LD_DEBUG=files, glibc), and those
// that info lists.
#include <gmock/gmock.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char* kBig[] = {"libgdal", "libITK", "libgdcm", "libdcm", "libopencv"};
// What the program is linked with, and what these need: measured 22 and 23, with some room for other
// versions.
constexpr std::size_t kMostWithoutModules = 40;

class LazyLibraries : public VolumeTest {
protected:
    // Files of the libraries that a run loads, at any time.
    std::vector<std::string> loadedBy(const std::vector<std::string>& arguments) const {
        const auto log = mFolder / "loader";
        setenv("LD_DEBUG", "files", 1);
        setenv("LD_DEBUG_OUTPUT", log.c_str(), 1);
        const pid_t child = start(arguments);
        unsetenv("LD_DEBUG");
        unsetenv("LD_DEBUG_OUTPUT");
        const Outcome outcome = await(child);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        std::istringstream lines(contentOf(log.string() + "." + std::to_string(child)));
        std::vector<std::string> files;
        const std::string mark = "calling init: ";
        for (std::string line; std::getline(lines, line);)
            if (const auto at = line.find(mark); at != std::string::npos)
                files.push_back(line.substr(at + mark.size()));
        return files;
    }

    Json info(std::vector<std::string> more) const {
        std::vector<std::string> arguments{"info", "--size", "64x48", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return Json::parse(outcome.out);
    }

    std::string picture() const { return (place() / "a.png").string(); }
};

void expectNoneBig(const std::vector<std::string>& files, const std::string& but = "none") {
    for (const std::string name : kBig)
        if (name != but) {
            EXPECT_THAT(files, Each(Not(HasSubstr(name))));
        }
}

TEST_F(LazyLibraries, VersionAndHelpLoadFew) {
    for (const std::string option : {"--version", "--help"}) {
        const auto files = loadedBy({option});
        EXPECT_GT(files.size(), 3u);
        EXPECT_LT(files.size(), kMostWithoutModules);
        expectNoneBig(files);
    }
}

TEST_F(LazyLibraries, BuiltInTerrainInAPictureLoadsNoReader) {
    const auto files = loadedBy({"render", "--size", "64x48", "--out", picture()});
    EXPECT_LT(files.size(), kMostWithoutModules);
    expectNoneBig(files);
}

TEST_F(LazyLibraries, AnElevationModelLoadsGdalAndNothingElse) {
    const auto files = loadedBy({"render", hills(), "--size", "64x48", "--out", picture()});
    EXPECT_THAT(files, Contains(HasSubstr("libgdal")));
    EXPECT_THAT(files, Contains(HasSubstr("stereonav_gdal.so")));
    expectNoneBig(files, "libgdal");
}

TEST_F(LazyLibraries, AVolumeFileLoadsNoReader) {
    const auto files =
        loadedBy({"render", maskedTube(), "--no-cache", "--size", "64x48", "--out", picture()});
    EXPECT_LT(files.size(), kMostWithoutModules);
    expectNoneBig(files);
}

TEST_F(LazyLibraries, ComparingMeasuresWithOpenCvButReadsNoFiles) {
    const auto files = loadedBy({"compare", "--size", "48x36", "--frames", "1", "--methods", "linear"});
    EXPECT_THAT(files, Contains(HasSubstr("libopencv_quality")));
    EXPECT_THAT(files, Each(Not(HasSubstr("libopencv_imgcodecs"))));
    EXPECT_THAT(files, Each(Not(HasSubstr("libjxl")))) << "not asked for";
    expectNoneBig(files, "libopencv");
    EXPECT_THAT(
        loadedBy({"compare", "--size", "48x36", "--frames", "1", "--methods", "linear", "--butteraugli"}),
        Contains(HasSubstr("libjxl")));
}

TEST_F(LazyLibraries, InfoListsWhatTheLoaderLoaded) {
    const std::string ground = hills(), study = maskedTube();
    const Json terrain = info({}).at("process"), dem = info({ground}).at("process"),
               colon = info({study, "--no-cache"}).at("process");
    EXPECT_THAT(terrain.at("modules"), IsEmpty());
    EXPECT_EQ(dem.at("modules"), Json({"gdal"}));
    EXPECT_THAT(colon.at("modules"), IsEmpty());
    for (const auto& [facts, arguments] :
         {std::pair(terrain, std::vector<std::string>{"info", "--size", "64x48"}),
          {dem, {"info", ground, "--size", "64x48"}},
          {colon, {"info", study, "--no-cache", "--size", "64x48"}}}) {
        const auto files = loadedBy(arguments);
        // The loader itself and what it loads before all others need no init.
        EXPECT_NEAR(static_cast<double>(facts.at("libraries").size()), static_cast<double>(files.size()),
                    3.0);
        for (const std::string name : facts.at("libraries"))
            if (name.find("/ld-linux") == std::string::npos) {
                EXPECT_THAT(files, Contains(name));
            }
    }
}

TEST_F(LazyLibraries, ThreadsAreThoseAskedFor) {
    const Json one = info({"--threads", "1"}), three = info({"--threads", "3"});
    EXPECT_EQ(one.at("process").at("threads_running"), 1);
    EXPECT_EQ(one.at("plan").at("threads"), 1);
    EXPECT_LE(three.at("process").at("threads_running"), 3);
    EXPECT_GE(three.at("process").at("threads_running"), 2);
}

// What a terrain is said to hold is what there is on the heap: no volume, distance field or illumination.
TEST_F(LazyLibraries, ATerrainHoldsItsGroundAndSkyAlone) {
    const Json json = info({});
    const Json& held = json.at("terrain").at("held");
    for (const char* what : {"heights", "height pyramid", "colour", "sky"}) {
        EXPECT_GT(held.at(what), 0) << what;
    }
    EXPECT_EQ(held.size(), 4u) << held;
    const double sum = json.at("terrain").at("bytes"), heap = json.at("process").at("heap_bytes");
    constexpr double kRest = 2e6;  // bytes of the command line, tables, the libraries: 0.6 MB when measured
    EXPECT_LT(heap, sum + kRest);
    EXPECT_GT(heap, sum);
    EXPECT_EQ(json.at("plan").at("planes"), Json({"color", "depth", "hole mask"}));
}

// Normals are kept where shading for the other eye asks for them, and there alone.
TEST_F(LazyLibraries, PlanesAreThoseThatShadingAsksFor) {
    const auto planes = [&](std::vector<std::string> more) {
        return info(std::move(more)).at("plan").at("planes");
    };
    const auto look = [&](const std::string& name, const std::string& specular) {
        return input(name, "[terrain]\nbuiltin = true\nsize = 65\n[look]\nspecular = " + specular + "\n");
    };
    const Json plain = Json({"color", "depth", "hole mask"});
    EXPECT_EQ(planes({hills()}), plain);
    EXPECT_EQ(planes({look("dull.toml", "0.0")}), plain);
    EXPECT_EQ(planes({look("shiny.toml", "0.5")}),
              Json({"color", "depth", "base color", "normal", "hole mask"}));
    EXPECT_EQ(planes({maskedTube(), "--no-cache"}), Json({"color", "depth", "normal", "hole mask"}));
    EXPECT_EQ(planes({maskedTube(), "--no-cache", "--opacity", "0.5"}),
              Json({"color", "depth", "depth spread", "hole mask"}));
}

TEST_F(LazyLibraries, AVolumeHoldsWhatItIsShownBy) {
    const Json colon = info({maskedTube(), "--no-cache"}).at("volume").at("held");
    for (const char* what : {"values", "lumen", "cells"}) {
        EXPECT_GT(colon.at(what), 0) << what;
    }
    EXPECT_EQ(colon.size(), 3u) << colon;
    const auto outside = [&](const char* look) {
        return info({ball(), "--isosurface", "--isovalue", "640", "--look", look}).at("volume").at("held");
    };
    const Json plain = outside("plain"), chosen = outside("auto");
    EXPECT_EQ(plain.size(), 2u) << plain;
    EXPECT_FALSE(plain.contains("lumen"));
    EXPECT_EQ(chosen.size(), 3u) << chosen;
    EXPECT_GT(chosen.at("sky"), 0);
}

}  // namespace
}  // namespace stereonav::test
