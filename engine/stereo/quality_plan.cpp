#include "engine/stereo/quality_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "engine/base/error.h"
#include "engine/base/loop_watch.h"
#include "engine/base/stopwatch.h"

namespace stereonav {
namespace {

// Frames of one way while it is measured.
struct Trial {
    ErrorCalibrator calibrator;
    std::vector<double> fill_ms;  // by frame
};

void addFrame(const EyeRenderer& renderer, const StereoViews& views, const EyeImage& left,
              const EyeImage& full, int repeats, RightEye& eye, EyeImage& right, MeasuredWarp& warp,
              Trial& trial) {
    double least = 1e300, fill = 0;
    RightEyeTimings timings;
    for (int r = 0; r < repeats; ++r) {
        timings = eye.render(renderer, views, left, warp.setting, right);
        if (timings.right_ms() < least) least = timings.right_ms(), fill = timings.fill_ms;
    }
    warp.right_ms += least;
    warp.holes.push_back(static_cast<double>(timings.holePixels));
    trial.fill_ms.push_back(fill);
    if (warp.setting.method == RightEyeMethod::Full) return;
    Plane<std::uint8_t> classes;
    warp.counts.push_back(findContrast(right.color, eye.holeMask(), classes));
    trial.calibrator.add(right, eye.holeMask(), full);
}

// Means from sums, once all frames are there.
void finish(const Trial& trial, double cast_ns, MeasuredWarp& warp) {
    warp.right_ms /= static_cast<double>(warp.holes.size());
    const double holes = std::accumulate(warp.holes.begin(), warp.holes.end(), 0.0);
    const double fill_ms = std::accumulate(trial.fill_ms.begin(), trial.fill_ms.end(), 0.0);
    warp.ray_ns = holes > 0 ? fill_ms * 1e6 / holes : kScatteredRay * cast_ns;
    if (warp.setting.method != RightEyeMethod::Full)
        warp.setting.refinement.calibration = std::make_shared<ErrorCalibration>(trial.calibrator.result());
}

double meanSquareOf(const MeasuredWarp& warp, double pixels) {
    if (warp.counts.empty()) return 0;
    double sum = 0;
    for (const ContrastCounts& counts : warp.counts)
        sum += warp.setting.refinement.calibration->expectedMeanSquare(counts, pixels);
    return sum / static_cast<double>(warp.counts.size());
}

struct Outcome {
    QualityPlan plan;
    double cost = 0;      // in rays of a full cast
    bool reached = true;  // what is wished of the error
    bool fits = true;     // into the time
};

Outcome castInFull(const MeasuredWarps& measured, const QualityWish& wish) {
    const MeasuredWarp& full = measured.warps.back();
    Outcome outcome{{full.setting, full.name, 1, 0, measured.left_ms + full.right_ms, 1}, 1, true, true};
    // Reporting a frame's error bound requires a calibration; for a full cast any will do, since no error is
    // expected.
    outcome.plan.setting.refinement.calibration = measured.warps.front().setting.refinement.calibration;
    outcome.fits = !wish.target_ms || outcome.plan.both_ms <= *wish.target_ms;
    return outcome;
}

// Most pixels beside the holes that the time leaves room for, as a share of all.
double affordable(const MeasuredWarps& measured, const MeasuredWarp& warp, const QualityWish& wish) {
    if (!wish.target_ms) return 1;
    const double spare_ms = *wish.target_ms - measured.left_ms - warp.right_ms;
    return warp.ray_ns > 0 ? std::clamp(spare_ms * 1e6 / (warp.ray_ns * measured.pixels), 0.0, 1.0) : 1.0;
}

// The way with its pixels of largest expected error cast, until what is wished is reached on the frames.
Outcome refined(const MeasuredWarps& measured, const MeasuredWarp& warp, double wantedSquare,
                const QualityWish& wish) {
    Outcome outcome{{warp.setting, warp.name, 0, 0, 0, 1}, 0, true, true};
    Refinement& refinement = outcome.plan.setting.refinement;
    const double own = meanSquareOf(warp, measured.pixels);
    refinement.quality = !wish.wantsError()        ? 1.0
                         : wish.quality && own > 0 ? std::clamp(1 - wantedSquare / own, 0.0, 1.0)
                                                   : 0.0;
    refinement.targetPsnr_db = wish.targetPsnr_db.value_or(0);
    refinement.mostPixels = affordable(measured, warp, wish);
    double holes = 0, more = 0;
    for (std::size_t n = 0; n < warp.counts.size(); ++n) {
        const ContrastCounts& counts = warp.counts[n];
        const int lowest = classToCast(refinement, counts, measured.pixels);
        holes += warp.holes[n];
        more += static_cast<double>(std::accumulate(counts.begin() + lowest, counts.end(), 0ll));
        outcome.plan.meanSquare +=
            refinement.calibration->expectedMeanSquare(counts, measured.pixels, lowest);
        outcome.reached &=
            refinement.calibration->boundPsnr_db(counts, measured.pixels, lowest) >= refinement.targetPsnr_db;
    }
    const auto frames = static_cast<double>(warp.counts.size());
    outcome.plan.meanSquare /= frames;
    if (wish.quality) outcome.reached &= outcome.plan.meanSquare <= wantedSquare * (1 + 1e-9);
    outcome.plan.castShare = (holes + more) / (frames * measured.pixels);
    outcome.plan.both_ms = measured.left_ms + warp.right_ms + warp.ray_ns * more / frames * 1e-6;
    outcome.cost = kScatteredRay * outcome.plan.castShare;
    outcome.fits = !wish.target_ms || measured.left_ms + warp.right_ms <= *wish.target_ms;
    return outcome;
}

// Returns whether b is to be taken in place of a, which comes before it in the list.
bool isBetter(const Outcome& b, const Outcome& a, bool leastError) {
    if (b.fits != a.fits) return b.fits;
    if (!b.fits) return b.plan.both_ms < a.plan.both_ms;
    if (b.reached != a.reached) return b.reached;
    const double least = 1 - kWorthAChange, error = b.plan.meanSquare, before = a.plan.meanSquare;
    const bool cheaper = b.cost < least * a.cost;
    if (leastError || !b.reached) return error < least * before || (error <= before && cheaper);
    return cheaper;
}

// Times go with the number of pixels.
double scaleFor(double both_ms, double target_ms) {
    double scale = 1;
    while (scale > kLeastScale && both_ms * scale * scale > target_ms) scale *= std::sqrt(0.5);
    return std::max(scale, kLeastScale);
}

void require(const char* what, const std::optional<double>& value, double low, double high) {
    if (value && !(*value >= low && *value <= high))
        throw Error("", what, fmt::format("expected {:g} to {:g}, got {:g}", low, high, *value),
                    "give a value in that range");
}

void check(const QualityWish& wish) {
    require("quality", wish.quality, 0, 1);
    require("target PSNR", wish.targetPsnr_db, 0, kMostPsnr_db);
    require("target time", wish.target_ms, 1e-9, 1e12);
}

WarpSetting settingOf(RightEyeMethod method) {
    WarpSetting setting;
    setting.method = method;
    return setting;
}

}  // namespace

std::vector<NamedWarp> warpsWorthTrying(const EyeRenderer& renderer) {
    const RightEyeMethod method = defaultMethodFor(renderer);
    std::vector<NamedWarp> warps{{std::string(nameOf(method)), settingOf(method)}};
    const bool selective = method == RightEyeMethod::Selective;
    float WarpSetting::*what = selective ? &WarpSetting::mostSpread : &WarpSetting::maxStretch;
    for (const float value : selective ? std::vector<float>{0.2f, 0.4f, 1.0f, 1.5f, 3.0f}
                                       : std::vector<float>{1.05f, 1.1f, 1.2f, 1.8f, 2.5f}) {
        warps.push_back({fmt::format("{} {:g}", nameOf(method), value), settingOf(method)});
        warps.back().setting.*what = value;
    }
    warps.push_back({std::string(nameOf(RightEyeMethod::Full)), settingOf(RightEyeMethod::Full)});
    return warps;
}

MeasuredWarps measureWarps(const EyeRenderer& renderer, std::span<const StereoViews> views,
                           std::span<const NamedWarp> warps, int repeats) {
    if (views.empty() || warps.empty() || warps.back().setting.method != RightEyeMethod::Full)
        throw Error("", "quality plan", "expected views, and ways of which the last is the full cast",
                    "this is a mistake in the program: please report it");
    MeasuredWarps measured;
    for (const NamedWarp& warp : warps) {
        measured.warps.push_back({warp.name, warp.setting, {}, {}, 0, 0});
        measured.warps.back().setting.refinement = {};
    }
    measured.pixels = static_cast<double>(views.front().right.width) * views.front().right.height;
    std::vector<Trial> trials(warps.size());
    EyeImage left, right, full;
    RightEye eye;
    LoopSteps steps(static_cast<int>(views.size() * warps.size()));
    for (const StereoViews& view : views) {
        left.resize(view.left.width, view.left.height, renderer.viewDependence());
        double left_ms = 1e300;
        for (int r = 0; r < repeats; ++r) {
            const Stopwatch watch;
            renderer.lookFrom(view.left, view.right);
            renderEye(renderer, view.left, left);
            left_ms = std::min(left_ms, watch.elapsed_ms());
        }
        measured.left_ms += left_ms / static_cast<double>(views.size());
        addFrame(renderer, view, left, full, repeats, eye, full, measured.warps.back(), trials.back());
        steps.next();
        for (std::size_t n = 0; n + 1 < warps.size(); ++n, steps.next())
            addFrame(renderer, view, left, full, repeats, eye, right, measured.warps[n], trials[n]);
    }
    finish(trials.back(), 0, measured.warps.back());
    const double cast_ns = measured.warps.back().right_ms * 1e6 / std::max(measured.pixels, 1.0);
    for (std::size_t n = 0; n + 1 < warps.size(); ++n) finish(trials[n], cast_ns, measured.warps[n]);
    return measured;
}

QualityPlan planQuality(const MeasuredWarps& measured, const QualityWish& wish) {
    check(wish);
    const MeasuredWarp& first = measured.warps.front();
    const double firstSquare = meanSquareOf(first, measured.pixels);
    const double wanted = (1 - wish.quality.value_or(0)) * firstSquare;
    const bool nothing = !wish.target_ms && !wish.targetPsnr_db && wish.quality.value_or(0) == 0;
    std::optional<Outcome> best;
    for (const MeasuredWarp& warp : measured.warps) {
        if (best && (nothing || wish.firstAlone)) break;
        const bool full = warp.setting.method == RightEyeMethod::Full;
        const Outcome outcome = full ? castInFull(measured, wish)
                                     : refined(measured, warp, wanted, nothing ? QualityWish{0.0} : wish);
        if (!best || isBetter(outcome, *best, !wish.wantsError())) best = outcome;
    }
    if (!best->fits) {
        best->plan.scale = scaleFor(best->plan.both_ms, *wish.target_ms);
        best->plan.setting.refinement = {};
    }
    return best->plan;
}

}  // namespace stereonav
