// Loading and rendering beside the window.
#include "app/view/worker.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

namespace stereonav {
namespace {

constexpr int kParallaxStep = 4;  // every fourth pixel of every fourth row tells the range of depths

// What the frame's left eye tells of the room around it.
void lookAround(const StereoViews* views, ViewFrame& frame) {
    const RoomSeen room = roomSeen(frame.left.viewDepth, kParallaxStep);
    frame.depthAhead = room.ahead;
    if (!views) return;
    const ParallaxRange parallax = parallaxOf(*views, room);
    frame.nearParallax = parallax.near;
    frame.farParallax = parallax.far;
}

void renderFrame(const Scene& scene, const FrameRequest& request, ViewFrame& frame) {
    frame.request = request;
    frame.nearParallax = frame.farParallax = 0;
    if (auto* const light = scene.offered<TurningLight>()) light->turnTo(request.sun);
    if (auto* const models = scene.offered<LightModels>()) models->choose(request.model);
    std::optional<StereoViews> views;
    EyeView view = makeEyeView(request.pose, request.lens);
    if (request.twoEyes) {
        views = makeStereoViews(request.pose, request.lens, request.stereo);
        view = views->left;
        scene.frames().make(*views, request.time, request.way, frame);
    } else {
        scene.frames().makeOne(view, request.time, frame);
    }
    lookAround(views ? &*views : nullptr, frame);
    // Not between the eyes, which are to be lit alike.
    if (auto* const light = scene.offered<SeenLight>()) light->seen(view, frame.left);
    const auto* const place = scene.offered<SweepPlace>();
    frame.sweep = place ? place->name() : "";
}

}  // namespace

// Frames that nobody looks at any more, to be used again: three or four are enough for ever.
class ViewWorker::FramePool : public std::enable_shared_from_this<FramePool> {
public:
    std::unique_ptr<ViewFrame> take() {
        const std::lock_guard lock(mMutex);
        if (mFree.empty()) return std::make_unique<ViewFrame>();
        auto frame = std::move(mFree.back());
        mFree.pop_back();
        return frame;
    }
    // Comes back here when its last reader lets it go, on whatever thread.
    std::shared_ptr<const ViewFrame> share(std::unique_ptr<ViewFrame> frame) {
        return {frame.release(), [pool = shared_from_this()](const ViewFrame* done) {
                    const std::lock_guard lock(pool->mMutex);
                    pool->mFree.emplace_back(const_cast<ViewFrame*>(done));
                }};
    }

private:
    std::mutex mMutex;
    std::vector<std::unique_ptr<ViewFrame>> mFree;
};

ViewWorker::ViewWorker(Load load, std::function<void()> wake)
    : mWake(std::move(wake)),
      mPool(std::make_shared<FramePool>()),
      mLoad(std::move(load)),
      mLoader([this] { loadScenes(); }),
      mRenderer([this] { renderFrames(); }) {}

ViewWorker::~ViewWorker() {
    {
        const std::lock_guard lock(mMutex);
        mStop = true;
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

// Under the mutex.
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
    } catch (const Cancelled&) {
        // by a newer wish, or at the end
    } catch (const std::exception& error) {
        const std::lock_guard lock(mMutex);
        if (!mScene)
            mFailure = std::current_exception();
        else
            mReloadProblem = error.what();
    }
}

void ViewWorker::reload(Load load) {
    {
        const std::lock_guard lock(mMutex);
        mLoad = std::move(load);
        mChange.reset();  // it is part of the newer wish
        mLoading = {true, 0, ""};
        if (mProgress && mScene) mProgress->cancel();
    }
    mAsked.notify_all();
}

void ViewWorker::change(Change change) {
    {
        const std::lock_guard lock(mMutex);
        mChange = std::move(change);
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
    }
    mAsked.notify_all();
}

void ViewWorker::runTask(const Job& job) {
    try {
        job.task(*job.scene);
    } catch (const std::exception&) {
        // it tells who asked, or nobody
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

void ViewWorker::renderFrames() {
    std::optional<Job> last;
    std::uint64_t changes = 0;
    try {
        while (std::optional<Job> job = nextJob(last, changes)) {
            if (job->task) {
                runTask(*job);
                continue;
            }
            last = job;
            const auto* const light = job->scene->scene->offered<SeenLight>();
            if (light) changes = light->changes();
            auto frame = mPool->take();
            renderFrame(*job->scene->scene, job->request, *frame);
            auto shared = mPool->share(std::move(frame));
            {
                const std::lock_guard lock(mMutex);
                mNewest.swap(shared);
            }
            mWake();
        }
    } catch (...) {
        fail(std::current_exception());
    }
}

std::optional<ViewWorker::Job> ViewWorker::nextJob(const std::optional<Job>& last, std::uint64_t changes) {
    constexpr std::chrono::milliseconds kLookAtLight{100};
    std::unique_lock lock(mMutex);
    const auto asked = [this] { return mStop || ((mRequest || !mTasks.empty()) && mScene); };
    const auto* const light = last ? last->scene->scene->offered<SeenLight>() : nullptr;
    while (!asked()) {
        if (!light)
            mAsked.wait(lock, asked);
        else if (!mAsked.wait_for(lock, kLookAtLight, asked) && last->scene == mScene &&
                 light->changes() != changes)
            return last;
    }
    if (mStop) return std::nullopt;
    if (!mRequest) {
        Task task = std::move(mTasks.front());
        mTasks.pop_front();
        return Job{{}, mScene, std::move(task)};
    }
    return Job{*std::exchange(mRequest, std::nullopt), mScene};
}

void ViewWorker::request(const FrameRequest& request) {
    {
        const std::lock_guard lock(mMutex);
        mRequest = request;
    }
    mAsked.notify_all();
}

std::shared_ptr<const ViewFrame> ViewWorker::takeFrame() {
    const std::lock_guard lock(mMutex);
    if (mFailure) std::rethrow_exception(mFailure);
    return std::exchange(mNewest, nullptr);
}

}  // namespace stereonav
