// `stereonav compare`: flies along a path with every method and measures time and error.
#include "app/command/compare_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/command/comparison_report.h"
#include "app/options/command.h"
#include "app/options/offered_words.h"
#include "app/options/option_take.h"
#include "app/options/output_place.h"
#include "app/output/progress_bar.h"
#include "app/output/stereo_frame.h"
#include "app/scene/narrowed_eyes.h"
#include "app/scene/terrain/terrain_facts.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/parallel.h"
#include "engine/camera/timed_poses.h"
#include "engine/image/image_file.h"
#include "engine/metrics/difference_picture.h"
#include "engine/metrics/method_comparison.h"
#include "engine/text/printed.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

void checkOptions(const CompareOptions& options) {
    checkSize(options.size, options.scene, kCompareBytes);
    for (const NamedPlace& place :
         {NamedPlace{"--json", options.json}, {"--csv", options.csv}, {"--plot", options.plot}})
        checkNoInput(place, inputsOf(options.scene));
    if (!options.json.empty()) checkOutputFile("--json", options.json);
    if (!options.csv.empty()) checkOutputFile("--csv", options.csv);
    if (!options.plot.empty()) checkOutputPicture("--plot", options.plot);
    if (!options.images.empty()) checkOutputFolder("--images", options.images);
    for (const std::string& name : options.methods) checkMethod(options.scene, name, "--methods");
}

// Returns the methods without repetitions, in the order given; "auto" is the scene's default.
std::vector<std::string_view> methodsOf(const CompareOptions& options, const Scene& scene) {
    std::vector<std::string_view> methods;
    for (const std::string& name : options.methods) {
        const std::string_view method = methodNamed(name, scene);
        if (std::find(methods.begin(), methods.end(), method) == methods.end()) methods.push_back(method);
    }
    return methods.empty() ? scene.frames().compared() : methods;
}

struct Shown {
    const char* name;  // part of the file name
    const EyeImage &exact, &made;
};

// Writes the pictures of one frame: each eye by itself, and for each method its picture, its holes in red,
// and its difference from the eye by itself.
void writePictures(const ComparedFrame& frame, int truthRays, const fs::path& folder) {
    const bool rightAlone = !frame.truth.empty();
    const int factor = rightAlone ? 5 : 20;  // see fig. 6e of Wan et al. 2004; media differ less
    if (rightAlone) {
        writeColorImage(folder / "left.png", frame.left.color);
        writeColorImage(folder / "full_right.png", frame.right.color);
        const std::string rays = fmt::format("truth_{}_rays.png", truthRays);
        writeColorImage(folder / rays, frame.truth);
        writeColorImage(folder / ("left_" + rays), frame.leftTruth);
    }
    for (const MethodPicture& picture : frame.pictures) {
        const std::string name(picture.method);
        std::vector<Shown> eyes{{rightAlone ? "" : "_right", frame.right, picture.right}};
        if (!rightAlone) eyes.push_back({"_left", frame.left, picture.left});
        for (const Shown& eye : eyes) {
            writeColorImage(folder / fmt::format("{}{}.png", name, eye.name), eye.made.color);
            writeColorImage(folder / fmt::format("{}{}_difference_x{}.png", name, eye.name, factor),
                            differenceTimes(eye.exact.color, eye.made.color, factor));
        }
        if (!picture.butteraugli.empty())
            writeColorImage(folder / (name + "_butteraugli.png"), pictureOf(picture.butteraugli));
        if (!picture.holeMask.empty())
            writeColorImage(folder / (name + "_holes.png"),
                            holesInRed(picture.right.color, picture.holeMask));
    }
}

// Returns the eyes that render and play have: close together where the room is narrow.
std::vector<StereoSetting> eyesAt(const Scene& scene, const std::vector<TimedPose>& poses) {
    NarrowedEyes eyes(scene);
    std::vector<StereoSetting> all;
    all.reserve(poses.size());
    for (const TimedPose& pose : poses) all.push_back(eyes.at(pose.pose, pose.time));
    return all;
}

std::vector<MethodFigures> comparedMethods(const CompareOptions& options, const Scene& scene,
                                           const std::vector<TimedPose>& poses,
                                           const std::vector<TimedPose>& beside,
                                           const std::vector<StereoSetting>& eyes, Progress& progress) {
    ComparisonSetting setting;
    setting.eyes = eyes;
    setting.beside = beside;
    setting.butteraugli = options.butteraugli;
    setting.repeats = options.repeats;
    setting.truthFactor = static_cast<int>(std::lround(std::sqrt(options.truthRays)));
    setting.methods = methodsOf(options, scene);
    setting.edges.rays = options.scene.quality.edges.value_or(0);
    const int shown = static_cast<int>(poses.size()) / 2;  // pictures are of the middle of the flight
    const auto listener = [&](const ComparedFrame& frame) {
        if (options.images.empty() || frame.index != shown) return;
        makeOutputFolder(options.images);
        writePictures(frame, options.truthRays, options.images);
    };
    return compareMethods(scene.frames(), poses, scene.lens, scene.stereo, setting, progress, listener);
}

void writeResults(const CompareOptions& options, const ComparisonReport& report) {
    if (!options.json.empty()) writeTextFile(options.json, jsonOf(report));
    if (!options.csv.empty()) writeTextFile(options.csv, csvOf(report));
    if (!options.plot.empty()) writeColorImage(options.plot, plotOf(report));
    if (!options.images.empty())
        writeColorImage(fs::path(options.images) / "error_against_time.png", plotOf(report));
}

ComparisonReport describe(const CompareOptions& options, const Scene& scene, int frames) {
    ComparisonReport report;
    report.scene = scene.name;
    report.path = options.path;
    report.machine = machineName();
    report.simd = std::string(nameOf(scene.simd));
    report.width = options.size.width;
    report.height = options.size.height;
    report.threads = threadCount();
    report.frames = frames;
    report.edgeRays = options.scene.quality.edges.value_or(0);
    report.repeats = options.repeats;
    report.truthRays = options.truthRays;
    report.stereo = scene.stereo;
    report.curvature = factOfCurvature(scene);
    report.least = scene.stereo.separation;
    return report;
}

std::vector<Option> compareOptions() {
    return {
        {.key = "frames",
         .value = wholeValue(within(1, 100'000, "frames")),
         .help = "evenly over the path",
         .advice = "24 is the default",
         .fallback = "24",
         .take = into<&CompareOptions::frames>},
        {.key = "methods",
         .value = wordsValue().offering(methodWords()),
         .help = "some of them, as in full,paper,linear",
         .fallback = "all",
         .repeated = true,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.of<CompareOptions>().methods.insert(to.of<CompareOptions>().methods.end(),
                                                        value.words.begin(), value.words.end());
             }},
        {.key = "relative-separation",
         .value = fractionValue(within(0, 10)),
         .help = "separation as a share of the zero-parallax distance, as in 1/30",
         .advice = "try 1/30",
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 if (value.number() > 0) to.of<CompareOptions>().relativeSeparation = value.number();
             }},
        {.key = "json",
         .value = fileValue(),
         .help = "figures as JSON; -: to standard output",
         .take = into<&CompareOptions::json>},
        {.key = "csv",
         .value = fileValue(),
         .help = "figures as CSV; -: to standard output",
         .take = into<&CompareOptions::csv>},
        {.key = "images",
         .value = fileValue(),
         .help = "folder for pictures of the flight's middle frame",
         .take = into<&CompareOptions::images>},
        {.key = "plot",
         .value = fileValue(),
         .help = "error against time as a picture",
         .take = into<&CompareOptions::plot>},
        {.key = "repeats",
         .value = wholeValue(within(1, 1000, "runs")),
         .help = "timed runs of each frame, of which the fastest counts",
         .advice = "3 is the default",
         .fallback = "3",
         .take = into<&CompareOptions::repeats>},
        {.key = "butteraugli",
         .value = flagValue(),
         .help = "measure also how much of the error a person would notice; --images gets a map of it",
         .take = into<&CompareOptions::butteraugli>},
        {.key = "truth-rays",
         .value = wordValue({"4", "16", "64", "256"}),
         .help = "rays a pixel of the finer reference pictures",
         .advice = "fewer take less time",
         .fallback = "64",
         .scenes = scene_type::kCast,
         .elsewhere = {nullptr, "does not go with a medium, which has no finer reference",
                       "leave it out: errors are those from two sweeps"},
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.of<CompareOptions>().truthRays = std::stoi(value.text); }},
        {.key = "size",
         .value = sizeValue(),
         .help = "size of the picture of one eye",
         .advice = "try 1280x720",
         .fallback = "500x400",
         .behind = "size",
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.of<CompareOptions>().size = {static_cast<int>(value.numbers[0]),
                                                 static_cast<int>(value.numbers[1])};
             }},
    };
}

}  // namespace

int runCompare(const CompareOptions& options) {
    checkOptions(options);
    std::FILE* const messages =
        messagesBeside({{"--json", options.json}, {"--csv", options.csv}, {"--plot", options.plot}});
    std::optional<RecordedPath> path;
    if (!options.path.empty()) path = readPath(options.path);
    ProgressBar bar(!options.telling.quiet);
    const std::unique_ptr<Scene> loaded =
        loadScene(options.scene, options.size, bar.progress(), kCompareBytes);
    Scene& scene = *loaded;
    checkNotRead({{"--json", options.json}, {"--csv", options.csv}, {"--plot", options.plot}});
    if (options.relativeSeparation)
        scene.stereo.separation = scene.stereo.zeroParallax * *options.relativeSeparation;
    constexpr double kNextFrame = 1.0 / 30;  // seconds
    const RecordedPath& flight = flightOf(scene, path, options.path);
    const std::vector<TimedPose> poses = timedFrames(flight, options.frames);
    // A separation that is asked for is measured unchanged.
    const std::vector<StereoSetting> eyes = options.relativeSeparation
                                                ? std::vector<StereoSetting>(poses.size(), scene.stereo)
                                                : eyesAt(scene, poses);
    ComparisonReport report = describe(options, scene, options.frames);
    for (const StereoSetting& eye : eyes) report.least = std::min(report.least, eye.separation);
    report.methods =
        comparedMethods(options, scene, poses, timedBeside(flight, poses, kNextFrame), eyes, bar.progress());
    writeResults(options, report);
    bar.clear();
    const bool otherwise =
        !(options.json.empty() && options.csv.empty() && options.plot.empty() && options.images.empty());
    if (!options.telling.quiet || !otherwise) printLines(messages, tableOf(report));
    return 0;
}

Command compareCommand() {
    return {.name = "compare",
            .help = "measure the methods of making the right eye",
            .scenes = scene_type::kAll,
            .command = command::kCompare,
            .traits = command::kShowing,
            .chapter = Chapter::Measuring,
            .options = compareOptions,
            .start = startOf<CompareOptions, runCompare>};
}

}  // namespace stereonav
