// The viewer's part that asks for frames and shows the newest one as it is seen now.
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "app/view/frame_views.h"
#include "app/view/viewer.h"
#include "engine/display/renderer_name.h"

namespace stereonav {

void Viewer::askFor() {
    const OutputModeInfo& mode = infoOf(mSession->compose().mode);
    const glm::ivec2 all = composedAt(mode, placeFor(mode));
    if (mWindow.minimised()) return;
    const bool screenshot = mSession->takeScreenshotWish();
    mSession->driftAtRest(!mSettings.options().refine);
    const auto [scale, effort] = sizeNow(screenshot);
    const bool late =
        mSettings.options().lateWarp && mSession->flying() && !screenshot && !mScreenshots.waiting();
    if (late && !mPresent.flying) mLead.begin(mGovernor.usual_ms() / 1000);
    const double ahead = late ? mLead.seconds() : 0;
    if (!late) mGuard.forget();
    FrameRequest request = mSession->requestFor(all.x, all.y, ahead, scale, mGuard.shares());
    request.late = mSettings.options().lateWarp;
    request.refines = mSettings.options().refine;
    request.flying = late;
    request.effort = effort;
    request.asked_s = request.version == mPresent.version ? mPresent.asked_s : Window::now();
    request.ahead_s = ahead;
    if (request.version != mAsked) mWorker->request(request);
    mAsked = request.version;
    if (screenshot) mScreenshots.wish(mAsked);
    mPresent = std::move(request);
    // The picture for now, which the frame is warped to.
    mPresent.pose = mSession->pose();
    if (ahead > 0) mPresent.time = mSession->time();
    const auto [width, height] = eyeSizeFor(mPresent.mode, all.x, all.y);
    mPresent.lens.width = width;
    mPresent.lens.height = height;
    mPresent.ahead_s = 0;
    mPresent.guard = {0, 0};
    mPresent.scale = mPresent.effort = 1;
}

// Of the frames that are asked for now. Truths and pictures that are saved are whole.
FrameGovernor::Size Viewer::sizeNow(bool screenshot) {
    constexpr double kMost = 40;   // milliseconds: what is seen for longer lags behind
    constexpr double kMedium = 4;  // times: a smaller picture of a medium saves less
    constexpr double kFirst =
        800;  // at rest, as frames take in flight, beside the warp: those of more wait for a smaller one
    const Scene& scene = *mSession->open().scene;
    const bool swept = scene.offered<SweepPlace>() != nullptr;
    mGovernor.setMedium(swept, scene.offered<FrameEffort>() != nullptr);
    const double usual = std::min(2000 * mDisplay.refreshPeriod(), kMost) * (swept ? kMedium : 1);
    mGovernor.setTarget(mSettings.options().target_ms.value_or(usual));
    const glm::dvec2 wide = 1.0 + 2.0 * mGuard.shares();
    mGovernor.setArea(mSession->flying() ? wide.x * wide.y : 1);
    const bool whole = screenshot || mScreenshots.waiting() || mSession->truth() != TruthView::None;
    if (mSession->flying()) mRestSize.reset();
    if (!mSettings.options().lateWarp || whole) return {};
    if (mSession->flying()) return {mGovernor.scale(), mGovernor.effort()};
    if (!swept) return {};
    if (!mRestSize) mRestSize = mGovernor.sizeWithin(kFirst);  // until something moves again
    return *mRestSize;
}

// Whether the newest frame is not of this moment, and can be seen from where the eyes are now.
bool Viewer::warps() const {
    return mSettings.options().lateWarp && mFrame && mFrame->request.version > mSessionSince &&
           !sameView(mFrame->request, mPresent) && LateView::fits(*mFrame, mPresent);
}

bool Viewer::lateDue() const {
    constexpr double kEarly = 0.0005;  // seconds: a turn is not worth waiting so little for
    const bool shown = sameView(mPicture.of, mPresent) && mPicture.cast.version == mFrame->request.version;
    if (!warps() || (mPicture.left && shown)) return false;
    return Window::now() >= mLateShown + latePeriod() - kEarly;
}

std::string Viewer::ageText() const {
    if (!mPicture.warped || mPicture.cast.asked_s <= 0) return "";
    return fmt::format("{:3.0f} ms old{}", 1000 * (Window::now() - mPicture.cast.asked_s),
                       mPicture.cast.scale < 1 ? fmt::format(", {:.0f} %", 100 * mPicture.cast.scale) : "");
}

double Viewer::latePeriod() const {
    return mLatePace.period(mDisplay.refreshPeriod(), 0);
}

void Viewer::showFrame() {
    using Eye = StereoPresenter::SharedEye;
    const Eye left(mFrame, &mFrame->left.color), right(mFrame, &mFrame->right.color);
    mPresenter.show(left, right);
    mOnGpu = false;
    mPicture = {left, right, mFrame->request, mFrame->request, false};
    mNewFrame = true;
}

// STEREONAV_LATE_WARP=gpu or cpu says it for tests.
bool Viewer::drawsLateOnGpu() {
    if (std::exchange(mLateGpuDecided, true)) return mLateGpu != nullptr;
    mWindow.use();
    const char* const said = std::getenv("STEREONAV_LATE_WARP");
    const auto* const renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const bool wanted = said ? std::string_view(said) == "gpu" : renderer && !drawsInSoftware(renderer);
    if (!wanted) return false;
    auto gpu = std::make_unique<LateWarpGpu>();
    if (gpu->works()) mLateGpu = std::move(gpu);
    return mLateGpu != nullptr;
}

bool Viewer::showLateOnGpu() {
    if (!drawsLateOnGpu()) return false;
    mWindow.use();
    const StereoViews views = viewsOf(mPresent);
    const std::size_t eyes = mPresent.twoEyes ? 2 : 1;
    std::array<GLuint, 2> drawn{};
    for (std::size_t n = 0; n < eyes; ++n) {
        const EyeImage& eye = n == 0 ? mFrame->left : mFrame->right;
        if (mLateGpuHas != mFrame) mLateGpu->take(n, mFrame->late[n], eye.color);
        drawn[n] = mLateGpu->warp(n, mFrame->late[n], n == 0 ? views.left : views.right);
    }
    mLateGpuHas = mFrame;
    mPresenter.showTextures(drawn[0], drawn[1], mPresent.lens.width, mPresent.lens.height);
    using Eye = StereoPresenter::SharedEye;
    mPicture = {Eye(mFrame, &mFrame->left.color), Eye(mFrame, &mFrame->right.color), mPresent,
                mFrame->request, true};
    if (!mBench) return true;
    // It is held against truths later.
    const auto read = std::make_shared<LateView::Eyes>();
    for (std::size_t n = 0; n < eyes; ++n) mLateGpu->read(n, (*read)[n]);
    mPicture.left = Eye(read, &(*read)[0]);
    mPicture.right = Eye(read, &(*read)[1]);
    return true;
}

void Viewer::showLate() {
    const double now = Window::now();
    // Even where a turn came late now and then.
    mLateShown = std::max(mLateShown + latePeriod(), now - latePeriod() / 2);
    mOnGpu = showLateOnGpu();
    if (!mOnGpu) {
        const std::shared_ptr<const LateView::Eyes> eyes = mLate.warp(*mFrame, mPresent);
        using Eye = StereoPresenter::SharedEye;
        const Eye left(eyes, &(*eyes)[0]), right(eyes, &(*eyes)[1]);
        mPresenter.show(left, right);
        mPicture = {left, right, mPresent, mFrame->request, true};
    }
    if (mSession->flying()) mGuard.saw(LateView::seenBeyond(*mFrame, mPresent), now);
    mRate.count(mSession->moving());
    mNewFrame = true;
}

}  // namespace stereonav
