#include "app/output/stereo_frame.h"

#include <algorithm>
#include <cmath>

#include "app/command/quality.h"
#include "engine/image/enlarge.h"

namespace stereonav {
namespace {

template <typename T>
void addRows(Hash& hash, const Plane<T>& plane) {
    for (int y = 0; y < plane.height(); ++y)
        hash.add(plane.row(y), sizeof(T) * static_cast<std::size_t>(plane.width()));
}

}  // namespace

StereoFrame::StereoFrame(const Scene& scene, const std::string& method)
    : mScene(scene), mMethod(method), mLens(scene.lens), mEyes(scene) {
    mWay.method = methodNamed(method, scene);
}

void StereoFrame::refine(const SceneOptions& options, Progress& progress) {
    const auto plan = qualityOf(options, mScene, mMethod, progress);
    if (!plan) return;
    mWay = wayOf(plan->setting);
    mWayName = plan->name;
    const Lens& whole = mScene.lens;
    mLens.width = std::max(1, static_cast<int>(std::lround(plan->scale * whole.width)));
    mLens.height = std::max(1, static_cast<int>(std::lround(plan->scale * whole.height)));
    // the same frustum, whatever was rounded
    mLens.pixelAspect =
        whole.pixelAspect * whole.width * mLens.height / (static_cast<double>(whole.height) * mLens.width);
}

void StereoFrame::render(const Pose& head, double time) {
    mStereo = mEyes.at(head, time);
    mViews = makeStereoViews(head, mScene.lens, mStereo);
    const StereoViews views = makeStereoViews(head, mLens, mStereo);
    mScene.frames().make(views, time, mWay, mFrame);
    if (!isSmaller()) return;
    for (EyeImage* eye : {&mFrame.left, &mFrame.right})
        *eye = enlarged(*eye, mScene.lens.width, mScene.lens.height);
}

void StereoFrame::addTo(Hash& hash) const {
    for (const EyeImage* eye : {&mFrame.left, &mFrame.right}) {
        addRows(hash, eye->color);
        addRows(hash, eye->viewDepth);
    }
}

}  // namespace stereonav
