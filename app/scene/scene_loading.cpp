#include "app/scene/scene_loading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <utility>

#include "app/scene/narrowed_eyes.h"
#include "app/scene/scene_type_table.h"
#include "app/scene/terrain/survey_ground.h"
#include "app/scene/type/asked_views.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/memory.h"
#include "engine/base/parallel.h"
#include "engine/camera/timed_poses.h"
#include "engine/math/constants.h"
#include "engine/volume/transfer_text.h"

namespace stereonav {
namespace {

// Throws Error for an input that is a pipe or device: reading it might never end.
void checkSource(const NamedPlace& input) {
    std::error_code code;
    if (input.place.empty() || std::filesystem::is_directory(input.place, code)) return;
    try {
        checkFileToRead(input.place);
    } catch (const Error& error) {
        throw Error(input.option, "", error.what(), "");
    }
}

// Returns the file of a transfer function; "" for a function that is given as text.
std::string transferFileOf(const SceneOptions& options) {
    return isCurveText(options.volume.transfer) ? "" : options.volume.transfer;
}

std::string_view methodAmong(std::span<const std::string_view> methods, const std::string& name,
                             const char* option, const std::string& ofWhat) {
    const auto known = std::ranges::find(methods, name);
    if (known != methods.end()) return *known;
    throw Error(option, "", "there is no method \"" + name + "\"" + ofWhat,
                fmt::format("the methods are {}", fmt::join(methods, ", ")));
}

}  // namespace

void checkSize(const SizeOption& size, const SceneOptions& options, const PixelBytes& each) {
    constexpr int kLargest = 32768;
    const std::string got = fmt::format("{}x{}", size.width, size.height);
    if (size.width < 1 || size.height < 1 || size.width > kLargest || size.height > kLargest)
        throw Error("--size", "", "expected 1 to 32768 pixels a side, got " + got, "try 1280x720");
    const ShownAs& shown = shownAs(options);
    const double picture = each.*shown.bytesAPixel * size.width * size.height;
    const double beside = each.beside + (picture > 0 ? shown.lightBytes : 0);
    limitMemory(options.memory_bytes.value_or(0));
    const double bytes = picture + beside, there = availableMemoryFor(bytes);
    const double share = std::sqrt(std::clamp((there - beside) / picture, 0.0, 1.0));
    if (bytes > there)
        throw Error("--size", "",
                    fmt::format("{} needs {} of memory, and {} is available", got, memoryText(bytes),
                                memoryText(there)),
                    share > 0
                        ? fmt::format("{}x{} would fit", std::max(1, static_cast<int>(share * size.width)),
                                      std::max(1, static_cast<int>(share * size.height)))
                        : "free memory");
}

std::vector<NamedPlace> inputsOf(const SceneOptions& options) {
    const MediumOptions& m = options.medium;
    std::vector<NamedPlace> inputs{{"SCENE", options.scene},
                                   {"--image", options.image},
                                   {"--sky", options.sky},
                                   {"--light", options.light.file},
                                   {"--transfer", transferFileOf(options)},
                                   {"--medium", m.medium},
                                   {"--phase", m.phase},
                                   {"--noise", m.noise}};
    for (const SceneType* type : sceneTypes())
        if (type->filesOf)
            for (NamedPlace& file : type->filesOf(options)) inputs.push_back(std::move(file));
    return inputs;
}

void checkSceneOptions(const SceneOptions& options) {
    for (const NamedPlace& input : inputsOf(options)) checkSource(input);
    if (options.threads > 0) setThreadCount(options.threads);
    limitMemory(options.memory_bytes.value_or(0));
    shownAs(options).check(options);
}

std::unique_ptr<Scene> loadScene(const SceneOptions& options, const SizeOption& size, Progress& progress,
                                 const PixelBytes& each) {
    checkSize(size, options, each);
    checkSceneOptions(options);
    const SceneType& type = sceneTypeNamed(options.scene);
    SceneOptions shown = options;
    shown.aspect = static_cast<double>(size.width) / size.height;
    std::unique_ptr<Scene> scene = shownAs(options).load(type, shown, options.simd, progress);
    scene->name = options.scene.empty() ? "terrain" : options.scene;
    scene->lens.width = size.width;
    scene->lens.height = size.height;
    adjustViews(options, *scene);
    if (options.separation_m || options.zeroParallax_m) scene->eyesGiven = true;
    checkSize(size, options, each);
    return scene;
}

SurveyGround loadSurveyGround(const SceneOptions& options, Progress& progress) {
    checkSceneOptions(options);
    const SceneType& type = sceneTypeNamed(options.scene);
    if (!type.hasGround)
        throw Error(options.scene, "", fmt::format("expected a terrain, found a {}", type.noun),
                    "name an elevation model");
    return readSurveyGround(options, progress);
}

void expectColonName(const std::string& scene) {
    const SceneType& type = sceneTypeNamed(scene);
    if (type.hasLine) return;
    const std::string found = !type.hasGround      ? "a " + std::string(type.noun)
                              : scene.empty()      ? "nothing, which is the built-in terrain"
                              : scene == "terrain" ? "the built-in terrain"
                                                   : "a terrain or another kind of file";
    throw Error(scene.empty() ? "SCENE" : scene, "", "expected a CT study, found " + found,
                "name a study, or colon for the built-in one");
}

const RecordedPath& flightOf(const Scene& scene, const std::optional<RecordedPath>& path,
                             const std::string& file) {
    if (path) scene.check(*path, file);
    if (path) return *path;
    if (scene.path.samples().empty())
        throw Error(scene.name, "", "has no flight of its own", "give a recorded one with --path");
    return scene.path;
}

void checkMethod(const SceneOptions& options, const std::string& method, const char* option) {
    const ShownAs& shown = shownAs(options);
    if (method != "auto") methodAmong(shown.methods, method, option, shown.ofMethods);
}

std::string_view methodNamed(const std::string& name, const Scene& scene) {
    const FrameMaker& frames = scene.frames();
    if (name == "auto") return frames.defaultMethod();
    return methodAmong(frames.methods(), name, "--method",
                       fmt::format(" of making the scene's {}", frames.whatMethodsMake()));
}

std::optional<FramePlan> planScene(const Scene& scene) {
    // Poses are ordered from the middle of the flight outwards: for a slow scene the first ones decide, and
    // its ends differ from the rest.
    constexpr int kPosesAlongTheFlight = 7, kOrder[] = {3, 1, 5, 2, 4};
    std::vector<TimedPose> poses{{scene.startPose, 0}};
    if (!scene.path.samples().empty()) {
        const std::vector<TimedPose> flight = timedFrames(scene.path, kPosesAlongTheFlight);
        poses.clear();
        for (const int n : kOrder) poses.push_back(flight[std::min<std::size_t>(n, flight.size() - 1)]);
    }
    std::vector<StereoViews> views;
    views.reserve(poses.size());
    for (const TimedPose& pose : poses)  // the same eyes that render, play and compare use
        views.push_back(makeStereoViews(pose.pose, scene.lens, NarrowedEyes(scene).at(pose.pose, pose.time)));
    return scene.frames().measure(views);
}

std::string machineName() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        const std::size_t colon = line.find(": ");
        if (line.rfind("model name", 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown";
}

}  // namespace stereonav
