// `stereonav compare`: flies a path with every method and measures time and error.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/comparison_report.h"
#include "app/output_place.h"
#include "app/progress_bar.h"
#include "app/scene_loading.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/parallel.h"
#include "engine/image/image_file.h"
#include "engine/metrics/difference_picture.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

void checkOptions(const CompareOptions& options) {
    checkSize(options.size, kCompareBytesPerPixel);
    if (options.frames < 1 || options.frames > 100'000)
        throw Error("--frames", "", fmt::format("expected 1 to 100000, got {}", options.frames),
                    "24 is the default");
    if (options.repeats < 1 || options.repeats > 1000)
        throw Error("--repeats", "", fmt::format("expected 1 to 1000, got {}", options.repeats),
                    "3 is the default");
    if (!(options.relativeSeparation >= 0.0 && options.relativeSeparation <= 10.0))
        throw Error("--relative-separation", "",
                    fmt::format("expected 0 to 10, got {}", options.relativeSeparation), "1/30 is 0.0333");
    if (!options.json.empty()) checkOutputFile("--json", options.json);
    if (!options.csv.empty()) checkOutputFile("--csv", options.csv);
    if (!options.plot.empty()) checkOutputPicture("--plot", options.plot);
    if (!options.images.empty()) checkOutputFolder("--images", options.images);
    for (const std::string& name : options.methods) methodFromText(name);
}

// Each once, in the order of their first naming; "auto" is the scene's default.
std::vector<RightEyeMethod> methodsOf(const CompareOptions& options, const LoadedScene& scene) {
    std::vector<RightEyeMethod> methods;
    for (const std::string& name : options.methods) {
        const RightEyeMethod method = methodFromText(name).value_or(scene.defaultMethod());
        if (std::find(methods.begin(), methods.end(), method) == methods.end()) methods.push_back(method);
    }
    return methods.empty() ? scene.methods : methods;
}

// The pictures of one frame: each eye and truth, and of each method its right eye, its holes in red
// and its difference from the full right cast times five.
void writePictures(const ComparedFrame& frame, const fs::path& folder) {
    constexpr int kFactor = 5;  // as in fig. 6e of the paper
    writeColorImage(folder / "left.png", frame.left.color);
    writeColorImage(folder / "full_right.png", frame.fullRight.color);
    writeColorImage(folder / "truth_16_rays.png", frame.truth);
    for (const MethodPicture& picture : frame.pictures) {
        const std::string name(nameOf(picture.method));
        writeColorImage(folder / (name + ".png"), picture.right.color);
        writeColorImage(folder / (name + "_holes.png"), holesInRed(picture.right.color, picture.holeMask));
        writeColorImage(folder / (name + "_difference_x5.png"),
                        differenceTimes(frame.fullRight.color, picture.right.color, kFactor));
    }
}

void writeResults(const CompareOptions& options, const ComparisonReport& report) {
    if (!options.json.empty()) writeTextFile(options.json, jsonOf(report));
    if (!options.csv.empty()) writeTextFile(options.csv, csvOf(report));
    if (!options.plot.empty()) writeColorImage(options.plot, plotOf(report));
    if (!options.images.empty())
        writeColorImage(fs::path(options.images) / "error_against_time.png", plotOf(report));
}

ComparisonReport describe(const CompareOptions& options, const LoadedScene& scene, int frames) {
    ComparisonReport report;
    report.scene = scene.name;
    report.path = options.path;
    report.machine = machineName();
    report.simd = nameOf(scene.simd);
    report.width = options.size.width;
    report.height = options.size.height;
    report.threads = threadCount();
    report.frames = frames;
    report.repeats = options.repeats;
    report.stereo = scene.stereo;
    return report;
}

}  // namespace

int runCompare(const CompareOptions& options) {
    refuseLazyLight(options.scene);
    checkOptions(options);
    ComparisonSetting setting;
    setting.repeats = options.repeats;
    std::optional<RecordedPath> path;
    if (!options.path.empty()) path = readPath(options.path);
    ProgressBar bar;
    LoadedScene scene = loadScene(options.scene, options.size, bar.progress());
    setting.methods = methodsOf(options, scene);
    if (options.relativeSeparation > 0.0)
        scene.stereo.separation = scene.stereo.zeroParallax * options.relativeSeparation;
    const std::vector<Pose> poses = flightOf(scene, path, options.path).frames(options.frames);
    const int shown = static_cast<int>(poses.size()) / 2;  // pictures of the middle of the flight
    const auto listener = [&](const ComparedFrame& frame) {
        if (!options.images.empty() && frame.index == shown) writePictures(frame, options.images);
    };
    ComparisonReport report = describe(options, scene, static_cast<int>(poses.size()));
    report.methods =
        compareMethods(*scene.renderer, poses, scene.lens, scene.stereo, setting, bar.progress(), listener);
    writeResults(options, report);
    bar.clear();
    std::fputs(tableOf(report).c_str(), stdout);
    return 0;
}

}  // namespace stereonav
