// Loading and rendering beside the window.
#include "app/view/worker.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "app/view/frame_pool.h"
#include "app/view/rest_refiner.h"
#include "engine/base/free_memory.h"
#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/base/thread_priority.h"
#include "engine/late/late_guard.h"
#include "engine/scene/surface_paint.h"
#include "engine/stereo/comfort.h"

namespace stereonav {
namespace {

constexpr int kAheadStep = 4;  // every fourth pixel of every fourth row is used to measure the distance ahead
constexpr int kMostFits = 3;   // pictures until the eyes fit: eyes apart see a little more than eyes together
constexpr double kFitting = 1e-6;  // relative change of the eyes that is ignored

bool isWhole(const FrameRequest& request) {
    return request.whole.x < 1 || (request.scale == 1 && request.effort == 1);
}

Lens castLens(const FrameRequest& request) {
    return guarded(request.lens, request.guard);
}

// Returns the request in full size.
FrameRequest inFull(FrameRequest request) {
    request.scale = request.effort = 1;
    request.guard = {0, 0};
    request.lens.width = request.whole.x;
    request.lens.height = request.whole.y;
    return request;
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

void renderFrame(const Scene& scene, const FrameRequest& request, TruthMaker& truth, ViewFrame& frame) {
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

}  // namespace

ViewWorker::ViewWorker(Load load, std::function<void()> wake)
    : mWake(std::move(wake)),
      mPool(std::make_shared<FramePool>()),
      mLoad(std::move(load)),
      mRefiner(std::make_unique<RestRefiner>()),
      mLoader([this] { loadScenes(); }),
      mRenderer([this] { renderFrames(); }) {}

ViewWorker::~ViewWorker() {
    {
        const std::lock_guard lock(mMutex);
        mStop = true;
        mInterrupt = mDrop = true;
        if (mProgress) mProgress->cancel();
    }
    mAsked.notify_all();
    mLoader.join();
    mRenderer.join();
}

void ViewWorker::fail(std::exception_ptr failure) {
    {
        const std::lock_guard lock(mMutex);
        mFailure = std::move(failure);
    }
    mWake();
}

// --- loading

void ViewWorker::loadScenes() {
    stepBehindTheWindow();
    while (const std::optional<Load> load = nextLoad()) {
        loadOne(*load);
        mAsked.notify_all();
        mWake();
    }
}

std::optional<ViewWorker::Load> ViewWorker::nextLoad() {
    std::unique_lock lock(mMutex);
    mLoading.busy = mLoad || mChange;
    mAsked.wait(lock, [this] { return mStop || mLoad || mChange; });
    if (mStop) return std::nullopt;
    mLoading = {true, 0, ""};
    mProgress = std::make_shared<Progress>([this](double fraction, const std::string& what) {
        const std::lock_guard guard(mMutex);
        mLoading = {true, fraction, what};
    });
    return takeWish();
}

// Takes the next wish; the mutex has to be held.
ViewWorker::Load ViewWorker::takeWish() {
    if (mLoad) return *std::exchange(mLoad, std::nullopt);
    return [change = *std::exchange(mChange, std::nullopt), now = mScene](Progress& progress) {
        return change(*now, progress);
    };
}

void ViewWorker::loadOne(const Load& load) {
    try {
        auto scene = std::make_shared<const OpenScene>(load(*mProgress));
        const std::lock_guard lock(mMutex);
        if (!mProgress->cancelled()) mScene = std::move(scene);
        mLoading.busy = mLoad || mChange;  // whoever sees the scene sees this, too
    } catch (const Cancelled&) {
        // Cancelled by a newer wish, or at the end.
    } catch (const std::exception& error) {
        const std::lock_guard lock(mMutex);
        if (!mScene)
            mFailure = std::current_exception();
        else if (!mProgress->cancelled() && !mLoad && !mChange)  // otherwise something newer is wanted
            mReloadProblem = error.what();
    }
}

void ViewWorker::reload(Load load) {
    {
        const std::lock_guard lock(mMutex);
        mLoad = std::move(load);
        mChange.reset();  // the newer wish includes it
        mReloadProblem.clear();
        mLoading = {true, 0, ""};
        if (mProgress && mScene) mProgress->cancel();
    }
    mAsked.notify_all();
}

void ViewWorker::change(Change change) {
    {
        const std::lock_guard lock(mMutex);
        mChange = std::move(change);
        mReloadProblem.clear();
        mLoading.busy = true;
    }
    mAsked.notify_all();
}

void ViewWorker::cancelLoading() {
    const std::lock_guard lock(mMutex);
    mLoad.reset();
    mChange.reset();
    if (mProgress && mScene) mProgress->cancel();
}

void ViewWorker::ask(Task task) {
    {
        const std::lock_guard lock(mMutex);
        mTasks.push_back(std::move(task));
        mInterrupt = true;
    }
    mAsked.notify_all();
}

void ViewWorker::runTask(const Job& job) {
    try {
        job.task(*job.scene);
    } catch (const std::exception&) {
        // The task reports its own failures.
    }
    mWake();
}

ViewWorker::Loading ViewWorker::loading() const {
    const std::lock_guard lock(mMutex);
    return mLoading;
}

std::string ViewWorker::takeReloadProblem() {
    const std::lock_guard lock(mMutex);
    return std::exchange(mReloadProblem, "");
}

std::shared_ptr<const OpenScene> ViewWorker::scene() const {
    const std::lock_guard lock(mMutex);
    if (mFailure) std::rethrow_exception(mFailure);
    return mScene;
}

// --- rendering

struct ViewWorker::Drawn {
    std::optional<Job> job;                  // none yet
    std::shared_ptr<const ViewFrame> frame;  // null once it was measured, or where it is not to be
    bool whole = true;                       // in the size for rest, or something moves
    std::uint64_t lightChanges = 0;          // changes of light when it was drawn
    std::chrono::steady_clock::time_point since;
    bool gaveBack = true;  // free memory was returned since it was drawn
};

void ViewWorker::renderFrames() {
    stepBehindTheWindow();
    Drawn drawn;
    try {
        while (const std::optional<Job> job = nextJob(drawn))
            if (job->task)
                runTask(*job);
            else
                draw(*job, drawn);
    } catch (...) {
        fail(std::current_exception());
    }
}

// Returns whether to drop the picture that is being made: a slow one when something begins to move, so that
// the first small one is there soon; and one in flight when the present requests are much smaller. That
// happens where frames suddenly become slow: the next large one is begun before the time of the last is
// known.
bool ViewWorker::drops(const FrameRequest& request) const {
    constexpr double kMuchSmaller = 0.7;
    const auto work = [](const FrameRequest& of) { return of.scale * of.scale * of.effort; };
    return request.flying && (!mAtWork.flying || work(request) < kMuchSmaller * work(mAtWork));
}

bool ViewWorker::renderUnlessDropped(const Job& job, ViewFrame& frame) {
    const Scene& scene = *job.scene->scene;
    if (!scene.offered<SweepPlace>()) {
        renderFrame(scene, job.request, mTruthMaker, frame);
        return true;
    }
    interruptLoopsBy(job.again ? &mInterrupt : &mDrop);
    bool made = true;
    try {
        renderFrame(scene, job.request, mTruthMaker, frame);
    } catch (const Cancelled&) {
        made = false;
    } catch (...) {
        interruptLoopsBy(nullptr);
        throw;
    }
    interruptLoopsBy(nullptr);
    return made;
}

void ViewWorker::draw(const Job& job, Drawn& drawn) {
    if (!job.again) drawn.job = job;
    drawn.frame.reset();
    const auto* const light = job.scene->scene->offered<SeenLight>();
    if (light) drawn.lightChanges = light->changes();
    auto frame = mPool->take();
    const Stopwatch watch;
    if (!renderUnlessDropped(job, *frame)) {
        if (!job.again) drawn.whole = true;  // something newer is asked for
        return;
    }
    frame->made_ms = watch.elapsed_ms();
    std::shared_ptr<const ViewFrame> shared = mPool->share(std::move(frame));
    if (job.request.fitEyes && !job.again)
        drawn.job->request = shared->request;  // drawn again with the same eyes
    drawn.whole = isWhole(job.request) || job.request.flying;
    // Differences are measured already.
    if (!shared->truthError && drawn.whole) drawn.frame = shared;
    drawn.since = std::chrono::steady_clock::now();
    drawn.gaveBack = false;
    mRefiner->start(shared);
    {
        const std::lock_guard lock(mMutex);
        if (shared->truthError) mTruth = FrameTruth{shared->request.version, *shared->truthError, 0, ""};
        mNewest.swap(shared);
    }
    mWake();
}

std::optional<ViewWorker::Job> ViewWorker::nextJob(Drawn& drawn) {
    constexpr std::chrono::milliseconds kLookAtLight{100};
    std::unique_lock lock(mMutex);
    const auto asked = [this] { return mStop || ((mRequest || !mTasks.empty()) && mScene); };
    const auto* const light = drawn.job ? drawn.job->scene->scene->offered<SeenLight>() : nullptr;
    while (!asked()) {
        if (!drawn.whole && drawn.job->scene == mScene) {
            mInterrupt = false;
            return Job{inFull(drawn.job->request), drawn.job->scene, nullptr, true};
        }
        const bool measures = drawn.frame != nullptr, refines = mRefiner->wantsMore();
        const auto now = std::chrono::steady_clock::now(), rested = drawn.since + kRest;
        if (light && drawn.job->scene == mScene && light->changes() != drawn.lightChanges &&
            now >= drawn.since + kLookAtLight)
            return drawn.job;
        if ((measures || refines) && now >= rested) {
            mInterrupt = false;
            lock.unlock();
            if (measures)
                measure(drawn);
            else
                refine(drawn);
            lock.lock();
        } else if (!measures && !refines && !drawn.gaveBack && now >= drawn.since + kLongRest) {
            drawn.gaveBack = true;
            lock.unlock();
            giveBackFreeMemory();
            lock.lock();
        } else if (light) {
            const auto until =
                measures || refines ? std::min(now + kLookAtLight, rested) : now + kLookAtLight;
            mAsked.wait_until(lock, until, asked);
        } else if (measures || refines) {
            mAsked.wait_until(lock, rested);
        } else if (!drawn.gaveBack) {
            mAsked.wait_until(lock, drawn.since + kLongRest);
        } else {
            mAsked.wait(lock);
        }
    }
    if (mStop) return std::nullopt;
    if (!mRequest) {
        Task task = std::move(mTasks.front());
        mTasks.pop_front();
        return Job{{}, mScene, std::move(task)};
    }
    mDrop = false;
    mAtWork = *mRequest;
    return Job{*std::exchange(mRequest, std::nullopt), mScene};
}

void ViewWorker::measure(Drawn& drawn) {
    const std::shared_ptr<const ViewFrame> frame = std::exchange(drawn.frame, nullptr);
    const FrameRequest& request = frame->request;
    std::optional<FrameTruth> truth;
    try {
        const StereoViews views = makeStereoViews(request.pose, request.lens, request.stereo);
        truth = mTruthMaker.measure(*drawn.job->scene->scene, views, request.time, request.way, *frame,
                                    mInterrupt);
    } catch (const std::exception& error) {  // the picture remains valid
        mTruthMaker.forget();
        truth.emplace().note = std::string("the right eye could not be measured: ") + error.what();
    }
    if (!truth) return;
    truth->version = request.version;
    {
        const std::lock_guard lock(mMutex);
        mTruth = std::move(truth);
    }
    mWake();
}

void ViewWorker::refine(const Drawn& drawn) {
    auto frame = mPool->take();
    bool shows = false;
    interruptLoopsBy(&mInterrupt);
    try {
        shows = mRefiner->step(*drawn.job->scene->scene, *frame);
    } catch (const std::exception&) {
        // The picture remains valid; something new is asked for, or it can not be refined further.
    }
    interruptLoopsBy(nullptr);
    std::shared_ptr<const ViewFrame> shared = mPool->share(std::move(frame));
    if (!shows) return;
    {
        const std::lock_guard lock(mMutex);
        if (mRequest) return;  // it would be shown after the first step of the new motion
        mNewest.swap(shared);
    }
    mWake();
}

std::optional<FrameTruth> ViewWorker::takeTruth() {
    const std::lock_guard lock(mMutex);
    return std::exchange(mTruth, std::nullopt);
}

void ViewWorker::request(const FrameRequest& request) {
    {
        const std::lock_guard lock(mMutex);
        mRequest = request;
        mInterrupt = true;
        if (drops(request)) mDrop = true;
    }
    mAsked.notify_all();
}

std::shared_ptr<const ViewFrame> ViewWorker::takeFrame() {
    const std::lock_guard lock(mMutex);
    if (mFailure) std::rethrow_exception(mFailure);
    return std::exchange(mNewest, nullptr);
}

}  // namespace stereonav
