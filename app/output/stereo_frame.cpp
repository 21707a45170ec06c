#include "app/output/stereo_frame.h"

#include <algorithm>
#include <cmath>

#include "app/scene/quality.h"
#include "engine/image/enlarge.h"
#include "engine/scene/surface_paint.h"

namespace stereonav {
namespace {

// Adds the times of several frames that make one picture. Other figures of warps are those of the last frame.
FrameTimings plus(const FrameTimings& sum, const FrameTimings& frame) {
    FrameTimings all = frame;
    all.both_ms += sum.both_ms;
    all.left_ms += sum.left_ms;
    all.right_ms += sum.right_ms;
    if (all.warped && sum.warped)
        all.warped->warp_ms += sum.warped->warp_ms, all.warped->fill_ms += sum.warped->fill_ms;
    return all;
}

}  // namespace

StereoFrame::StereoFrame(const Scene& scene, const std::string& method)
    : mScene(scene), mMethod(method), mLens(scene.lens), mEyes(scene) {
    mWay.method = methodNamed(method, scene);
}

void StereoFrame::refine(const SceneOptions& options, const RayOptions& rays, Progress& progress) {
    mRays = rays;
    // Warped pictures can not come as close to the truth as `until_db` asks for.
    if (rays.until_db && mMethod == "auto") mWay.method = mScene.frames().exactMethod();
    const EdgeSetting edges = edgesOf(options, mScene, rays);
    mWay.edges = edges;
    const auto plan = qualityOf(options, mScene, mMethod, progress);
    if (!plan) return;
    mWay = wayOf(plan->setting);
    mWay.edges = edges;
    mWayName = plan->name;
    const Lens& whole = mScene.lens;
    mLens.width = std::max(1, static_cast<int>(std::lround(plan->scale * whole.width)));
    mLens.height = std::max(1, static_cast<int>(std::lround(plan->scale * whole.height)));
    // The aspect keeps the frustum exactly as it was before rounding.
    mLens.pixelAspect =
        whole.pixelAspect * whole.width * mLens.height / (static_cast<double>(whole.height) * mLens.width);
}

void StereoFrame::render(const Pose& head, double time) {
    mStereo = mEyes.at(head, time);
    mViews = makeStereoViews(head, mScene.lens, mStereo);
    const StereoViews views = makeStereoViews(head, mLens, mStereo);
    EyePair& made = isSmaller() ? mSmall : mFrame;
    if (mRays.many())
        makeMany(views, time, made);
    else
        mScene.frames().make(views, time, mWay, made);
    if (!isSmaller()) return;
    enlarge(mSmall.left, mScene.lens.width, mScene.lens.height, mFrame.left);
    enlarge(mSmall.right, mScene.lens.width, mScene.lens.height, mFrame.right);
    mFrame.timings = mSmall.timings;
}

void StereoFrame::paint() {
    paintEyes(mScene, mViews, mFrame);
    if (const auto* const legend = mScene.offered<const PaintLegend>())
        mNames.draw(legend->places, mViews, mFrame);
}

void StereoFrame::makeMany(const StereoViews& views, double time, EyePair& made) {
    // The error is computed only now and then: it takes as long as a warp.
    const auto enough = [this] {
        const int rays = mRefined.count();
        if (!mRays.until_db) return rays >= mRays.rays;
        return rays >= kMostRays || (rays % 4 == 0 && mRefined.error_db() >= *mRays.until_db);
    };
    FrameTimings sum;
    for (mRefined.restart(); mRefined.count() == 0 || !enough();) {
        mRefined.add(mScene.frames(), views, time, mWay);
        sum = plus(sum, mRefined.timings());
    }
    made = mRefined.mean();
    made.timings = sum;
}

void StereoFrame::addTo(Hash& hash) const {
    for (const EyeImage* eye : {&mFrame.left, &mFrame.right}) {
        hashPlane(hash, eye->color);
        hashPlane(hash, eye->viewDepth);
    }
}

}  // namespace stereonav
