#include "app/view/rest_refiner.h"

#include <utility>

#include "engine/base/memory.h"

namespace stereonav {
namespace {

// Fewer rays than these are no better than one with more at edges.
constexpr int kFirstShown = 8;

bool isShown(int rays) {
    return rays >= kFirstShown && (rays & (rays - 1)) == 0;
}

// Whether there is room for what is gathered: a picture that rests is there without it.
bool fits(const FrameRequest& request) {
    constexpr double kBytes =
        140;  // a pixel of one eye: sums of both, their mean, the frame added, the one shown
    const double bytes = kBytes * request.lens.width * request.lens.height;
    return availableMemoryFor(bytes) >= bytes;
}

}  // namespace

void RestRefiner::start(std::shared_ptr<const ViewFrame> drawn) {
    mRefined.restart();
    mDrawn = nullptr;
    const FrameRequest& request = drawn->request;
    if (request.refines && request.scale == 1 && request.truth == TruthView::None) mDrawn = std::move(drawn);
}

bool RestRefiner::step(const Scene& scene, ViewFrame& shown) {
    const std::shared_ptr<const ViewFrame> drawn = std::exchange(mDrawn, nullptr);  // where anything throws
    const FrameRequest& request = drawn->request;
    if (mRefined.count() == 0 && !fits(request)) return false;
    FrameMaker& frames = scene.frames();
    const FrameWay way{frames.exactMethod(), request.way.warp};
    if (request.twoEyes)
        mRefined.add(frames, makeStereoViews(request.pose, request.lens, request.stereo), request.time, way);
    else
        mRefined.addOne(frames, makeEyeView(request.pose, request.lens), request.time);
    const int rays = mRefined.count();
    const bool shows = isShown(rays);
    if (shows) {
        shown = *drawn;
        const EyePair& mean = mRefined.mean();
        shown.left.color = mean.left.color;
        shown.right.color = mean.right.color;
        shown.rays = rays;
        shown.expected_db = mRefined.error_db();
    }
    const bool enough = shows && mRefined.error_levels() <= kEnough_levels;
    if (!enough && rays < kMostRaysAtRest && mRefined.timings().both_ms <= kLongest_ms) mDrawn = drawn;
    return shows;
}

}  // namespace stereonav
