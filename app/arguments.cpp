// The command line, through CLI11: one subcommand for each function of commands.h.
#include "app/arguments.h"

#include <charconv>
#include <CLI/CLI.hpp>
#include <functional>
#include <utility>

#include "app/built_without.h"
#include "app/commands.h"
#include "app/scene_arguments.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr const char* kModeHelp = "how two eyes become one picture: ml, mr, sbsl, sbsr, tbl, irl, arcd, ... ";

bool parseWhole(std::string_view text, int& value) {
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    return result.ec == std::errc() && result.ptr == text.data() + text.size();
}

// "500x400"; the range is checked where the size is used.
SizeOption sizeFromText(const std::string& text) {
    SizeOption size;
    const std::size_t cross = text.find('x');
    if (cross == std::string::npos || !parseWhole(std::string_view(text).substr(0, cross), size.width) ||
        !parseWhole(std::string_view(text).substr(cross + 1), size.height))
        throw Error("--size", "", "expected WIDTHxHEIGHT in pixels, got \"" + text + "\"", "try 1280x720");
    return size;
}

// "0.0333" or "1/30".
double shareFromText(const std::string& text) {
    const std::size_t slash = text.find('/');
    const auto number = [&](const std::string& part) {
        std::size_t used = 0;
        double value = 0;
        try {
            value = std::stod(part, &used);
        } catch (const std::exception&) {
        }
        if (used == 0 || used != part.size())
            throw Error("--relative-separation", "", "expected a number or a fraction, got \"" + text + "\"",
                        "try 1/30");
        return value;
    };
    if (slash == std::string::npos) return number(text);
    return number(text.substr(0, slash)) / number(text.substr(slash + 1));
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
    std::string size, relativeSeparation;
    std::function<int()> run = runDefault;

    // Runs after parsing: texts become values here, so that their errors name the option.
    void addSize(CLI::App& command, const char* fallback) {
        command.add_option("--size", size, std::string("pixels of one eye, ") + fallback + " when left out");
    }
    void takeSize(SizeOption& option) const {
        if (!size.empty()) option = sizeFromText(size);
    }
};

void addInfo(CLI::App& app, Parsed& parsed) {
    CLI::App& command = *app.add_subcommand("info", "print what was read and the frame plan");
    addScene(command, parsed.info.scene);
    addMedium(command, parsed.info.scene.medium);
    parsed.addSize(command, "1280x720");
    command.add_flag("--json", parsed.info.json, "as JSON");
    command.callback([&parsed] {
        parsed.run = [&parsed] {
            parsed.takeSize(parsed.info.size);
            return runInfo(parsed.info);
        };
    });
}

void addQuality(CLI::App& command, QualityOptions& options) {
    constexpr const char* kGroup = "Options of quality";
    command
        .add_option(
            "--quality", options.quality,
            "0 to 1: the share of the warp's expected squared error that is taken away by casting those "
            "pixels as well; 1 casts all")
        ->group(kGroup);
    command
        .add_option("--target-psnr", options.targetPsnr_db,
                    "dB against a full cast that 95 of 100 frames shall reach: as many pixels as that takes")
        ->group(kGroup);
    command
        .add_option(
            "--target-ms", options.target_ms,
            "time for a frame, both eyes: no more pixels are cast than fit; where none do, pictures are made "
            "smaller")
        ->group(kGroup);
}

void addRender(CLI::App& app, Parsed& parsed) {
    RenderOptions& options = parsed.render;
    CLI::App& command = *app.add_subcommand("render", "one pose into a picture");
    addScene(command, options.scene);
    addQuality(command, options.scene.quality);
    addMedium(command, options.scene.medium);
    addTraced(command, options.scene.traced.emplace());
    parsed.addSize(command, "1280x720");
    command.add_option("--pose", options.pose,
                       "x,y,z,heading,pitch,roll in metres and degrees; left out: the start pose");
    command.add_option("--method", options.method, "how the right eye is made, auto: the best");
    command.add_option("--mode", options.mode, kModeHelp);
    command.add_option("--out", options.out, "the picture's file; -: PNG to standard output")->required();
    command.callback([&parsed] {
        parsed.run = [&parsed] {
            parsed.takeSize(parsed.render.size);
            return runRender(parsed.render);
        };
    });
}

void addPlay(CLI::App& app, Parsed& parsed) {
    PlayOptions& options = parsed.play;
    CLI::App& command = *app.add_subcommand("play", "a flight into pictures, a video, or a hash");
    addScene(command, options.scene);
    addQuality(command, options.scene.quality);
    addMedium(command, options.scene.medium);
    parsed.addSize(command, "1280x720");
    command.add_option("--path", options.path,
                       "a recorded path (.gltf, .glb, .path); left out: the scene's own");
    command.add_option("--method", options.method, "how the right eye is made, auto: the best");
    command.add_option("--mode", options.mode, kModeHelp);
    command.add_option("--out", options.out, "folder for frame_00000.png and so on");
    command.add_option("--video", options.video, "a video: .mp4, .avi or .mkv (lossless)");
    command.add_option("--frames", options.frames, "this many frames evenly over the path")
        ->check(CLI::PositiveNumber);
    command.add_option("--fps", options.fps, "frames a second");
    command.add_flag("--hash", options.hash, "print one content hash of both eyes of all frames");
    command.callback([&parsed] {
        parsed.run = [&parsed] {
            parsed.takeSize(parsed.play.size);
            return runPlay(parsed.play);
        };
    });
}

void addCompare(CLI::App& app, Parsed& parsed) {
    CompareOptions& options = parsed.compare;
    CLI::App& command = *app.add_subcommand("compare", "measure the ways of making the right eye");
    addScene(command, options.scene);
    addMedium(command, options.scene.medium);
    parsed.addSize(command, "500x400");
    command.add_option("--path", options.path,
                       "a recorded path (.gltf, .glb, .path); left out: the scene's own");
    command.add_option("--frames", options.frames, "frames evenly over the path, 24 when left out");
    command.add_option("--methods", options.methods, "some of them, as in full,paper,linear; left out: all")
        ->delimiter(',')
        ->allow_extra_args(false);  // the next word is the scene's, not another method
    command.add_option("--relative-separation", parsed.relativeSeparation,
                       "separation as a share of the zero-parallax distance, as in 1/30");
    command.add_option("--json", options.json, "figures as JSON; -: to standard output");
    command.add_option("--csv", options.csv, "figures as CSV; -: to standard output");
    command.add_option("--images", options.images, "folder for pictures of the flight's middle frame");
    command.add_option("--plot", options.plot, "error against time as a picture");
    command.add_option("--repeats", options.repeats,
                       "timed runs of a frame, the fastest counts; 3 when left out");
    command.callback([&parsed] {
        parsed.run = [&parsed] {
            parsed.takeSize(parsed.compare.size);
            if (!parsed.relativeSeparation.empty())
                parsed.compare.relativeSeparation = shareFromText(parsed.relativeSeparation);
            return runCompare(parsed.compare);
        };
    });
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
    command.add_option("--threads", options.threads, "threads to use, 0 for all processors")
        ->check(CLI::Range(0, 256));
    command.add_option("--seed", options.seed, "of everything random");
    command.add_option("--minutes", options.minutes, "for all of it: about 9 when left out, 1 with --quick")
        ->check(CLI::Range(0.0, 1440.0));
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
    command.add_option("--sun", options.scene.sun, kSunHelp);
    addThreads(command, options.scene);
    command.add_option("--out", options.out, "the mesh's file, .glb or .gltf")->required();
    command
        .add_option("--error", options.error_m,
                    "largest vertical error in metres, half a sample spacing when left out")
        ->check(CLI::NonNegativeNumber);
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
    command
        .add_option(
            "--light", options.lights,
            "a point light: x,y,z in metres and its intensity; or centreline and the lights' distance in "
            "metres, in a colon; may be given several times")
        ->allow_extra_args(false);
    command.add_option("--probe", options.probe, "light from all around: a light probe (.hdr) or a picture");
    command.add_option("--sky", options.scene.sky,
                       "of a volume: light from everywhere, one number or red,green,blue");
    command.add_option("--bounces", options.bounces, "of light between surfaces, 0 to 8");
    command.add_option("--albedo", options.albedo, "of the surface, 0 to 1: one number, or red,green,blue");
    command.add_option("--order", options.order, "of transfer's harmonics, 1 to 6");
}

void addBake(CLI::App& app, Parsed& parsed) {
    BakeOptions& options = parsed.bake;
    CLI::App& command = *app.add_subcommand(
        "bake", "light worked out before, with bounces and soft shadows; Ctrl-C keeps what is done");
    addSource(command, options.scene);
    addBakedLight(command, options);
    command.add_option("--what", options.what,
                       "irradiance, transfer (light can be turned later), or openness");
    command.add_option("--samples", options.samples,
                       "of each texel, 256 when nothing is said; of a terrain 32, each bounce");
    command.add_option("--error", options.error, "go on until the relative error is this, as in 0.02");
    command.add_option("--minutes", options.minutes, "go on for so long");
    command.add_option("--resolution", options.resolution,
                       "texels a voxel along each axis, as in 0.5, 1 or 2");
    command.add_option("--isovalues", options.isovalues,
                       "LOW,HIGH: all surfaces between, to choose from later");
    command.add_option(
        "--reach", options.reach_mm,
        "millimetres that rays look for light from outside: what meets nothing within them is open; "
        "left out: no limit, in a colon its mean radius for openness");
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
    parsed.addSize(command, "1280x720");
    command.add_option("--method", options.method,
                       "how the right eye is made, auto: what measures best here");
    command.add_option("--mode", options.mode, kModeHelp);
    command.add_option("--path", options.path, "a recorded path (.gltf, .glb, .path) for Z to play");
    command.add_option("--sweep", options.sweep,
                       "where a medium is swept: cpu, gpu (OpenGL 4.5), or auto, what is faster here");
    command.add_option("--shots", options.shots, "folder for saved pictures and recorded flights");
    command.callback([&parsed] {
        parsed.run = [&parsed] {
            parsed.takeSize(parsed.view.size);
            return runView(parsed.view);
        };
    });
}

// The name of the subcommand that was being parsed, with a blank before it; "" when none.
std::string commandIn(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? "" : " " + chosen.front()->get_name();
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
    addInfo(app, parsed);
    addRender(app, parsed);
    addPlay(app, parsed);
    addCompare(app, parsed);
    addReport(app, parsed);
    addMesh(app, parsed);
    addCentreline(app, parsed);
    addBake(app, parsed);
    addView(app, parsed);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
        throw Error("", "", error.what(), "see stereonav" + commandIn(app) + " --help");
    }
    return parsed.run();
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
        throw Error("", "", error.what(), "see stereonav render --help");
    }
    parsed.takeSize(parsed.render.size);
    return parsed.render;
}

}  // namespace stereonav
