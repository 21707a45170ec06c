// Loading and rendering beside the window.
#include "app/view_worker.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/base/stopwatch.h"

namespace stereonav {
namespace {

constexpr int kParallaxStep = 4;  // every fourth pixel of every fourth row tells the range of depths

void measureParallax(const StereoViews& views, ViewFrame& frame) {
    const double width = std::max(frame.left.width(), 1);
    float nearest = kMissDepth, farthest = 0;
    for (int y = 0; y < frame.left.height(); y += kParallaxStep)
        for (int x = 0; x < frame.left.width(); x += kParallaxStep) {
            const float depth = frame.left.viewDepth.at(x, y);
            nearest = std::min(nearest, depth);
            farthest = std::max(farthest, depth);
        }
    const auto share = [&](float depth) {
        return depth > 0 ? (views.shiftAtInfinity - views.parallaxScale / depth) / width : 0.0;
    };
    frame.nearParallax = share(nearest);
    frame.farParallax = share(farthest);
}

void renderFrame(const ViewScene& scene, const FrameRequest& request, RightEye& rightEye, ViewFrame& frame) {
    const EyeRenderer& renderer = *scene.renderer;
    frame.request = request;
    frame.rightTimings = {};
    frame.nearParallax = frame.farParallax = 0;
    frame.left.resize(request.lens.width, request.lens.height, renderer.viewDependence());
    const Stopwatch watch;
    if (!request.twoEyes) {
        renderEye(renderer, makeEyeView(request.pose, request.lens), frame.left);
        frame.left_ms = watch.elapsed_ms();
        frame.right = {};
        return;
    }
    const StereoViews views = makeStereoViews(request.pose, request.lens, request.stereo);
    renderEye(renderer, views.left, frame.left);
    frame.left_ms = watch.elapsed_ms();
    frame.rightTimings = rightEye.render(renderer, views, frame.left, request.warp, frame.right);
    measureParallax(views, frame);
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
    : mLoad(std::move(load)),
      mWake(std::move(wake)),
      mProgress([this](double fraction, const std::string& what) {
          const std::lock_guard lock(mMutex);
          mLoading = {fraction, what};
      }),
      mPool(std::make_shared<FramePool>()),
      mThread([this] { run(); }) {}

ViewWorker::~ViewWorker() {
    mProgress.cancel();
    {
        const std::lock_guard lock(mMutex);
        mStop = true;
    }
    mAsked.notify_all();
    mThread.join();
}

void ViewWorker::run() {
    try {
        auto scene = std::make_unique<ViewScene>(mLoad(mProgress));
        const ViewScene& loaded = *scene;
        {
            const std::lock_guard lock(mMutex);
            mScene = std::move(scene);
        }
        mWake();
        work(loaded);
    } catch (...) {
        {
            const std::lock_guard lock(mMutex);
            mFailure = std::current_exception();
        }
        mWake();
    }
}

void ViewWorker::work(const ViewScene& scene) {
    RightEye rightEye;
    while (const std::optional<FrameRequest> request = nextRequest()) {
        auto frame = mPool->take();
        renderFrame(scene, *request, rightEye, *frame);
        auto shared = mPool->share(std::move(frame));
        {
            const std::lock_guard lock(mMutex);
            mNewest.swap(shared);
        }
        mWake();
    }
}

std::optional<FrameRequest> ViewWorker::nextRequest() {
    std::unique_lock lock(mMutex);
    mAsked.wait(lock, [this] { return mStop || mRequest; });
    if (mStop) return std::nullopt;
    return std::exchange(mRequest, std::nullopt);
}

ViewWorker::Loading ViewWorker::loading() const {
    const std::lock_guard lock(mMutex);
    return mLoading;
}

const ViewScene* ViewWorker::scene() const {
    const std::lock_guard lock(mMutex);
    if (mFailure) std::rethrow_exception(mFailure);
    return mScene.get();
}

void ViewWorker::request(const FrameRequest& request) {
    {
        const std::lock_guard lock(mMutex);
        mRequest = request;
    }
    mAsked.notify_one();
}

std::shared_ptr<const ViewFrame> ViewWorker::takeFrame() {
    const std::lock_guard lock(mMutex);
    if (mFailure) std::rethrow_exception(mFailure);
    return std::exchange(mNewest, nullptr);
}

}  // namespace stereonav
