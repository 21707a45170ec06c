// `stereonav info`: what was read, and the frame plan.
#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/progress_bar.h"
#include "app/scene_loading.h"
#include "engine/base/parallel.h"
#include "terrain/landmark.h"

namespace stereonav {
namespace {

using Json = nlohmann::ordered_json;

std::size_t bytesOf(const TerrainScene& terrain) {
    return sizeof(float) * static_cast<std::size_t>(terrain.ground.width()) * terrain.ground.height() +
           terrain.color.byteCount() + terrain.sky.map().byteCount();
}

Json terrainJson(const TerrainScene& terrain) {
    const TerrainReport& report = terrain.report;
    const Heightfield& ground = terrain.ground;
    Json json;
    json["driver"] = report.driver;
    json["size"] = {ground.width(), ground.height()};
    json["spacing_m"] = {ground.spacing().x, ground.spacing().y};
    json["extent_m"] = {ground.spacing().x * (ground.width() - 1),
                        ground.spacing().y * (ground.height() - 1)};
    json["height_range_m"] = {ground.minHeight(), ground.maxHeight()};
    json["crs"] = report.sourceCrs;
    json["projection"] = report.projection;
    json["source_offset"] = {report.sourceOffset.x, report.sourceOffset.y};
    json["missing_samples"] = report.missingSamples;
    json["filled_samples"] = report.filledSamples;
    json["open_holes"] = ground.hasHoles();
    json["color"] = report.colorSource;
    json["color_size"] = {terrain.color.levelCount() > 0 ? terrain.color.level(0).width() : 0,
                          terrain.color.levelCount() > 0 ? terrain.color.level(0).height() : 0};
    json["sky"] = report.skySource;
    json["landmark_triangles"] = terrain.landmarks ? terrain.landmarks->triangleCount() : 0;
    json["bytes"] = bytesOf(terrain);
    json["flight_s"] = terrain.path.duration();
    json["clearance_m"] = terrain.clearance;
    return json;
}

Json planJson(const LoadedScene& scene, const FramePlan& plan) {
    Json json;
    json["size"] = {plan.width, plan.height};
    json["separation_m"] = scene.stereo.separation;
    json["zero_parallax_m"] = scene.stereo.zeroParallax;
    json["threads"] = threadCount();
    json["simd"] = nameOf(scene.simd);
    json["view_dependent"] = plan.viewDependent;
    json["planes"] = plan.viewDependent ? Json{"color", "depth", "base color", "normal", "hole mask"}
                                        : Json{"color", "depth", "hole mask"};
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

std::string orNone(const std::string& text) {
    return text.empty() ? "none" : text;
}

std::string terrainText(const TerrainScene& terrain) {
    const TerrainReport& report = terrain.report;
    const Heightfield& ground = terrain.ground;
    std::string text;
    const auto line = [&](const char* name, const std::string& value) {
        text += fmt::format("  {:<12}{}\n", name, value);
    };
    line("read by", report.driver);
    line("samples", fmt::format("{} x {}", ground.width(), ground.height()));
    line("spacing", fmt::format("{:.6g} x {:.6g} m", ground.spacing().x, ground.spacing().y));
    line("extent", fmt::format("{:.6g} x {:.6g} m", ground.spacing().x * (ground.width() - 1),
                               ground.spacing().y * (ground.height() - 1)));
    line("heights", fmt::format("{:.6g} .. {:.6g} m", ground.minHeight(), ground.maxHeight()));
    line("crs", orNone(report.sourceCrs));
    line("projection", orNone(report.projection));
    line("missing", fmt::format("{} samples, {} of them filled{}", report.missingSamples,
                                report.filledSamples, ground.hasHoles() ? ", the others left open" : ""));
    line("colour", orNone(report.colorSource));
    line("sky", orNone(report.skySource));
    line("landmarks",
         terrain.landmarks ? fmt::format("{} triangles", terrain.landmarks->triangleCount()) : "none");
    line("flight", fmt::format("{:.4g} s, at least {:.4g} m above the ground", terrain.path.duration(),
                               terrain.clearance));
    line("memory", fmt::format("{:.1f} MB", static_cast<double>(bytesOf(terrain)) / 1e6));
    return text;
}

std::string planText(const LoadedScene& scene, const FramePlan& plan) {
    std::string text;
    const auto line = [&](const char* name, const std::string& value) {
        text += fmt::format("  {:<12}{}\n", name, value);
    };
    line("size", fmt::format("{} x {} pixels an eye", plan.width, plan.height));
    line("eyes", fmt::format("{:.4g} m apart, zero parallax at {:.4g} m", scene.stereo.separation,
                             scene.stereo.zeroParallax));
    line("threads", std::to_string(threadCount()));
    line("simd", nameOf(scene.simd));
    line("planes",
         plan.viewDependent ? "colour, depth, base colour, normal, hole mask" : "colour, depth, hole mask");
    line("memory", fmt::format("{:.1f} MB", static_cast<double>(plan.bytes) / 1e6));
    line("right eye", fmt::format("{}: {}", nameOf(plan.method), plan.reason));
    line("costs", fmt::format("cast {:.2f} ns a pixel, warp {:.2f} ns a pixel, hole {:.0f} ns a ray",
                              plan.costs.cast_ns, plan.costs.warp_ns, plan.costs.hole_ns));
    return text;
}

}  // namespace

int runInfo(const InfoOptions& options) {
    ProgressBar bar;
    const LoadedScene scene = loadScene(options.scene, options.size, bar.progress());
    bar.progress().report(0.95, "measuring");
    const FramePlan plan = planScene(scene);
    bar.clear();
    if (options.json) {
        Json json{
            {"scene", scene.name}, {"terrain", terrainJson(*scene.terrain)}, {"plan", planJson(scene, plan)}};
        std::printf("%s\n", json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
    } else {
        std::printf("%s\n%sframe plan\n%s", scene.name.c_str(), terrainText(*scene.terrain).c_str(),
                    planText(scene, plan).c_str());
    }
    return 0;
}

}  // namespace stereonav
