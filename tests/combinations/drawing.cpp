#include "tests/combinations/drawing.h"

#include "app/output_place.h"
#include "app/stereo_frame.h"

namespace stereonav::test {
namespace {

RenderOptions withSet(RenderOptions options, SimdTarget set) {
    options.scene.simd = std::string(nameOf(set));
    options.method = methodUnderLight(options.scene, options.method);
    checkSize(options.size);
    modeFromText(options.mode);
    checkMethod(options.scene, options.method);
    return options;
}

LoadedScene loaded(const RenderOptions& options) {
    Progress progress;
    return loadScene(options.scene, options.size, progress);
}

}  // namespace

Drawing::Drawing(const RenderOptions& options, SimdTarget set)
    : mOptions(withSet(options, set)), mScene(loaded(mOptions)) {}

Eyes Drawing::eyes(const std::string& method) {
    Progress progress;
    StereoFrame frame(mScene, method.empty() ? mOptions.method : method);
    if (method.empty()) frame.refine(mOptions.scene, progress);
    frame.render(mScene.startPose);
    if (mScene.lazyLight) {
        for (int look = 0; look < 2; ++look)  // at some pixels, then at all
            mScene.lazyLight->seen(views().left, frame.left());
        mScene.lazyLight->waitUntilDone();
        frame.render(mScene.startPose);
    }
    if (mScene.tracedLight) mScene.tracedLight->light(views(), frame.left(), frame.right(), progress);
    return {frame.left(), frame.right()};
}

Eyes Drawing::inFull() {
    if (!mScene.pair) return eyes("full");
    const bool together =
        mOptions.method == "auto" || mOptions.method == "sweep" || mOptions.method == "own-samples";
    return eyes(together ? "own-samples" : "two-sweeps");
}

}  // namespace stereonav::test
