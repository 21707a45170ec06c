#include "engine/stereo/frame_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/stopwatch.h"

namespace stereonav {
namespace {

constexpr std::size_t kLeastFrames = 3;  // one alone may be unlike all others

struct Sample {
    double cast_ms = 0, warp_ms = 0, fill_ms = 0;
    long long holes = 0;
};

// Buffers of the calibration frames, and one frame measured with them.
struct Bench {
    const EyeRenderer& renderer;
    WarpSetting setting;
    EyeImage left, right;
    RightEye eye;

    Sample run(const StereoViews& views) {
        left.resize(views.left.width, views.left.height, renderer.viewDependence());
        renderer.lookFrom(views.left, views.right);
        renderEye(renderer, views.left, left);
        WarpSetting full = setting;
        full.method = RightEyeMethod::Full;
        Sample sample;
        sample.cast_ms = eye.render(renderer, views, left, full, right).right_ms();
        const RightEyeTimings timings = eye.render(renderer, views, left, setting, right);
        sample.warp_ms = timings.warp_ms;
        sample.fill_ms = timings.fill_ms;
        const bool all = castsFromDepths(setting.method);  // every ray is cast, with a jump
        sample.holes = all ? static_cast<long long>(right.width()) * right.height() : timings.holePixels;
        return sample;
    }
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

FrameCosts costsOf(const std::vector<Sample>& samples, double pixels) {
    std::vector<double> cast, warp;
    double fill_ms = 0, holes = 0;
    for (const Sample& sample : samples) {
        cast.push_back(sample.cast_ms);
        warp.push_back(sample.warp_ms);
        fill_ms += sample.fill_ms;
        holes += static_cast<double>(sample.holes);
    }
    FrameCosts costs;
    costs.cast_ns = median(cast) * 1e6 / pixels;
    costs.warp_ns = median(warp) * 1e6 / pixels;
    costs.holeShare = holes / (pixels * static_cast<double>(samples.size()));
    costs.hole_ns = holes > 0 ? fill_ms * 1e6 / holes : 0.0;
    return costs;
}

std::string reasonFor(const FramePlan& plan, RightEyeMethod warp) {
    const std::string again = castsFromDepths(warp) ? "every pixel cast from where it may meet something"
                                                    : fmt::format("{:.1f} % of the pixels cast again",
                                                                  100.0 * plan.costs.holeShare);
    const std::string warped = fmt::format("{} takes {:.2f} ms ({})", nameOf(warp), plan.warpRight_ms, again);
    const std::string cast = fmt::format("casting every pixel takes {:.2f} ms", plan.castRight_ms);
    return plan.warps() ? warped + ", " + cast : cast + ", " + warped;
}

}  // namespace

std::size_t frameBytes(int width, int height, ViewDependence dependence) {
    // stride as Plane has it; colour and depth, what is shaded again, and what the left eye alone keeps
    const std::size_t stride = (static_cast<std::size_t>(width) + Plane<float>::kPadding + 15) / 16 * 16;
    const std::size_t pixels = stride * static_cast<std::size_t>(height);
    const std::size_t again = dependence == ViewDependence::Highlight ? 8
                              : dependence == ViewDependence::Normal  ? 4
                                                                      : 0;
    const std::size_t left = dependence == ViewDependence::Depths ? 4 : 0;
    return pixels * (2 * (8 + again) + left + 1);
}

FramePlan planFromCosts(const FrameCosts& costs, int width, int height, ViewDependence dependence,
                        RightEyeMethod warp) {
    const double pixels = static_cast<double>(width) * height;
    FramePlan plan;
    plan.width = width;
    plan.height = height;
    plan.dependence = dependence;
    plan.viewDependent = dependence == ViewDependence::Highlight || dependence == ViewDependence::Normal;
    plan.costs = costs;
    plan.castRight_ms = costs.cast_ns * pixels * 1e-6;
    plan.warpRight_ms = (costs.warp_ns + costs.holeShare * costs.hole_ns) * pixels * 1e-6;
    plan.method = plan.warpRight_ms < plan.castRight_ms ? warp : RightEyeMethod::Full;
    plan.bytes = frameBytes(width, height, dependence);
    plan.reason = reasonFor(plan, warp);
    return plan;
}

FramePlan planFrame(const EyeRenderer& renderer, std::span<const StereoViews> views,
                    std::optional<RightEyeMethod> warp, double budget_ms) {
    if (views.empty())
        throw Error("", "", "expected at least one view to plan a frame for, got none",
                    "give the start pose");
    Bench bench{renderer, {}, {}, {}, {}};
    bench.setting.method = warp.value_or(defaultMethodFor(renderer));
    const Stopwatch watch;
    bench.run(views.front());  // buffers and caches, not counted
    std::vector<Sample> samples;
    for (const StereoViews& view : views) {
        samples.push_back(bench.run(view));
        if (samples.size() >= kLeastFrames && watch.elapsed_ms() > budget_ms) break;
    }
    const EyeView& size = views.front().right;
    const double pixels = static_cast<double>(size.width) * size.height;
    return planFromCosts(costsOf(samples, pixels), size.width, size.height, renderer.viewDependence(),
                         bench.setting.method);
}

}  // namespace stereonav
