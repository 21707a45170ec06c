#include "app/view/frame_presenter.h"

#include <algorithm>

namespace stereonav {
namespace {

constexpr std::size_t kKeptCosts = 240;  // frames

using SharedEye = StereoPresenter::SharedEye;

FrameCost costOf(const ViewFrame& frame) {
    const FrameTimings& timings = frame.timings;
    FrameCost cost{timings.left_ms > 0 ? timings.left_ms : timings.both_ms, timings.right_ms, 0, 0, 0};
    if (!timings.warped) return cost;
    cost.warp_ms = timings.warped->warp_ms;
    cost.fill_ms = timings.warped->fill_ms;
    const double pixels = static_cast<double>(frame.left.width()) * frame.left.height();
    if (pixels > 0) cost.holes = 100 * static_cast<double>(timings.warped->holePixels) / pixels;
    return cost;
}

}  // namespace

glm::ivec2 FramePresenter::eyeSize() const {
    if (mWay == PictureWay::LateByCard) return {mPicture.of.lens.width, mPicture.of.lens.height};
    return mPicture.left ? glm::ivec2(mPicture.left->width(), mPicture.left->height()) : glm::ivec2(0);
}

std::optional<LatePicture> FramePresenter::late() const {
    if (!mPicture.warped || mPicture.cast.asked_s <= 0) return std::nullopt;
    return LatePicture{Window::now() - mPicture.cast.asked_s, mPicture.cast.scale};
}

void FramePresenter::take(std::shared_ptr<const ViewFrame> frame, const AskedFrames& asked, bool lateWarp) {
    mFrame = std::move(frame);
    mCame = true;
    if (!asked.warps(mFrame.get(), lateWarp)) mRate.count(!asked.isNewest(*mFrame));
    mCosts.push_back(costOf(*mFrame));
    if (mCosts.size() > kKeptCosts) mCosts.pop_front();
}

PictureWay FramePresenter::wayOf(const ViewSession& session, const AskedFrames& asked, bool lateWarp) {
    if (session.slices().shown()) return PictureWay::Slices;
    if (!asked.warps(mFrame.get(), lateWarp)) return PictureWay::Cast;
    return mCard.works() ? PictureWay::LateByCard : PictureWay::LateByProcessor;
}

void FramePresenter::show(ViewSession& session, AskedFrames& asked, bool lateWarp, double refresh) {
    const PictureWay way = wayOf(session, asked, lateWarp);
    const bool came = std::exchange(mCame, false);
    if (way == PictureWay::Slices) return;
    if (way == PictureWay::Cast) {
        if (came) showFrame();
        return;
    }
    if (!lateDue(asked, refresh)) return;
    const double now = Window::now();
    // The pace is kept even where a turn came late now and then.
    mLateShown = std::max(mLateShown + latePeriod(refresh), now - latePeriod(refresh) / 2);
    showLate(way, asked.present());
    if (session.flying()) asked.saw(LateView::seenBeyond(*mFrame, asked.present()), now);
    mRate.count(session.moving());
}

bool FramePresenter::lateDue(const AskedFrames& asked, double refresh) const {
    constexpr double kEarly = 0.0005;  // seconds: waiting for less is not worth a turn
    const bool shown =
        sameView(mPicture.of, asked.present()) && mPicture.cast.version == mFrame->request.version;
    if (mPicture.left && shown) return false;
    return Window::now() >= mLateShown + latePeriod(refresh) - kEarly;
}

std::optional<double> FramePresenter::wait(const AskedFrames& asked, bool lateWarp, double refresh) const {
    if (!asked.warps(mFrame.get(), lateWarp)) return std::nullopt;
    return mLateShown + latePeriod(refresh) - Window::now();
}

void FramePresenter::showFrame() {
    const SharedEye left(mFrame, &mFrame->left.color), right(mFrame, &mFrame->right.color);
    mEyes.show(left, right);
    mWay = PictureWay::Cast;
    mPicture = {left, right, mFrame->request, mFrame->request, false};
    mFresh = true;
}

void FramePresenter::showLate(PictureWay way, const FrameRequest& now) {
    SharedEye left, right;
    const auto takeEyes = [&](const std::shared_ptr<const LateView::Eyes>& eyes) {
        left = SharedEye(eyes, &(*eyes)[0]);
        right = SharedEye(eyes, &(*eyes)[1]);
    };
    if (way == PictureWay::LateByCard) {
        const auto [first, second] = mCard.warp(mFrame, now);
        mEyes.showTextures(first, second, now.lens.width, now.lens.height);
        left = SharedEye(mFrame, &mFrame->left.color);
        right = SharedEye(mFrame, &mFrame->right.color);
        if (mReadsBack) takeEyes(mCard.read(now.twoEyes));
    } else {
        takeEyes(mLate.warp(*mFrame, now));
        mEyes.show(left, right);
    }
    mWay = way;
    mPicture = {left, right, now, mFrame->request, true};
    mFresh = true;
}

void FramePresenter::showSlices(ViewSession& session, const SizeOption& eye, Screenshots& screenshots) {
    const Plane<PackedColor>& picture = session.slices().picture(eye.width, eye.height);
    screenshots.take(picture, session.compose());
    if (session.slices().version() == mSlices) return;
    mSlices = session.slices().version();
    mEyes.upload(picture, {});
    mPicture = {};
    mWay = PictureWay::Slices;
    mFresh = true;
}

void FramePresenter::leaveSlices() {
    if (std::exchange(mSlices, 0) == 0) return;
    if (mFrame) showFrame();
    mFresh = true;
}

void FramePresenter::drew(double seconds) {
    if (mPicture.warped) mPace.took(seconds);
}

}  // namespace stereonav
