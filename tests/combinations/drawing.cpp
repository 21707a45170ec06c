#include "tests/combinations/drawing.h"

#include <cmath>

#include "app/output/stereo_frame.h"
#include "app/scene/traced_light.h"
#include "engine/medium/sweep/swept_frames.h"
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
    auto* const swept = mScene->offered<SweptFrames>();
    if (!swept) return;
    swept->setSweep([this](const SweepTask& task, const std::function<void()>& cpu) {
        cpu();
        for (const MediumPicture& picture : task.pictures) mNotFinite += notFiniteIn(picture);
        return false;
    });
}

Eyes Drawing::eyes(const std::string& method) {
    Progress progress;
    StereoFrame frame(*mScene, method.empty() ? mOptions.method : method);
    if (method.empty()) frame.refine(mOptions.scene, {}, progress);
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
    if (!mScene->offered<MediumScene>()) return eyes("full");
    return eyes(sweepsTogether() ? "own-samples" : "two-sweeps");
}

}  // namespace stereonav::test
