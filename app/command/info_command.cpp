// `stereonav info`: what was read, the frame plan, and what the program has started for it.
#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/command/facts_json.h"
#include "app/command/info_series.h"
#include "app/command/process_facts.h"
#include "app/command/scene_facts.h"
#include "app/output/length_text.h"
#include "app/output/progress_bar.h"
#include "app/scene/lazy_light.h"
#include "app/scene/scene_loading.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> planesOf(const FramePlan& plan) {
    std::vector<std::string> planes{"color", "depth"};
    if (plan.dependence == ViewDependence::Highlight) planes.push_back("base color");
    if (plan.viewDependent) planes.push_back("normal");
    if (plan.dependence == ViewDependence::Depths) planes.push_back("depth spread");
    planes.push_back("hole mask");
    return planes;
}

Json planJson(const Scene& scene, const FramePlan& plan) {
    Json json;
    json["size"] = {plan.width, plan.height};
    json["separation_m"] = scene.stereo.separation;
    json["zero_parallax_m"] = scene.stereo.zeroParallax;
    json["threads"] = threadCount();
    json["simd"] = std::string(nameOf(scene.simd));
    json["view_dependent"] = plan.viewDependent;
    json["planes"] = planesOf(plan);
    json["bytes"] = plan.bytes;
    json["method"] = std::string(nameOf(plan.method));
    json["warp_right_ms"] = plan.warpRight_ms;
    json["cast_right_ms"] = plan.castRight_ms;
    json["cast_ns_per_pixel"] = plan.costs.cast_ns;
    json["warp_ns_per_pixel"] = plan.costs.warp_ns;
    json["hole_ns_per_ray"] = plan.costs.hole_ns;
    json["hole_percent"] = 100.0 * plan.costs.holeShare;
    json["reason"] = plan.reason;
    return json;
}

std::string planText(const Scene& scene, const FramePlan& plan) {
    std::string text;
    const auto line = [&](const char* name, const std::string& value) { text += factLine(name, value); };
    line("size", fmt::format("{} x {} pixels an eye", plan.width, plan.height));
    line("eyes", lengthText(scene.stereo.separation) + " apart, zero parallax at " +
                     lengthText(scene.stereo.zeroParallax));
    line("threads", std::to_string(threadCount()));
    line("simd", std::string(nameOf(scene.simd)));
    line("planes", fmt::format("{}", fmt::join(planesOf(plan), ", ")));
    line("memory", fmt::format("{:.1f} MB", static_cast<double>(plan.bytes) / 1e6));
    line("right eye", fmt::format("{}: {}", nameOf(plan.method), plan.reason));
    line("costs", fmt::format("cast {:.2f} ns a pixel, warp {:.2f} ns a pixel, hole {:.0f} ns a ray",
                              plan.costs.cast_ns, plan.costs.warp_ns, plan.costs.hole_ns));
    return text;
}

// Of a medium there is nothing to weigh: both eyes come from one sweep.
Json sweepJson(const Scene& scene) {
    Json json;
    json["size"] = {scene.lens.width, scene.lens.height};
    json["separation_m"] = scene.stereo.separation;
    json["zero_parallax_m"] = scene.stereo.zeroParallax;
    json["threads"] = threadCount();
    json["simd"] = std::string(nameOf(scene.simd));
    json["method"] = std::string(scene.frames().defaultMethod());
    return json;
}

std::string sweepText(const Scene& scene) {
    return factLine("size", fmt::format("{} x {} pixels an eye", scene.lens.width, scene.lens.height)) +
           factLine("eyes", lengthText(scene.stereo.separation) + " apart, zero parallax at " +
                                lengthText(scene.stereo.zeroParallax)) +
           factLine("threads", std::to_string(threadCount())) +
           factLine("simd", std::string(nameOf(scene.simd))) +
           factLine("both eyes", "sweep: slice by slice, from one light");
}

Json processJson(const ProcessFacts& process) {
    Json json;
    json["before_main_ms"] = process.beforeMain_ms;
    json["ready_ms"] = process.ready_ms;
    json["threads_running"] = process.threads;
    json["heap_bytes"] = process.heapBytes;
    json["peak_bytes"] = process.peakBytes;
    json["modules"] = process.modules;
    json["libraries"] = process.libraries;
    return json;
}

std::string processText(const ProcessFacts& process) {
    return factLine("start-up",
                    fmt::format("{:.1f} ms of processor time before main, scene ready after {:.0f} ms",
                                process.beforeMain_ms, process.ready_ms)) +
           factLine("threads", fmt::format("{} running", process.threads)) +
           factLine("libraries", fmt::format("{} loaded", process.libraries.size())) +
           factLine("modules",
                    process.modules.empty() ? "none" : fmt::format("{}", fmt::join(process.modules, ", "))) +
           factLine("memory", fmt::format("{:.1f} MB of heap with the scene, {:.1f} MB in all at most",
                                          static_cast<double>(process.heapBytes) / 1e6,
                                          static_cast<double>(process.peakBytes) / 1e6));
}

}  // namespace

int runInfo(const InfoOptions& options) {
    if (!options.series.empty()) return listSeriesOf(options);
    ProgressBar bar;
    const std::unique_ptr<Scene> loaded = loadScene(options.scene, options.size, bar.progress(), kInfoBytes);
    const Scene& scene = *loaded;
    ProcessFacts process;
    takeWhenReady(process);
    bar.progress().report(0.95, "measuring");
    const std::optional<FramePlan> plan = planScene(scene);
    takeAtEnd(process);
    bar.clear();
    const Facts facts = describe(scene);
    if (options.json) {
        Json json{{"scene", scene.name}};
        json.update(jsonOf(facts));
        json["plan"] = plan ? planJson(scene, *plan) : sweepJson(scene);
        json["process"] = processJson(process);
        std::printf("%s\n", json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
        return 0;
    }
    std::string text = scene.name + "\n" + linesOf(facts);
    text += "frame plan\n" + (plan ? planText(scene, *plan) : sweepText(scene));
    text += "process\n" + processText(process);
    std::fputs(text.c_str(), stdout);
    return 0;
}

}  // namespace stereonav
