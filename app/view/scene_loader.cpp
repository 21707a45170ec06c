#include "app/view/scene_loader.h"

#include <utility>

#include "engine/base/error.h"
#include "engine/base/thread_priority.h"

namespace stereonav {

SceneLoader::SceneLoader(Load first, Show show, std::function<void()> wake)
    : mShow(std::move(show)), mWake(std::move(wake)), mLoad(std::move(first)), mThread([this] { run(); }) {}

SceneLoader::~SceneLoader() {
    {
        const std::lock_guard lock(mMutex);
        mStop = true;
        if (mProgress) mProgress->cancel();
    }
    mWished.notify_all();
}

void SceneLoader::run() {
    stepBehindTheWindow();
    while (const std::optional<Load> load = next()) {
        loadOne(*load);
        mWake();
    }
}

std::optional<SceneLoader::Load> SceneLoader::next() {
    std::unique_lock lock(mMutex);
    mLoading.busy = mLoad || mChange;
    mWished.wait(lock, [this] { return mStop || mLoad || mChange; });
    if (mStop) return std::nullopt;
    mLoading = {true, 0, ""};
    mProgress = std::make_shared<Progress>([this](double fraction, const std::string& what) {
        const std::lock_guard guard(mMutex);
        mLoading = {true, fraction, what};
    });
    return takeWish();
}

// Takes the next wish; the mutex has to be held.
SceneLoader::Load SceneLoader::takeWish() {
    if (mLoad) return *std::exchange(mLoad, std::nullopt);
    return [change = *std::exchange(mChange, std::nullopt), now = mScene](Progress& progress) {
        return change(*now, progress);
    };
}

void SceneLoader::loadOne(const Load& load) {
    try {
        auto scene = std::make_shared<const OpenScene>(load(*mProgress));
        const std::lock_guard lock(mMutex);
        if (!mProgress->cancelled()) mShow(mScene = std::move(scene));
        mLoading.busy = mLoad || mChange;  // whoever sees the scene sees this, too
    } catch (const Cancelled&) {
        // Cancelled by a newer wish, or at the end.
    } catch (const std::exception& error) {
        const std::lock_guard lock(mMutex);
        if (!mScene)
            mFailure = std::current_exception();
        else if (!mProgress->cancelled() && !mLoad && !mChange)  // otherwise something newer is wanted
            mProblem = error.what();
    }
}

void SceneLoader::reload(Load load) {
    {
        const std::lock_guard lock(mMutex);
        mLoad = std::move(load);
        mChange.reset();  // the newer wish includes it
        mProblem.clear();
        mLoading = {true, 0, ""};
        if (mProgress && mScene) mProgress->cancel();
    }
    mWished.notify_all();
}

void SceneLoader::change(Change change) {
    {
        const std::lock_guard lock(mMutex);
        mChange = std::move(change);
        mProblem.clear();
        mLoading.busy = true;
    }
    mWished.notify_all();
}

void SceneLoader::cancel() {
    const std::lock_guard lock(mMutex);
    mLoad.reset();
    mChange.reset();
    if (mProgress && mScene) mProgress->cancel();
}

SceneLoader::Loading SceneLoader::loading() const {
    const std::lock_guard lock(mMutex);
    return mLoading;
}

std::string SceneLoader::takeProblem() {
    const std::lock_guard lock(mMutex);
    return std::exchange(mProblem, "");
}

std::shared_ptr<const OpenScene> SceneLoader::newest() const {
    const std::lock_guard lock(mMutex);
    if (mFailure) std::rethrow_exception(mFailure);
    return mScene;
}

}  // namespace stereonav
