#include "app/view/frame_making.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/late/late_guard.h"
#include "engine/scene/surface_paint.h"
#include "engine/stereo/comfort.h"

namespace stereonav {
namespace {

constexpr int kAheadStep = 4;  // every fourth pixel of every fourth row is used to measure the distance ahead
constexpr int kMostFits = 3;   // pictures until the eyes fit: eyes apart see a little more than eyes together
constexpr double kFitting = 1e-6;  // relative change of the eyes that is ignored

Lens castLens(const FrameRequest& request) {
    return guarded(request.lens, request.guard);
}

// Measures the room around the head from the frame's left eye.
void lookAround(const StereoViews* views, ViewFrame& frame) {
    frame.depthAhead = depthAhead(frame.left.viewDepth, kAheadStep);
    frame.nearParallax = frame.farParallax = 0;
    frame.parallax = {};
    if (!views) return;
    const ParallaxSeen seen = parallaxSeen(*views, frame.left.viewDepth);
    frame.nearParallax = seen.range.near;
    frame.farParallax = seen.range.far;
    frame.parallax = seen.histogram;
}

bool sameEyes(const StereoSetting& a, const StereoSetting& b) {
    const auto same = [](double x, double y) { return std::abs(x - y) <= kFitting * std::max(x, y); };
    return same(a.separation, b.separation) && same(a.zeroParallax, b.zeroParallax);
}

// Makes both eyes, and again with eyes that fit the picture, where that is asked for.
StereoViews makeEyes(const Scene& scene, const FrameWay& way, ViewFrame& frame) {
    FrameRequest& request = frame.request;
    for (int fit = 0;; ++fit) {
        const StereoViews shown = makeStereoViews(request.pose, request.lens, request.stereo);
        const StereoViews views = makeStereoViews(request.pose, castLens(request), request.stereo);
        scene.frames().make(views, request.time, way, frame);
        lookAround(&shown, frame);
        if (!request.fitEyes || fit == kMostFits) return views;
        const StereoSetting fitting = comfortableEyes(request.stereo, {frame.nearParallax, frame.farParallax},
                                                      shown.shiftAtInfinity / shown.left.width);
        if (sameEyes(fitting, request.stereo)) return views;
        request.stereo = fitting;
    }
}

void prepareLate(const Scene& scene, ViewFrame& frame) {
    const SimdTarget simd = scene.simd;
    const bool soft = scene.offered<FrameEffort>() != nullptr;  // media, except layers over ground
    for (LateEye& eye : frame.late) eye.forget();
    const FrameRequest& request = frame.request;
    if (!request.late || request.truth != TruthView::None) return;
    if (!request.twoEyes)
        return frame.late[0].prepare(frame.left.viewDepth, makeEyeView(request.pose, castLens(request)), simd,
                                     soft);
    const StereoViews views = makeStereoViews(request.pose, castLens(request), request.stereo);
    frame.late[0].prepare(frame.left.viewDepth, views.left, simd, soft);
    frame.late[1].prepare(frame.right.viewDepth, views.right, simd, soft);
}

void takeTruth(TruthMaker::Shown shown, ViewFrame& frame) {
    frame.truthNote = std::move(shown.note);
    frame.truthError = shown.error;
}

}  // namespace

void makeFrame(const Scene& scene, const FrameRequest& request, TruthMaker& truth, ViewFrame& frame) {
    frame.request = request;
    frame.rays = 1;
    frame.effort = 1;
    frame.expected_db = 0;
    if (auto* const light = scene.offered<TurningLight>()) light->turnTo(request.sun);
    if (auto* const paint = scene.offered<LivePaint>()) paint->takeUp();
    if (auto* const models = scene.offered<LightModels>()) models->choose(request.model);
    if (auto* const effort = scene.offered<FrameEffort>()) effort->setEffort(request.effort);
    if (auto* const paint = scene.offered<SurfacePaint>()) paint->setOver(request.paintOver);
    EyeView view = makeEyeView(request.pose, castLens(request));
    if (request.twoEyes) {
        const FrameWay way = TruthMaker::wayOf(request.truth, request.way, scene.frames());
        const StereoViews views = makeEyes(scene, way, frame);
        view = views.left;
        paintEyes(scene, views, frame);
        takeTruth(truth.show(request.truth, scene, views, request.time, request.way, frame), frame);
        frame.request.way = way;
    } else {
        scene.frames().makeOne(view, request.time, frame);
        if (RightFromLeft* const cast = scene.frames().rightFromLeft())
            cast->smoothEdges(view, request.way, frame.left);
        paintEye(scene, view, frame.left);
        lookAround(nullptr, frame);
        takeTruth(truth.showOfOneEye(request.truth), frame);
    }
    prepareLate(scene, frame);
    // Not called between the eyes, which have to be lit alike.
    if (auto* const light = scene.offered<SeenLight>()) light->seen(view, frame.left);
    const auto* const detail = scene.offered<LateDetail>();
    frame.lacksDetail = detail && detail->late();
    const auto* const place = scene.offered<SweepPlace>();
    frame.sweep = place ? place->name() : "";
}

}  // namespace stereonav
