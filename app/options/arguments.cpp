// The command line, through CLI11: one subcommand for each function of commands.h.
#include "app/options/arguments.h"

#include <algorithm>
#include <CLI/CLI.hpp>
#include <functional>
#include <utility>

#include "app/command/commands.h"
#include "app/options/built_without.h"
#include "app/options/number_option.h"
#include "app/options/option_numbers.h"
#include "app/options/scene_arguments.h"
#include "engine/base/error.h"
#include "engine/light/spherical_harmonics.h"
#include "engine/stereo/quality_plan.h"

namespace stereonav {
namespace {

constexpr const char* kModeHelp = "how two eyes become one picture: ml, mr, sbsl, sbsr, tbl, irl, arcd, ... ";

constexpr NumberRange kSideRange = within(1, 32768, "pixels");
constexpr NumberRange kPathFrames = within(1, 1e6, "frames"), kComparedFrames = within(1, 100'000, "frames");
constexpr NumberRange kSeparationShare = within(0, 10);

// "500x400"; what memory there is for is checked where the size is used.
SizeOption sizeFromText(const std::string& text) {
    const std::size_t cross = std::min(text.find('x'), text.size());
    const std::string_view all(text), width = all.substr(0, cross);
    const std::string_view height = cross < text.size() ? all.substr(cross + 1) : "";
    try {
        return {static_cast<int>(wholeIn("", kSideRange, "", width)),
                static_cast<int>(wholeIn("", kSideRange, "", height))};
    } catch (const Error&) {
        throw Error("--size", "",
                    "expected WIDTHxHEIGHT, each " + rangeText(kSideRange) + ", got " + shownText(text),
                    "try 1280x720");
    }
}

// "0.0333" or "1/30".
double shareFromText(const std::string& text) {
    const std::size_t slash = std::min(text.find('/'), text.size());
    const auto whole = numberFromText(text.substr(0, slash));
    const auto parts = slash < text.size() ? numberFromText(text.substr(slash + 1)) : std::optional(1.0);
    if (!whole || !parts || !kSeparationShare.holds(*whole / *parts))
        throw Error("--relative-separation", "",
                    "expected " + rangeText(kSeparationShare) + " or a fraction, got " + shownText(text),
                    "try 1/30");
    return *whole / *parts;
}

// What the subcommands fill, and which of them runs.
struct Parsed {
    InfoOptions info;
    RenderOptions render;
    PlayOptions play;
    CompareOptions compare;
    ReportOptions report;
    MeshOptions mesh;
    CentrelineOptions centreline;
    BakeOptions bake;
    ViewOptions view;
    std::function<int()> run = runDefault;
};

void addSize(CLI::App& command, SizeOption& size, const char* fallback) {
    const auto take = [&size](const CLI::results_t& texts) {
        for (const std::string& text : texts) size = sizeFromText(text);
        return true;
    };
    command
        .add_option("--size", take,
                    std::string("WIDTHxHEIGHT of one eye, ") + fallback + " when left out (each " +
                        rangeText(kSideRange) + ")")
        ->type_name(kNumbersValue);
}

void addRelativeSeparation(CLI::App& command, double& share) {
    const auto take = [&share](const CLI::results_t& texts) {
        for (const std::string& text : texts) share = shareFromText(text);
        return true;
    };
    command
        .add_option("--relative-separation", take,
                    "separation as a share of the zero-parallax distance, as in 1/30 (" +
                        rangeText(kSeparationShare) + ")")
        ->type_name(kNumberValue);
}

void addInfo(CLI::App& app, Parsed& parsed) {
    CLI::App& command = *app.add_subcommand("info", "print what was read and the frame plan");
    addScene(command, parsed.info.scene);
    addMedium(command, parsed.info.scene.medium);
    addSize(command, parsed.info.size, "1280x720");
    command.add_flag("--json", parsed.info.json, "as JSON");
    command.add_option(
        "--series-pictures", parsed.info.series,
        "of a DICOM folder: list its series alone, and write a picture of each into this folder");
    command.callback([&parsed] { parsed.run = [&parsed] { return runInfo(parsed.info); }; });
}

void addQuality(CLI::App& command, QualityOptions& options) {
    constexpr const char* kGroup = "Options of quality";
    const auto number = [&](const char* name, auto& value, const NumberRange& range, const char* help,
                            const char* advice) {
        addNumber(command, name, value, range, help, advice)->group(kGroup);
    };
    number(
        "--quality", options.quality, within(0, 1),
        "the share of the warp's expected squared error that is taken away by casting those pixels as well; "
        "1 casts all",
        "0 casts the holes alone, 1 every pixel");
    number("--target-psnr", options.targetPsnr_db, within(1, kMostPsnr_db, "dB"),
           "against a full cast that 95 of 100 frames shall reach: as many pixels as that takes",
           "40 is good, 50 hard to see");
    number("--target-ms", options.target_ms, within(1e-3, 1e6, "ms"),
           "time for a frame, both eyes: no more pixels are cast than fit; where none do, pictures are made "
           "smaller",
           "33 is 30 frames a second");
}

void addRender(CLI::App& app, Parsed& parsed) {
    RenderOptions& options = parsed.render;
    CLI::App& command = *app.add_subcommand("render", "one pose into a picture");
    addScene(command, options.scene);
    addQuality(command, options.scene.quality);
    addMedium(command, options.scene.medium);
    addTraced(command, options.scene.traced.emplace());
    addSize(command, options.size, "1280x720");
    addNumbers(command, "--pose", options.pose, poseNumbers(), "where the head is; left out: the start pose");
    command.add_option("--method", options.method, "how the right eye is made, auto: the best");
    command.add_option("--mode", options.mode, kModeHelp);
    command.add_option("--out", options.out, "the picture's file; -: PNG to standard output")->required();
    command.callback([&parsed] { parsed.run = [&parsed] { return runRender(parsed.render); }; });
}

void addPlay(CLI::App& app, Parsed& parsed) {
    PlayOptions& options = parsed.play;
    CLI::App& command = *app.add_subcommand("play", "a flight into pictures, a video, or a hash");
    addScene(command, options.scene);
    addQuality(command, options.scene.quality);
    addMedium(command, options.scene.medium);
    addSize(command, options.size, "1280x720");
    command.add_option("--path", options.path,
                       "a recorded path (.gltf, .glb, .path); left out: the scene's own");
    command.add_option("--method", options.method, "how the right eye is made, auto: the best");
    command.add_option("--mode", options.mode, kModeHelp);
    command.add_option("--out", options.out, "folder for frame_00000.png and so on");
    command.add_option("--video", options.video, "a video: .mp4, .avi or .mkv (lossless)");
    addNumber(command, "--frames", options.frames, kPathFrames, "this many, evenly over the path",
              "leave it out for the whole path at --fps");
    addNumber(command, "--fps", options.fps, within(0.001, 1000, "frames a second"), "25 when left out",
              "25 is common");
    command.add_flag("--hash", options.hash, "print one content hash of both eyes of all frames");
    command.callback([&parsed] { parsed.run = [&parsed] { return runPlay(parsed.play); }; });
}

void addCompare(CLI::App& app, Parsed& parsed) {
    CompareOptions& options = parsed.compare;
    CLI::App& command = *app.add_subcommand("compare", "measure the ways of making the right eye");
    addScene(command, options.scene);
    addMedium(command, options.scene.medium);
    addSize(command, options.size, "500x400");
    command.add_option("--path", options.path,
                       "a recorded path (.gltf, .glb, .path); left out: the scene's own");
    addNumber(command, "--frames", options.frames, kComparedFrames, "evenly over the path, 24 when left out",
              "24 is the default");
    command.add_option("--methods", options.methods, "some of them, as in full,paper,linear; left out: all")
        ->delimiter(',')
        ->allow_extra_args(false);  // the next word is the scene's, not another method
    addRelativeSeparation(command, options.relativeSeparation);
    command.add_option("--json", options.json, "figures as JSON; -: to standard output");
    command.add_option("--csv", options.csv, "figures as CSV; -: to standard output");
    command.add_option("--images", options.images, "folder for pictures of the flight's middle frame");
    command.add_option("--plot", options.plot, "error against time as a picture");
    addNumber(command, "--repeats", options.repeats, within(1, 1000, "runs"),
              "timed ones of a frame, the fastest counts; 3 when left out", "3 is the default");
    command.callback([&parsed] { parsed.run = [&parsed] { return runCompare(parsed.compare); }; });
}

void addReport(CLI::App& app, Parsed& parsed) {
    ReportOptions& options = parsed.report;
    CLI::App& command = *app.add_subcommand(
        "report", "a page of error against time for every shortcut the program takes; up to 10 minutes");
    command.add_option("--out", options.out,
                       "folder for index.html, report.json, report.csv; report when left out");
    command.add_flag("--quick", options.quick, "within a minute: fewer frames and repeats");
    command
        .add_option("--scene", options.scenes, "a scene beside the built-in ones; may be given several times")
        ->allow_extra_args(false);
    command.add_option("--up", options.up, kUpHelp);
    command.add_option(
        "--compare", options.compare,
        "an earlier run's report.json: shows what moved, exit status 1 where something got worse");
    command.add_option("--stability", options.stability,
                       "rows that the stability tests wrote, as JSON lines");
    addNumber(command, "--threads", options.threads, kThreadsRange, kThreadsHelp, kThreadsAdvice);
    addNumber(command, "--seed", options.seed, within(0, 9e18), "of everything random", "1 is the default");
    addNumber(command, "--minutes", options.minutes, above(0, 1440, "minutes"),
              "for all of it: about 9 when left out, 1 with --quick", "a fraction is fine");
    command.add_option("--parts", options.parts, "some of it, as in right-eye,light; left out: all")
        ->delimiter(',')
        ->allow_extra_args(false);
    command.add_flag("--papers", options.papers,
                     "the papers' own tables beside what this program does, in the place of the charts");
    command.add_option(
        "--data", options.data,
        "folder with real data for --papers, as docs/testing.md lists it; built-in scenes stand in");
    command.callback([&parsed] { parsed.run = [&parsed] { return runReport(parsed.report); }; });
}

void addMesh(CLI::App& app, Parsed& parsed) {
    MeshOptions& options = parsed.mesh;
    CLI::App& command = *app.add_subcommand("mesh", "the ground with its colour as a glTF mesh");
    command.add_option("SCENE", options.scene.scene, kTerrainHelp);
    addGround(command, options.scene);
    command.add_option("--image", options.scene.image, kImageHelp);
    command.add_flag("--shade-image", options.scene.shadeImage, kShadeImageHelp);
    addNumbers(command, "--sun", options.scene.sun, sunNumbers(), kSunHelp);
    addThreads(command, options.scene);
    command.add_option("--out", options.out, "the mesh's file, .glb or .gltf")->required();
    addNumber(command, "--error", options.error_m, within(0, 1e9, "metres"),
              "largest vertical error, half a sample spacing when left out",
              "leave it out for half a sample spacing");
    command.callback([&parsed] { parsed.run = [&parsed] { return runMesh(parsed.mesh); }; });
}

void addCentreline(CLI::App& app, Parsed& parsed) {
    CentrelineOptions& options = parsed.centreline;
    CLI::App& command =
        *app.add_subcommand("centreline", "the way through a colon, with its radii, as a file");
    command.add_option("SCENE", options.scene.scene, kStudyHelp);
    addThreads(command, options.scene);
    addStudy(command, options.scene.volume);
    command
        .add_option(
            "--out", options.out,
            "the line's file, .vtp or .vtk (poly data) or .txt, or -; millimetres, LPS, from the rectum")
        ->required();
    command.callback([&parsed] { parsed.run = [&parsed] { return runCentreline(parsed.centreline); }; });
}

// The light that is baked has other words than the light that scenes are shown in.
void addBakedLight(CLI::App& command, BakeOptions& options) {
    addNumbers(command, "--light", options.lights, pointLightNumbers(), kPointLightHelp);
    command.add_option("--probe", options.probe, "light from all around: a light probe (.hdr) or a picture");
    addNumbers(command, "--sky", options.scene.sky, skyNumbers(), "of a volume: light from everywhere");
    addNumber(command, "--bounces", options.bounces, kBouncesRange, kBouncesHelp, kBouncesAdvice);
    addNumbers(command, "--albedo", options.albedo, albedoNumbers(), kAlbedoHelp);
    addNumber(command, "--order", options.order, within(1, kMaxHarmonicsOrder), "of transfer's harmonics",
              "5 is usual");
}

void addBake(CLI::App& app, Parsed& parsed) {
    BakeOptions& options = parsed.bake;
    CLI::App& command = *app.add_subcommand(
        "bake", "light worked out before, with bounces and soft shadows; Ctrl-C keeps what is done");
    addSource(command, options.scene);
    addBakedLight(command, options);
    command.add_option("--what", options.what,
                       "irradiance, transfer (light can be turned later), or openness");
    addNumber(command, "--samples", options.samples, kSamplesRange,
              "of each texel, 256 when nothing is said; of a terrain 32, each bounce", kSamplesAdvice);
    addNumber(command, "--error", options.error, {0, 1, true, true}, "go on until the relative error is this",
              "0.02 is two percent");
    addNumber(command, "--minutes", options.minutes, above(0, 1e6, "minutes"), "go on for so long",
              "a fraction is fine");
    addNumber(command, "--resolution", options.resolution, within(0.001, 8, "texels a voxel"),
              "along each axis; of a terrain baked samples a height sample, at most 1", "use 0.5, 1 or 2");
    addNumbers(command, "--isovalues", options.isovalues, isovaluesNumbers(),
               "all surfaces between, to choose from later");
    addNumber(command, "--reach", options.reach_mm, kReachRange,
              "that rays look for light from outside: what meets nothing within them is open; "
              "left out: no limit, in a colon its mean radius for openness",
              kReachAdvice);
    command.add_flag("--full", options.full, "every texel, for any isovalue");
    command.add_option("--out", options.out, "the bake's file; left out: in the cache");
    command.callback([&parsed] { parsed.run = [&parsed] { return runBake(parsed.bake); }; });
}

void addView(CLI::App& app, Parsed& parsed) {
    ViewOptions& options = parsed.view;
    CLI::App& command = *app.add_subcommand("view", "fly through the scene in a window");
    addScene(command, options.scene);
    addQuality(command, options.scene.quality);
    addMedium(command, options.scene.medium);
    addSize(command, options.size, "1280x720");
    command.add_option("--method", options.method,
                       "how the right eye is made, auto: what measures best here");
    command.add_option("--mode", options.mode, kModeHelp);
    command.add_option("--path", options.path, "a recorded path (.gltf, .glb, .path) for Z to play");
    command.add_option("--sweep", options.sweep,
                       "where a medium is swept: cpu, gpu (OpenGL 4.5), or auto, what is faster here");
    command.add_option("--shots", options.shots, "folder for saved pictures and recorded flights");
    command.callback([&parsed] { parsed.run = [&parsed] { return runView(parsed.view); }; });
}

// The name of the subcommand that was being parsed, with a blank before it; "" when none.
std::string commandIn(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? "" : " " + chosen.front()->get_name();
}

// CLI11's refusals in our words: which option or word, what is wrong with it, what to do.
Error refusalOf(const CLI::App& app, const CLI::ParseError& error) {
    const std::string help = "see stereonav" + commandIn(app) + " --help";
    const std::string said = error.what();
    const std::string option = said.substr(0, said.find(':'));
    if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
        const std::vector<std::string> left = app.remaining(true);
        const std::string word = left.empty() ? said : left.front();
        const bool dashes = word.starts_with("-");
        return {word, "",
                dashes                   ? "there is no such option here"
                : commandIn(app).empty() ? "there is no such command"
                                         : "is one word too many",
                help};
    }
    if (dynamic_cast<const CLI::RequiredError*>(&error))
        return {said.substr(0, said.find(' ')), "", "is required", help};
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) && said.starts_with("--"))
        return {option, "",
                said.find("At Most") != std::string::npos ? "is given more than once"
                                                          : "expected a value, found none",
                help};
    return {"", "", said, help};
}

void addCommands(CLI::App& app, Parsed& parsed) {
    addInfo(app, parsed);
    addRender(app, parsed);
    addPlay(app, parsed);
    addCompare(app, parsed);
    addReport(app, parsed);
    addMesh(app, parsed);
    addCentreline(app, parsed);
    addBake(app, parsed);
    addView(app, parsed);
}

}  // namespace

int runCommandLine(int argc, char** argv) {
    CLI::App app{"Stereo flight through terrain and the colon, with the second eye warped and measured",
                 "stereonav"};
    app.set_version_flag("--version", versionText());
    app.require_subcommand(0, 1);
    app.footer(
        "Without a command: flies the built-in terrain, or, where there is no display, plays it to out/.");
    Parsed parsed;
    addCommands(app, parsed);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
        throw refusalOf(app, error);
    }
    return parsed.run();
}

void checkCommandLine(const std::vector<std::string>& arguments) {
    CLI::App app;
    Parsed parsed;
    addCommands(app, parsed);
    try {
        app.parse(std::vector<std::string>{arguments.rbegin(), arguments.rend()});  // as CLI11 takes them
    } catch (const CLI::ParseError& error) {
        throw refusalOf(app, error);
    }
}

std::vector<OptionFacts> optionsOfCommands() {
    CLI::App app;
    Parsed parsed;
    addCommands(app, parsed);
    std::vector<OptionFacts> facts;
    for (const CLI::App* command : app.get_subcommands({}))
        for (const CLI::Option* option : command->get_options())
            if (option->get_items_expected_max() > 0)  // flags take no value
                facts.push_back(
                    {command->get_name(), option->get_name(),
                     option->get_type_name() == kNumberValue || option->get_type_name() == kNumbersValue});
    return facts;
}

RenderOptions renderOptionsFrom(const std::vector<std::string>& arguments) {
    CLI::App app;
    Parsed parsed;
    addRender(app, parsed);
    std::vector<std::string> words{arguments.rbegin(), arguments.rend()};  // as CLI11 takes them
    words.push_back("render");
    try {
        app.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        throw refusalOf(app, error);
    }
    return parsed.render;
}

}  // namespace stereonav
