#include "app/scene_loading.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "app/terrain_loading.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

void checkThreads(int threads) {
    if (threads < 0 || threads > 256)
        throw Error("--threads", "", fmt::format("expected 1 to 256, got {}", threads),
                    "leave it out to use all processors");
}

void checkOptions(const SceneOptions& options) {
    checkThreads(options.threads);
    if (!(options.verticalScale >= 0.0) || !std::isfinite(options.verticalScale))
        throw Error("--vertical-scale", "",
                    fmt::format("expected a positive number, got {}", options.verticalScale),
                    "use 1 for true heights");
    if (options.fov_deg != 0.0 && !(options.fov_deg > 0.0 && options.fov_deg < 180.0))
        throw Error("--fov", "",
                    fmt::format("expected more than 0 and less than 180 degrees, got {}", options.fov_deg),
                    "45 is common");
    if (options.separation_m && !(*options.separation_m >= 0.0 && std::isfinite(*options.separation_m)))
        throw Error("--separation", "",
                    fmt::format("expected 0 or more metres, got {}", *options.separation_m),
                    "1/30 of the zero-parallax distance is comfortable");
    if (options.zeroParallax_m && !(*options.zeroParallax_m > 0.0 && std::isfinite(*options.zeroParallax_m)))
        throw Error("--zero-parallax", "",
                    fmt::format("expected more than 0 metres, got {}", *options.zeroParallax_m),
                    "use the distance to what should lie in the screen");
}

long long memoryBytes() {
    return static_cast<long long>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGE_SIZE);
}

}  // namespace

void checkSize(const SizeOption& size, int bytesPerPixel) {
    constexpr int kLargest = 32768;
    const std::string got = fmt::format("{}x{}", size.width, size.height);
    if (size.width < 1 || size.height < 1 || size.width > kLargest || size.height > kLargest)
        throw Error("--size", "", "expected 1 to 32768 pixels a side, got " + got, "try 1280x720");
    const long long bytes = static_cast<long long>(bytesPerPixel) * size.width * size.height;
    if (bytes > memoryBytes() / 2)
        throw Error("--size", "",
                    fmt::format("{} needs {:.1f} GB, more than half of this machine's {:.1f} GB", got,
                                static_cast<double>(bytes) / 1e9, static_cast<double>(memoryBytes()) / 1e9),
                    "choose a smaller size");
}

LoadedScene loadScene(const SceneOptions& options, const SizeOption& size, Progress& progress) {
    checkSize(size);
    checkOptions(options);
    const SimdTarget simd = simdFromText(options.simd);
    if (options.threads > 0) setThreadCount(options.threads);
    LoadedScene scene = loadTerrainScene(options, simd, progress);
    scene.lens.width = size.width;
    scene.lens.height = size.height;
    return scene;
}

Pose poseFromText(const std::string& text) {
    double values[6] = {};
    int count = 0;
    std::stringstream fields(text);
    const Error error("--pose", "",
                      "expected x,y,z,heading,pitch,roll in metres and degrees, got \"" + text + "\"",
                      "the angles may be left out, as in 0,0,3000");
    for (std::string field; std::getline(fields, field, ','); ++count) {
        std::size_t used = 0;
        if (count == 6) throw error;
        try {
            values[count] = std::stod(field, &used);
        } catch (const std::exception&) {
            throw error;
        }
        if (used != field.size() || !std::isfinite(values[count])) throw error;
    }
    if (count < 3 || text.back() == ',') throw error;
    return poseFromAngles({values[0], values[1], values[2]}, values[3] * kRadians, values[4] * kRadians,
                          values[5] * kRadians);
}

std::optional<RightEyeMethod> methodFromText(const std::string& name) {
    if (name == "auto") return std::nullopt;
    if (const auto method = rightEyeMethodFromName(name)) return *method;
    std::string known;
    for (const NamedMethod& method : kRightEyeMethods)
        known += std::string(known.empty() ? "" : ", ") + std::string(method.name);
    throw Error("", "", "there is no method \"" + name + "\"", "the methods are " + known);
}

OutputMode modeFromText(const std::string& name) {
    if (const auto mode = outputModeFromName(name)) return *mode;
    throw Error("--mode", "", "there is no output mode \"" + name + "\"",
                "the modes are " + outputModeNames());
}

SimdTarget simdFromText(const std::string& name) {
    for (const NamedSimdTarget& known : kSimdTargets)
        if (known.name == name) return known.target;
    throw Error("--simd", "", "there is no instruction set \"" + name + "\"",
                "use auto, plain, avx2 or avx512");
}

std::string nameOf(SimdTarget target) {
    for (const NamedSimdTarget& known : kSimdTargets)
        if (known.target == target) return std::string(known.name);
    return "";
}

FramePlan planScene(const LoadedScene& scene) {
    constexpr int kPosesAlongTheFlight = 4;
    std::vector<StereoViews> views{scene.viewsAt(scene.startPose)};
    for (const Pose& pose : scene.path.frames(kPosesAlongTheFlight)) views.push_back(scene.viewsAt(pose));
    return planFrame(*scene.renderer, views);
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
