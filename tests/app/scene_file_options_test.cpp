// Options in scene files and behind --set: the same as on the command line, which wins.
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "app/command/arguments.h"
#include "app/options/command.h"
#include "app/options/completion.h"
#include "app/options/man_page.h"
#include "app/options/option_page.h"
#include "app/options/pages.h"
#include "app/scene/scene_type_table.h"
#include "engine/base/error.h"
#include "engine/image/stereo_compose.h"
#include "engine/medium/sweep/swept_frames.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

using Words = std::vector<std::string>;

class SceneFileOptionsTest : public VolumeTest {
protected:
    // Returns what bash offers behind these words, a line each.
    std::string offeredBy(const std::string& script, const std::string& line) const {
        const std::string out = (mFolder / "offered").string();
        const std::string command = "bash -c 'set -eu; source " + script + "; COMP_WORDS=(" + line +
                                    "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _stereonav; printf \"%s\\n\" "
                                    "\"${COMPREPLY[@]}\"' > " +
                                    out;
        EXPECT_EQ(std::system(command.c_str()), 0) << line;
        return "\n" + contentOf(out);
    }
    std::string toml(const std::string& text) const { return input("scene.toml", text); }

    static RenderOptions asked(Words words) {
        words.insert(words.end(), {"--out", "a.png"});
        return renderOptionsFrom(words);
    }
    static std::string lineOf(const Words& words) {
        try {
            asked(words);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
    // Returns what `render` writes.
    std::string picture(Words words) const {
        words.insert(words.begin(), "render");
        words.insert(words.end(), {"--out", "p.png", "--size", "64x48"});
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return contentOf(place() / "p.png");
    }
};

TEST_F(SceneFileOptionsTest, AreThoseOfTheCommandLine) {
    const std::string file = toml(
        "[terrain]\nbuiltin = true\n[options]\nvertical-scale = 2\nfov = 60.5\nsun = [90, 30]\n"
        "open-holes = false\nmode = \"arcd\"\nsize = \"64x48\"\nthreads = 1\n");
    const RenderOptions options = asked({file});
    EXPECT_EQ(options.scene.scene, file);
    EXPECT_EQ(options.scene.verticalScale, 2);
    EXPECT_EQ(options.scene.fov_deg, 60.5);
    ASSERT_TRUE(options.scene.sun);
    EXPECT_NEAR(options.scene.sun->azimuth, 1.5708, 1e-4);
    EXPECT_FALSE(options.scene.openHoles);
    EXPECT_EQ(options.mode, OutputMode::RedCyanDubois);
    EXPECT_EQ(options.size.width, 64);
    EXPECT_EQ(options.scene.threads, 1);
    const std::string plain = input("plain.toml", "[terrain]\nbuiltin = true\n");
    EXPECT_TRUE(picture({file}) == picture({plain, "--vertical-scale", "2", "--fov", "60.5", "--sun", "90,30",
                                            "--mode", "arcd"}));
    EXPECT_FALSE(picture({file}) == picture({plain, "--mode", "arcd"}));
}

TEST_F(SceneFileOptionsTest, GiveWayToTheCommandLine) {
    const std::string file =
        toml("scene = \"colon\"\n[options]\nfov = 60\ntransfer = \"wall_95\"\nseparation = 0.001\n");
    EXPECT_EQ(asked({file, "--fov", "70"}).scene.fov_deg, 70);
    EXPECT_EQ(asked({file, "--set", "fov=71"}).scene.fov_deg, 71);
    const RenderOptions options = asked({file, "--opacity", "0.5"});
    EXPECT_EQ(options.scene.volume.opacity, 0.5);
    EXPECT_EQ(options.scene.volume.transfer, "") << "which --opacity excludes";
    EXPECT_EQ(options.scene.separation_m, 0.001);
}

TEST_F(SceneFileOptionsTest, NameAStudyBesideThem) {
    const std::string study = ball();
    const std::string file = toml("scene = \"" + std::filesystem::path(study).filename().string() +
                                  "\"\n[options]\nisosurface = true\nisovalue = 150\nshading = \"phong\"\n"
                                  "seed = []\n");
    EXPECT_NE(lineOf({file}).find("scene.toml:6"), std::string::npos) << lineOf({file});
    const std::string good = toml("scene = \"" + std::filesystem::path(study).filename().string() +
                                  "\"\n[options]\nisosurface = true\nisovalue = 150\nshading = \"phong\"\n");
    EXPECT_EQ(asked({good}).scene.scene, study);
    EXPECT_TRUE(picture({good}) ==
                picture({study, "--isosurface", "--isovalue", "150", "--shading", "phong"}));
    const std::string medium = toml("scene = \"wax\"\n[options]\nslices = 16\nmodel = \"direct\"\n");
    EXPECT_TRUE(picture({medium}) == picture({"wax", "--slices", "16", "--model", "direct"}));
}

TEST_F(SceneFileOptionsTest, SeveralValuesAreLists) {
    const std::string file = toml("scene = \"colon\"\n[options]\nseed = [[1, 2, 3], [4, 5, 6]]\n");
    const std::vector<glm::dvec3> seeds = asked({file}).scene.volume.seeds;
    ASSERT_EQ(seeds.size(), 2u);
    EXPECT_EQ(seeds[1], glm::dvec3(4, 5, 6) / 1000.0);
    const RenderOptions lamps =
        asked({toml("scene = \"colon\"\n[options]\nlight = \"traced\"\npoint-light = [\"centreline,0.1\", "
                    "\"0.1,0,0.3,2\"]\n")});
    ASSERT_EQ(lamps.scene.traced->lights.size(), 2u);
    EXPECT_TRUE(lamps.scene.traced->lights[0].centreline);
    EXPECT_EQ(lamps.scene.traced->lights[1].intensity, 2);
}

TEST_F(SceneFileOptionsTest, FilesAreRelativeToTheScene) {
    std::filesystem::create_directory(mFolder / "look");
    input("look/glass.txt", "reference_mm 1\n-100 1 1 1 0.5\n100 1 1 1 0.5\n");
    const std::string file = toml("scene = \"colon\"\n[options]\ntransfer = \"look/glass.txt\"\n");
    EXPECT_EQ(asked({file}).scene.volume.transfer, (mFolder / "look/glass.txt").string());
    EXPECT_EQ(asked({toml("scene = \"colon\"\n[options]\ntransfer = \"wall_95\"\n")}).scene.volume.transfer,
              "wall_95");
    EXPECT_EQ(asked({toml("[terrain]\nbuiltin = true\n[options]\nimage = \"a.png\"\n")}).scene.image,
              (mFolder / "a.png").string());
    EXPECT_EQ(asked({toml("[terrain]\nbuiltin = true\n[options]\nlight = \"auto\"\n")}).scene.light.kind,
              LightChoice::Kind::Auto);
}

TEST_F(SceneFileOptionsTest, ThatAreWrongAreOneLineWithTheirPlace) {
    const auto refused = [&](const std::string& text, const std::vector<std::string>& words) {
        expectRefused({"render", toml(text), "--out", "a.png"}, words);
    };
    const std::string ground = "[terrain]\nbuiltin = true\n[options]\n";
    refused(ground + "fof = 40\n", {"scene.toml:4: unknown key \"fof\" in [options]", "nearest: \"fov\""});
    refused(ground + "siez = 40\n", {"scene.toml:4: unknown key \"siez\"", "nearest: \"size\""});
    refused(ground + "out = \"b.png\"\n", {"scene.toml:4: unknown key \"out\""});
    refused(ground + "fov = 0\n", {"scene.toml:4: fov: expected 1 to 170 degrees, got \"0\"; 45 is common"});
    refused(ground + "fov = \"wide\"\n", {"scene.toml:4: fov: expected 1 to 170 degrees, got \"wide\""});
    refused(ground + "fov = nan\n", {"scene.toml:4: fov: expected"});
    refused(ground + "sun = [1, 2, 3]\n", {"scene.toml:4: sun: expected azimuth,elevation"});
    refused(ground + "sun = [\"1,2\", \"3,4\"]\n", {"scene.toml:4: sun: expected one value, got several"});
    refused(ground + "open-holes = 3\n", {"scene.toml:4: open-holes: expected true or false"});
    refused(ground + "mode = \"magic\"\n", {"scene.toml:4: mode: there is no output mode \"magic\""});
    refused(ground + "isovalue = 3\nslices = 8\n",
            {"scene.toml:4: isovalue: only for CT studies", "scene.toml:5: slices: needs a medium"});
    refused("fov = 3\n[terrain]\nbuiltin = true\n", {"scene.toml:1: unknown key \"fov\""});
    refused("scene = \"colon\"\n[terrain]\nbuiltin = true\n", {"scene.toml:2: unknown key \"terrain\""});
    refused("scene = \"nowhere.nrrd\"\n", {"nowhere.nrrd: no such file"});
    refused("scene = \"other.toml\"\n", {"scene.toml", "another scene file"});
    refused("scene = 3\n", {"scene.toml:1", "expected text in quotes, got 3"});
}

// A file is used with all commands: what is of one of them alone does not disturb the others.
TEST_F(SceneFileOptionsTest, OfOtherCommandsAreLeftAside) {
    const std::string file = toml(
        "[terrain]\nbuiltin = true\n[options]\nquality = 0.5\nsamples = 8\nfov = 50\nmethod = \"linear\"\n");
    EXPECT_NO_THROW(checkWholeCommandLine({"info", file}));
    EXPECT_NO_THROW(checkWholeCommandLine({"mesh", file, "--out", "a.glb"}));
    EXPECT_NO_THROW(checkWholeCommandLine({"bake", file}));
    EXPECT_NE(lineOf({file}).find("samples: needs --light traced"), std::string::npos);
}

TEST_F(SceneFileOptionsTest, SetGivesAnyOption) {
    EXPECT_EQ(asked({"terrain", "--set", "fov=40", "--set", "sun=90,30"}).scene.fov_deg, 40);
    EXPECT_TRUE(asked({"colon", "--set", "isosurface=true"}).scene.volume.isosurface);
    EXPECT_EQ(asked({"colon", "--set", "seed=1,2,3", "--set", "seed=4,5,6"}).scene.volume.seeds.size(), 2u);
    EXPECT_EQ(lineOf({"terrain", "--set", "fov=0"}),
              "--set fov: expected 1 to 170 degrees, got \"0\"; 45 is common");
    EXPECT_EQ(
        lineOf({"terrain", "--set", "fof=0"}),
        "--set: expected KEY=VALUE with an option's key, got \"fof=0\"; as in --set fov=45; see stereonav "
        "render --help");
    for (const char* wrong : {"fov", "=3", "", "SCENE=x", "set=fov=3"})
        EXPECT_TRUE(lineOf({"terrain", "--set", wrong}).starts_with("--set: expected KEY=VALUE")) << wrong;
    EXPECT_EQ(lineOf({"terrain", "--fov", "40", "--set", "fov=50"}),
              "--set fov: is given more than once; leave one of them out");
    EXPECT_EQ(lineOf({"terrain", "--set", "isovalue=3"}).substr(0, 16), "--set isovalue: ");
}

// Written anew by: stereonav options > docs/options.md
TEST_F(SceneFileOptionsTest, ThePageIsThatOfTheTable) {
    EXPECT_EQ(contentOf(STEREONAV_SOURCE_DIR "/docs/options.md"), optionPage())
        << "run: build/release/bin/stereonav options > docs/options.md";
    EXPECT_EQ(run({"options"}).out, optionPage());
    for (const Option& option : optionTable())
        EXPECT_NE(optionPage().find("`" + option.name()), std::string::npos) << option.name();
}

// Returns what roff makes of a page's lines, without their filling and fonts.
std::string readAsText(std::string page) {
    const auto replaceAll = [&](const std::string& what, const std::string& by) {
        for (std::size_t at = page.find(what); at != std::string::npos; at = page.find(what, at + by.size()))
            page.replace(at, what.size(), by);
    };
    for (const auto& [what, by] : {std::pair{"\\-", "-"}, {"\\&", ""}, {"\\e", "\\"}, {"\n", " "}})
        replaceAll(what, by);
    return page;
}

TEST_F(SceneFileOptionsTest, TheManPageNamesEveryCommandAndOption) {
    const std::string page = manPage(), text = readAsText(page);
    EXPECT_EQ(run({"man"}).out, page);
    for (const Command& command : commands())
        for (const std::string& entry : {std::string(" \\fBstereonav ") + command.name + "\\fR ",
                                         std::string(".TP \\fB") + command.name + "\\fR " + command.help})
            EXPECT_NE(text.find(entry), std::string::npos) << entry;
    for (const PageFacts& facts : pageFacts())
        EXPECT_NE(text.find(std::string(".TP \\fB") + facts.name + "\\fR"), std::string::npos) << facts.name;
    for (const Option& option : optionTable()) {
        const std::string font = option.positional() ? "\\fI" : "\\fB";
        const std::size_t head = text.find(".TP " + font + option.name() + "\\fR");
        ASSERT_NE(head, std::string::npos) << option.name();
        EXPECT_NE(text.find(helpLine(option), head), std::string::npos)
            << option.name();  // unit, range, default
    }
    for (const char* name : {"SYNOPSIS", "\"EXIT STATUS\"", "FILES", "ENVIRONMENT", "EXAMPLES"})
        EXPECT_NE(page.find(std::string("\n.SH ") + name + "\n"), std::string::npos) << name;
    // No text is taken for a request.
    const std::set<std::string> requests{".\\\"", ".TH", ".SH", ".SS", ".TP", ".PP", ".br"};
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) {
        EXPECT_FALSE(line.empty() || line[0] == '\'');
        if (line[0] == '.') {
            EXPECT_TRUE(requests.contains(line.substr(0, 3))) << line;
        }
    }
}

TEST_F(SceneFileOptionsTest, BashCompletesEveryOption) {
    const std::string script = input("completion.bash", run({"completion", "bash"}).out);
    EXPECT_EQ(contentOf(script), bashCompletion());
    const auto offered = [&](const std::string& line) { return offeredBy(script, line); };
    for (const Command& command : commands()) {
        const std::string options = offered(std::string("stereonav ") + command.name + " --");
        for (const Option& option : optionTable())
            if ((option.commands & command.command) && !option.positional()) {
                EXPECT_NE(options.find("\n" + option.name() + "\n"), std::string::npos)
                    << command.name << " " << option.name();
            }
    }
    EXPECT_NE(offered("stereonav \"\"").find("\nrender\n"), std::string::npos);
    EXPECT_NE(offered("stereonav \"\"").find("\nman\n"), std::string::npos);
    EXPECT_EQ(offered("stereonav completion \"\""), "\nbash\n");
    EXPECT_EQ(offered("stereonav render --simd av"), "\navx2\navx512\n");
    EXPECT_EQ(offered("stereonav view --shading phong"), "\nphong\nphong-shadows\n");
}

TEST_F(SceneFileOptionsTest, BashCompletesWhatAnOptionTakes) {
    const std::string script = input("completion.bash", bashCompletion());
    const auto offered = [&](const std::string& line) { return offeredBy(script, line); };
    for (const OutputModeInfo& mode : outputModes()) {
        const std::string word = "\n" + std::string(mode.shortName) + "\n";
        EXPECT_NE(offered("stereonav view --mode \"\"").find(word), std::string::npos) << word;
        const bool written = offered("stereonav render --mode \"\"").find(word) != std::string::npos;
        EXPECT_EQ(written, fitsInPicture(mode.mode)) << word;
    }
    for (const std::string_view method : kSweepMethods)
        EXPECT_NE(offered("stereonav view --method \"\"").find("\n" + std::string(method) + "\n"),
                  std::string::npos)
            << method;
    EXPECT_EQ(offered("stereonav view --paint hill"), "\nhillshade\n");
    EXPECT_EQ(offered("stereonav view --method sel"), "\nselective\n");
    EXPECT_EQ(offered("stereonav view --ambient-method g"), "\ngaussian\n");
    for (const SceneType* type : sceneTypes())
        for (const std::string_view name : type->builtIn)
            if (!name.empty()) {
                EXPECT_NE(offered("stereonav view \"\"").find("\n" + std::string(name) + "\n"),
                          std::string::npos)
                    << name;
            }
    EXPECT_EQ(offered("stereonav unfold co").substr(0, 7), "\ncolon\n");
}

}  // namespace
}  // namespace stereonav::test
