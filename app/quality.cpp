#include "app/quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/medium_options.h"
#include "engine/base/error.h"
#include "engine/stereo/error_prediction.h"

namespace stereonav {
namespace {

constexpr int kCalibrationFrames = 15;  // of the scene's flight, beside the start pose
// Pixels are picked by contrast and lie apart: their rays are taken for twice as dear as those of a full
// cast, where no hole was there to measure them on.
constexpr double kScatteredRay = 2;

bool wantsQuality(const QualityOptions& q) {
    return q.quality || q.targetPsnr_db || q.target_ms;
}

void requireIn(const char* option, const std::optional<double>& value, double low, double high,
               const std::string& advice) {
    if (value && !(*value >= low && *value <= high))
        throw Error(option, "", fmt::format("expected {:g} to {:g}, got {:g}", low, high, *value), advice);
}

// The share of all pixels that may be cast beside the holes, so that both eyes take no longer than the
// target.
double affordable(const FramePlan& plan, double target_ms) {
    const double pixels = static_cast<double>(plan.width) * plan.height;
    const double left_ms = plan.castRight_ms;  // a left eye is cast like a right one
    const double ray_ns = plan.costs.hole_ns > 0 ? plan.costs.hole_ns : kScatteredRay * plan.costs.cast_ns;
    if (target_ms >= left_ms + plan.castRight_ms || !(ray_ns > 0)) return 1;
    return std::clamp((target_ms - left_ms - plan.warpRight_ms) / (ray_ns * pixels * 1e-6), 0.0, 1.0);
}

}  // namespace

void checkQuality(const SceneOptions& options, const std::string& method) {
    const QualityOptions& q = options.quality;
    requireIn("--quality", q.quality, 0, 1, "0 casts the holes alone, 1 every pixel");
    requireIn("--target-psnr", q.targetPsnr_db, 1, kMostPsnr_db, "40 is good, 50 hard to see");
    requireIn("--target-ms", q.target_ms, 1e-3, 1e6, "33 is 30 frames a second");
    if (!wantsQuality(q)) return;
    if (showsMedium(options))
        throw Error("--quality", "", "does not go with a medium, whose eyes are swept together",
                    "choose --slices and --light-size instead");
    const auto named = methodFromText(method);
    if (named && *named != RightEyeMethod::Linear && *named != RightEyeMethod::Cubic &&
        *named != RightEyeMethod::Selective)
        throw Error("--quality", "", fmt::format("does not go with the method {}", method),
                    "choose linear, cubic or selective, or leave the method out");
}

Refinement refinementOf(const SceneOptions& options, const LoadedScene& scene, RightEyeMethod method,
                        Progress& progress) {
    const QualityOptions& q = options.quality;
    Refinement refinement;
    if (!wantsQuality(q)) return refinement;
    progress.report(0.85, "measuring what error is to be expected");
    std::vector<StereoViews> views{scene.viewsAt(scene.startPose)};
    if (!scene.path.samples().empty())
        for (const Pose& pose : scene.path.frames(kCalibrationFrames)) views.push_back(scene.viewsAt(pose));
    WarpSetting warp;
    warp.method = method;
    refinement.calibration = std::make_shared<ErrorCalibration>(calibrateError(*scene.renderer, views, warp));
    refinement.targetPsnr_db = q.targetPsnr_db.value_or(0);
    if (q.target_ms)
        refinement.mostPixels =
            affordable(planFrame(*scene.renderer,
                                 std::span(views).first(std::min<std::size_t>(views.size(), 5)), method),
                       *q.target_ms);
    // A time alone is spent as a whole.
    refinement.quality = q.quality.value_or(q.target_ms && !q.targetPsnr_db ? 1.0 : 0.0);
    return refinement;
}

}  // namespace stereonav
