// Each frame runs all methods in turn, again and again, so that drift of the machine's speed meets all alike.
#include "engine/metrics/pair_comparison.h"

#include <fmt/format.h>

#include <cstring>
#include <limits>

#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr int kEdgeRadius = 2;  // pixels, as for eyes that are cast

// One method's pictures and the fastest of its runs of the frame at hand.
struct PairRunner {
    std::string_view method;
    EyePair frame;
    FrameTimings best;

    explicit PairRunner(std::string_view m) : method(m) {}

    void run(FrameMaker& frames, const StereoViews& views, double time, bool first) {
        frames.make(views, time, {method, {}}, frame);
        if (first || frame.timings.both_ms < best.both_ms) best = frame.timings;
    }
};

template <typename T>
Plane<T> oneAboveTheOther(const Plane<T>& top, const Plane<T>& bottom) {
    Plane<T> both(top.width(), top.height() + bottom.height());
    const auto copy = [&](const Plane<T>& from, int y0) {
        for (int y = 0; y < from.height(); ++y)
            std::memcpy(both.row(y0 + y), from.row(y), sizeof(T) * static_cast<std::size_t>(from.width()));
    };
    copy(top, 0);
    copy(bottom, top.height());
    return both;
}

Plane<PackedColor> colorsOf(const PairRunner& runner) {
    return oneAboveTheOther(runner.frame.left.color, runner.frame.right.color);
}

MethodFigures figuresOf(const PairRunner& runner, const PairRunner& truth, const Plane<std::uint8_t>& edges) {
    MethodFigures figures;
    figures.name = runner.method;
    figures.left_ms = truth.best.left_ms;
    const RightEyeTimings splat = runner.best.warped.value_or(RightEyeTimings{});
    figures.warp_ms = splat.warp_ms;
    figures.right_ms =
        runner.best.both_ms - (runner.best.left_ms > 0 ? runner.best.left_ms : figures.left_ms);
    figures.fill_ms = figures.right_ms - figures.warp_ms;
    figures.full_right_ms = truth.best.right_ms;
    figures.hole_percent = 100.0 * static_cast<double>(splat.holePixels) /
                           (static_cast<double>(runner.frame.right.width()) * runner.frame.right.height());
    figures.difference = differenceOf(colorsOf(truth), colorsOf(runner), edges);
    return figures;
}

std::vector<MethodFigures> compareFrame(FrameMaker& frames, const StereoViews& views, double time,
                                        const PairComparisonSetting& setting, int index,
                                        const ComparedPairListener& listener) {
    PairRunner truth(setting.truth);
    std::vector<PairRunner> others;
    for (const std::string_view method : setting.methods)
        if (method != setting.truth) others.emplace_back(method);
    for (int repeat = 0; repeat < setting.repeats; ++repeat) {
        truth.run(frames, views, time, repeat == 0);
        for (PairRunner& runner : others) runner.run(frames, views, time, repeat == 0);
    }
    const Plane<std::uint8_t> none(views.left.width, 2 * views.left.height);
    const Plane<std::uint8_t> edges =
        edgeMask(none, oneAboveTheOther(truth.frame.left.viewDepth, truth.frame.right.viewDepth),
                 views.parallaxScale, kEdgeRadius);
    ComparedPair pair{index, truth.frame.left, truth.frame.right, {}};
    std::vector<MethodFigures> figures;
    auto other = others.begin();
    for (const std::string_view method : setting.methods) {
        const PairRunner& runner = method == setting.truth ? truth : *other++;
        figures.push_back(figuresOf(runner, truth, edges));
        pair.pictures.push_back({method, runner.frame.left, runner.frame.right});
    }
    if (listener) listener(pair);
    return figures;
}

}  // namespace

std::vector<MethodFigures> comparePairs(FrameMaker& frames, const std::vector<TimedPose>& poses,
                                        const Lens& lens, const StereoSetting& stereo,
                                        const PairComparisonSetting& setting, Progress& progress,
                                        const ComparedPairListener& listener) {
    if (poses.empty() || setting.methods.empty())
        throw Error("", "", "expected at least one pose and one method to compare",
                    "name a path and methods");
    std::vector<std::vector<MethodFigures>> byMethod(setting.methods.size());
    for (std::size_t n = 0; n < poses.size(); ++n) {
        progress.report(static_cast<double>(n) / static_cast<double>(poses.size()),
                        fmt::format("frame {} of {}", n + 1, poses.size()));
        const StereoViews views =
            makeStereoViews(poses[n].pose, lens, setting.eyes.empty() ? stereo : setting.eyes[n]);
        const auto figures =
            compareFrame(frames, views, poses[n].time, setting, static_cast<int>(n), listener);
        for (std::size_t k = 0; k < figures.size(); ++k) byMethod[k].push_back(figures[k]);
    }
    std::vector<MethodFigures> result;
    for (const auto& ofFrames : byMethod) {
        result.push_back(medianOf(ofFrames));
        result.back().true_psnr_db = std::numeric_limits<double>::quiet_NaN();
        result.back().holesOfWarped_percent = std::numeric_limits<double>::quiet_NaN();
        result.back().surface_psnr_db = std::numeric_limits<double>::quiet_NaN();
    }
    return result;
}

}  // namespace stereonav
