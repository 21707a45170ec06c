#include "app/scene/frame_facts.h"

#include <fmt/format.h>

#include "app/scene/type/held_facts.h"
#include "engine/base/parallel.h"
#include "engine/text/length_text.h"

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

void addPlan(const FramePlan& plan, FactList& list) {
    FactWords planes;
    for (const PlaneName& plane : planesOf(plan)) planes.emplace_back(plane.key);
    list.json("view_dependent", plan.viewDependent);
    list.both("planes", planes, "planes", planesText(plan));
    list.both("bytes", countOf(plan.bytes), "memory",
              fmt::format("{:.1f} MB", static_cast<double>(plan.bytes) / 1e6), "bytes");
    const std::string method(nameOf(plan.method));
    list.both("method", method, "right eye", method + ": " + plan.reason);
    list.json("warp_right_ms", plan.warpRight_ms, "ms");
    list.json("cast_right_ms", plan.castRight_ms, "ms");
    list.json("cast_ns_per_pixel", plan.costs.cast_ns, "ns");
    list.json("warp_ns_per_pixel", plan.costs.warp_ns, "ns");
    list.json("hole_ns_per_ray", plan.costs.hole_ns, "ns");
    list.json("hole_percent", 100.0 * plan.costs.holeShare, "%");
    list.text("costs", fmt::format("cast {:.2f} ns a pixel, warp {:.2f} ns a pixel, hole {:.0f} ns a ray",
                                   plan.costs.cast_ns, plan.costs.warp_ns, plan.costs.hole_ns));
    list.json("reason", plan.reason);
}

}  // namespace

std::string planesText(const FramePlan& plan) {
    std::string text;
    for (const PlaneName& plane : planesOf(plan)) text += std::string(text.empty() ? "" : ", ") + plane.text;
    return text;
}

Facts factsOfFrames(const Scene& scene, const std::optional<FramePlan>& plan) {
    const int width = plan ? plan->width : scene.lens.width, height = plan ? plan->height : scene.lens.height;
    FactList list;
    list.both("size", FactIntegers{width, height}, "size",
              fmt::format("{} x {} pixels an eye", width, height), "pixels");
    list.json("separation_m", scene.stereo.separation, "m");
    list.json("zero_parallax_m", scene.stereo.zeroParallax, "m");
    list.text("eyes", lengthText(scene.stereo.separation) + " apart, zero parallax at " +
                          lengthText(scene.stereo.zeroParallax));
    list.both("threads", std::int64_t{threadCount()}, "threads");
    list.both("simd", std::string(nameOf(scene.simd)), "simd");
    if (plan)
        addPlan(*plan, list);
    else
        list.both("method", std::string(scene.frames().defaultMethod()), "both eyes",
                  "sweep: slice by slice, from one light");
    return std::move(list.facts());
}

}  // namespace stereonav
