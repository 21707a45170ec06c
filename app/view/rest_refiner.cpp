#include "app/view/rest_refiner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/view/frame_truth.h"
#include "engine/base/memory.h"
#include "engine/frame/sliced_frames.h"
#include "engine/metrics/image_difference.h"
#include "engine/scene/surface_paint.h"

namespace stereonav {
namespace {

// Rays below which the mean is no better than one ray with more at edges.
constexpr int kFirstShown = 8;
constexpr int kMostOfMedium = 16;  // frames, each of which takes seconds

bool isShown(int rays) {
    return rays >= kFirstShown && (rays & (rays - 1)) == 0;
}

// Returns null for scenes whose rays are cast.
SlicedFrames* slicedFrames(const Scene& scene) {
    return dynamic_cast<SlicedFrames*>(&scene.frames());
}

// Raises the effort for the frames of one step.
class MoreEffort {
public:
    MoreEffort(SlicedFrames* frames, double effort) : mFrames(frames) {
        if (mFrames) mFrames->setEffort(effort);
    }
    ~MoreEffort() {
        if (mFrames) mFrames->setEffort(1);
    }
    MoreEffort(const MoreEffort&) = delete;
    MoreEffort& operator=(const MoreEffort&) = delete;

private:
    SlicedFrames* mFrames;
};

// Returns the root mean square difference over both eyes, in steps of 255.
double levelsApart(const EyePair& a, const EyePair& b) {
    const auto square = [](const EyeImage& one, const EyeImage& other) {
        return std::pow(10, -errorOf(one.color, other.color).psnr_db / 10);
    };
    double sum = square(a.left, b.left);
    if (!a.right.color.empty()) sum = 0.5 * (sum + square(a.right, b.right));
    return 255 * std::sqrt(sum);
}

double decibels(double levels) {
    return levels > 0 ? std::clamp(20 * std::log10(255 / levels), 0.0, kIdenticalPsnr_db) : kIdenticalPsnr_db;
}

// Returns whether the sums fit into memory; without them the picture is there, too.
bool fits(const FrameRequest& request) {
    constexpr double kBytes =
        140;  // per pixel of one eye: sums of both eyes, their mean, the frame to add, the one that is shown
    const double bytes = kBytes * request.lens.width * request.lens.height;
    return availableMemoryFor(bytes) >= bytes;
}

// Paints the picture. Its depths are those of the first frame, whose rays go through the centres of pixels.
void paintRested(const Scene& scene, ViewFrame& shown) {
    const FrameRequest& request = shown.request;
    if (request.twoEyes)
        paintEyes(scene, makeStereoViews(request.pose, request.lens, request.stereo), shown);
    else
        paintEye(scene, makeEyeView(request.pose, request.lens), shown.left);
}

}  // namespace

void RestRefiner::start(std::shared_ptr<const ViewFrame> drawn) {
    mRefined.restart();
    mEffort = 1;
    mApart_levels = mExpected_levels = 0;
    mFineEnough = false;
    mDrawn = nullptr;
    const FrameRequest& request = drawn->request;
    if (request.refines && request.scale == 1 && request.effort == 1 && request.truth == TruthView::None)
        mDrawn = std::move(drawn);
}

bool RestRefiner::step(const Scene& scene, ViewFrame& shown) {
    const std::shared_ptr<const ViewFrame> drawn = std::exchange(mDrawn, nullptr);  // before anything throws
    if (mRefined.count() == 0 && !fits(drawn->request)) return false;
    const bool swept = slicedFrames(scene) != nullptr;
    if (!swept || mFineEnough) return stepMean(scene, drawn, swept, shown);
    const bool shows = stepEffort(scene, *drawn, shown);
    if (!mEnds) mDrawn = drawn;
    return shows;
}

// Raises the effort until it is enough. The distance from the truth is estimated by that from the picture
// with half the effort; where that falls slowly from step to step, by the sum of all steps to come
// (docs/measured.md). Only then are rays spread over the pixel.
bool RestRefiner::stepEffort(const Scene& scene, const ViewFrame& drawn, ViewFrame& shown) {
    constexpr double kSlowest = 0.9;  // largest permitted share of the step before
    const FrameRequest& request = drawn.request;
    FrameMaker& frames = scene.frames();
    if (mEffort == 1) mFinest = drawn;
    EyePair made;
    {
        const MoreEffort more(slicedFrames(scene), 2 * mEffort);
        if (request.twoEyes)
            frames.make(makeStereoViews(request.pose, request.lens, request.stereo), request.time,
                        {frames.exactMethod(), request.way.warp}, made);
        else
            frames.makeOne(makeEyeView(request.pose, request.lens), request.time, made);
    }
    mEffort *= 2;
    const double apart = levelsApart(made, mFinest);
    const double falls = mApart_levels > 0 ? std::clamp(apart / mApart_levels, 0.0, kSlowest) : 0.5;
    mApart_levels = apart;
    mExpected_levels = apart * std::max(1.0, falls / (1 - falls));
    mFinest = std::move(made);
    mFineEnough = mExpected_levels <= kEnoughOfMedium_levels || mEffort >= kMostEffort;
    mEnds = mFinest.timings.both_ms > kLongestOfMedium_ms;
    shown = drawn;
    shown.left.color = mFinest.left.color;
    shown.right.color = mFinest.right.color;
    shown.effort = mEffort;
    shown.expected_db = decibels(mExpected_levels);
    return true;
}

bool RestRefiner::stepMean(const Scene& scene, const std::shared_ptr<const ViewFrame>& drawn, bool swept,
                           ViewFrame& shown) {
    const FrameRequest& request = drawn->request;
    FrameMaker& frames = scene.frames();
    const FrameWay way{frames.exactMethod(), request.way.warp};
    const MoreEffort more(swept ? slicedFrames(scene) : nullptr, mEffort);
    if (swept && mRefined.count() == 0) mRefined.begin(mFinest);
    if (request.twoEyes)
        mRefined.add(frames, makeStereoViews(request.pose, request.lens, request.stereo), request.time, way);
    else
        mRefined.addOne(frames, makeEyeView(request.pose, request.lens), request.time);
    const int rays = mRefined.count();
    const bool shows = isShown(rays);
    const double levels = std::hypot(mRefined.error_levels(), mExpected_levels);
    if (shows) {
        shown = *drawn;
        const EyePair& mean = mRefined.mean();
        shown.left.color = mean.left.color;
        shown.right.color = mean.right.color;
        paintRested(scene, shown);
        shown.rays = rays;
        shown.effort = mEffort;
        shown.expected_db = decibels(levels);
    }
    const double wanted = swept ? kEnoughOfMedium_levels : kEnough_levels;
    const bool enough = shows && mRefined.error_levels() <= wanted;
    const bool stops = swept || mRefined.timings().both_ms <= kLongest_ms;
    if (!enough && rays < (swept ? kMostOfMedium : kMostRaysAtRest) && stops) mDrawn = drawn;
    return shows;
}

}  // namespace stereonav
