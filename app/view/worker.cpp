#include "app/view/worker.h"

#include <algorithm>
#include <utility>

#include "app/view/frame_making.h"
#include "engine/base/error.h"
#include "engine/base/free_memory.h"
#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/base/thread_priority.h"

namespace stereonav {
namespace {

bool isWhole(const FrameRequest& request) {
    return request.whole.x < 1 || (request.scale == 1 && request.effort == 1);
}

// Returns the request in full size.
FrameRequest inFull(FrameRequest request) {
    request.scale = request.effort = 1;
    request.guard = {0, 0};
    request.lens.width = request.whole.x;
    request.lens.height = request.whole.y;
    return request;
}

}  // namespace

ViewWorker::ViewWorker(SceneLoader::Load load, std::function<void()> wake)
    : mWake(std::move(wake)),
      mPool(std::make_shared<FramePool>()),
      mRenderer([this] { renderFrames(); }),
      mLoader(
          std::move(load), [this](const auto& scene) { use(scene); }, mWake) {}

ViewWorker::~ViewWorker() {
    {
        const std::lock_guard lock(mMutex);
        mStop = true;
        mInterrupt = mDrop = true;
    }
    mAsked.notify_all();
}

void ViewWorker::use(const std::shared_ptr<const OpenScene>& scene) {
    {
        const std::lock_guard lock(mMutex);
        mScene = scene;
    }
    mAsked.notify_all();
}

void ViewWorker::fail(std::exception_ptr failure) {
    {
        const std::lock_guard lock(mMutex);
        mFailure = std::move(failure);
    }
    mWake();
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
        makeFrame(scene, job.request, mTruthMaker, frame);
        return true;
    }
    interruptLoopsBy(job.again ? &mInterrupt : &mDrop);
    bool made = true;
    try {
        makeFrame(scene, job.request, mTruthMaker, frame);
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
    mRefiner.start(shared);
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
        const bool measures = drawn.frame != nullptr, refines = mRefiner.wantsMore();
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
        shows = mRefiner.step(*drawn.job->scene->scene, *frame);
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
