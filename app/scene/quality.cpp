#include "app/scene/quality.h"

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/scene/capabilities.h"

namespace stereonav {
namespace {

constexpr int kCalibrationFrames = 15;  // frames of the scene's flight, in addition to the start pose

bool wantsQuality(const QualityOptions& q) {
    return q.quality || q.targetPsnr_db || q.target_ms;
}

}  // namespace

EdgeSetting edgesOf(const SceneOptions& options, const Scene& scene, const RayOptions& rays) {
    EdgeSetting edges;
    const bool byDefault = scene.frames().rightFromLeft() && !rays.many() && !scene.offered<PictureLight>();
    edges.rays = options.quality.edges.value_or(byDefault ? kDefaultEdgeRays : 0);
    return edges;
}

PixelBytes withRays(PixelBytes each, const RayOptions& rays) {
    if (!rays.many()) return each;
    return {each.cast + kManyRaysBytes.cast, each.swept + kManyRaysBytes.swept, each.beside};
}

std::vector<StereoViews> calibrationViews(const Scene& scene) {
    std::vector<StereoViews> views{scene.viewsAt(scene.startPose)};
    if (!scene.path.samples().empty())
        for (const Pose& pose : scene.path.frames(kCalibrationFrames)) views.push_back(scene.viewsAt(pose));
    return views;
}

std::optional<QualityPlan> qualityOf(const SceneOptions& options, const Scene& scene,
                                     const std::string& method, Progress& progress) {
    const QualityOptions& q = options.quality;
    if (!wantsQuality(q)) return std::nullopt;
    constexpr const char* kMeasuring = "measuring the expected error";
    progress.report(0, kMeasuring);
    auto plan = scene.frames().meet({q.quality, q.targetPsnr_db, q.target_ms, false},
                                    method == "auto" ? "" : method, calibrationViews(scene));
    progress.report(1, kMeasuring);
    return plan;
}

}  // namespace stereonav
