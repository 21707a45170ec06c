#include "tests/combinations/drawing.h"

#include <cmath>

#include "app/output/stereo_frame.h"
#include "app/scene/quality.h"
#include "app/scene/volume/traced_light.h"
#include "engine/medium/sweep/swept_frames.h"
#include "engine/sampling/pixel_samples.h"
#include "engine/scene/capabilities.h"

namespace stereonav::test {
namespace {

RenderOptions withSet(RenderOptions options, SimdTarget set) {
    options.scene.simd = set;
    options.method = methodUnderLight(options.scene, options.method);
    checkSize(options.size, options.scene);
    checkMethod(options.scene, options.method);
    return options;
}

std::unique_ptr<Scene> loaded(const RenderOptions& options) {
    Progress progress;
    return loadScene(options.scene, options.size, progress);
}

long long notFiniteIn(const MediumPicture& picture) {
    long long count = 0;
    for (int y = 0; y < picture.light.height(); ++y)
        for (int x = 0; x < picture.light.width(); ++x) {
            const glm::vec4& light = picture.light.at(x, y);
            count += !std::isfinite(light.x + light.y + light.z + light.w);
        }
    return count;
}

}  // namespace

// Sweeps elsewhere are asked for where a window is open; here what they are given is looked at.
Drawing::Drawing(const RenderOptions& options, SimdTarget set)
    : mOptions(withSet(options, set)), mScene(loaded(mOptions)) {
    mEdges = edgesOf(mOptions.scene, *mScene);
    auto* const swept = mScene->offered<SweptFrames>();
    if (!swept) return;
    swept->setSweep([this](const SweepTask& task, const std::function<void()>& cpu) {
        cpu();
        for (const MediumPicture& picture : task.pictures) mNotFinite += notFiniteIn(picture);
        return false;
    });
}

Eyes Drawing::eyes() {
    return frame("", mEdges);
}

Eyes Drawing::frame(const std::string& method, const EdgeSetting& edges) {
    Progress progress;
    SceneOptions options = mOptions.scene;
    if (!method.empty()) options.quality = {};
    options.quality.edges = edges.rays;
    StereoFrame frame(*mScene, method.empty() ? mOptions.method : method);
    frame.refine(options, {}, progress);
    frame.render(mScene->startPose);
    if (auto* const lit = mScene->offered<SeenLight>(); lit && lit->beginsDark()) {
        for (int look = 0; look < 2; ++look)  // at some pixels, then at all
            lit->seen(frame.views().left, frame.left());
        lit->waitUntilDone();
        frame.render(mScene->startPose);
    }
    if (auto* const traced = mScene->offered<PictureLight>())
        traced->light(frame.views(), frame.left(), frame.right(), progress);
    return {frame.left(), frame.right()};
}

bool Drawing::sweepsTogether() const {
    return mOptions.method == "auto" || mOptions.method == "sweep" || mOptions.method == "own-samples";
}

Eyes Drawing::inFull() {
    if (!mScene->offered<MediumScene>()) return frame("full", {});
    return frame(sweepsTogether() ? "own-samples" : "two-sweeps", {});
}

Eyes Drawing::inFullAndSmooth() {
    return frame("full", mEdges);
}

Eyes Drawing::smoothedPlainly(const Eyes& full) {
    Eyes smooth = full;
    Plane<std::uint8_t> edges[2];
    findEdges(full.left, mEdges, edges[0]);
    findEdges(full.right, mEdges, edges[1]);
    std::vector<EyePair> rays;
    FrameWay way;
    way.method = "full";
    for (const glm::dvec2& place : rotatedGrid(mEdges.rays)) {
        rays.emplace_back();
        mScene->frames().make(shiftedBy(views(), place), 0, way, rays.back());
    }
    for (int y = 0; y < full.left.height(); ++y)
        for (int x = 0; x < full.left.width(); ++x)
            for (const bool right : {false, true}) {
                if (!edges[right].at(x, y)) continue;
                PackedColor& color = (right ? smooth.right : smooth.left).color.at(x, y);
                glm::dvec3 sum(unpackColor(color));
                for (const EyePair& each : rays)
                    sum += unpackColor((right ? each.right : each.left).color.at(x, y));
                color = packColor(sum / static_cast<double>(rays.size() + 1));
            }
    return smooth;
}

}  // namespace stereonav::test
