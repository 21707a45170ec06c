#include "app/command/frame_facts.h"

#include <fmt/format.h>

#include "app/command/scene_facts.h"
#include "app/output/length_text.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

struct PlaneName {
    const char *key, *text;
};

std::vector<PlaneName> planesOf(const FramePlan& plan) {
    std::vector<PlaneName> planes{{"color", "colour"}, {"depth", "depth"}};
    if (plan.dependence == ViewDependence::Highlight) planes.push_back({"base color", "base colour"});
    if (plan.viewDependent) planes.push_back({"normal", "normal"});
    if (plan.dependence == ViewDependence::Depths) planes.push_back({"depth spread", "depth spread"});
    planes.push_back({"hole mask", "hole mask"});
    return planes;
}

void addPlan(const FramePlan& plan, Facts& facts) {
    const auto both = [&](const char* key, FactValue value, const char* label, std::string text,
                          const char* unit = "") {
        facts.push_back(factForAll(key, std::move(value), label, std::move(text), unit));
    };
    const auto json = [&](const char* key, FactValue value, const char* unit = "") {
        facts.push_back(factForJson(key, std::move(value), unit));
    };
    FactWords planes;
    for (const PlaneName& plane : planesOf(plan)) planes.emplace_back(plane.key);
    json("view_dependent", plan.viewDependent);
    both("planes", planes, "planes", planesText(plan));
    both("bytes", countOf(plan.bytes), "memory",
         fmt::format("{:.1f} MB", static_cast<double>(plan.bytes) / 1e6), "bytes");
    const std::string method(nameOf(plan.method));
    both("method", method, "right eye", method + ": " + plan.reason);
    json("warp_right_ms", plan.warpRight_ms, "ms");
    json("cast_right_ms", plan.castRight_ms, "ms");
    json("cast_ns_per_pixel", plan.costs.cast_ns, "ns");
    json("warp_ns_per_pixel", plan.costs.warp_ns, "ns");
    json("hole_ns_per_ray", plan.costs.hole_ns, "ns");
    json("hole_percent", 100.0 * plan.costs.holeShare, "%");
    facts.push_back(factForText(
        "costs", fmt::format("cast {:.2f} ns a pixel, warp {:.2f} ns a pixel, hole {:.0f} ns a ray",
                             plan.costs.cast_ns, plan.costs.warp_ns, plan.costs.hole_ns)));
    json("reason", plan.reason);
}

}  // namespace

std::string planesText(const FramePlan& plan) {
    std::string text;
    for (const PlaneName& plane : planesOf(plan)) text += std::string(text.empty() ? "" : ", ") + plane.text;
    return text;
}

Facts factsOfFrames(const Scene& scene, const std::optional<FramePlan>& plan) {
    const int width = plan ? plan->width : scene.lens.width, height = plan ? plan->height : scene.lens.height;
    Facts facts;
    facts.push_back(factForAll("size", FactIntegers{width, height}, "size",
                               fmt::format("{} x {} pixels an eye", width, height), "pixels"));
    facts.push_back(factForJson("separation_m", scene.stereo.separation, "m"));
    facts.push_back(factForJson("zero_parallax_m", scene.stereo.zeroParallax, "m"));
    facts.push_back(factForText("eyes", lengthText(scene.stereo.separation) + " apart, zero parallax at " +
                                            lengthText(scene.stereo.zeroParallax)));
    facts.push_back(factForAll("threads", std::int64_t{threadCount()}, "threads"));
    facts.push_back(factForAll("simd", std::string(nameOf(scene.simd)), "simd"));
    if (plan)
        addPlan(*plan, facts);
    else
        facts.push_back(factForAll("method", std::string(scene.frames().defaultMethod()), "both eyes",
                                   "sweep: slice by slice, from one light"));
    return facts;
}

}  // namespace stereonav
