#include "app/view/stereo.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/view/status.h"

namespace stereonav {
namespace {

constexpr double kStereoSeconds = 0.35;      // time constant: eyes follow slow changes, not jumps
constexpr double kSettled = 1e-3;            // relative difference at which a slow change ends
constexpr double kFirstSeparation = 1e-3;    // share of the zero-parallax distance: the step up from 0
constexpr double kLargestSeparation = 0.25;  // share of the zero-parallax distance
// Relative change below which the eyes count as at rest: less than 0.05 pixels of 1280 at the largest
// comfortable parallax. A resting picture is refined only once the eyes do not move.
constexpr double kFollowed = 1e-3;
constexpr double kLeastZoom = 1e-9;  // factor of eyes that were zoomed with

// Returns the next value of an exponential approach in the logarithm, so that halving and doubling look
// alike.
double approach(double now, double target, double dt) {
    if (!(now > 0) || !(target > 0) || std::abs(now - target) <= kSettled * target) return target;
    return target * std::pow(now / target, std::exp(-dt / kStereoSeconds));
}

bool differs(const StereoSetting& a, const StereoSetting& b, double share = kFollowed) {
    const auto apart = [share](double x, double y) { return std::abs(x - y) > share * y; };
    return apart(a.separation, b.separation) || apart(a.zeroParallax, b.zeroParallax);
}

}  // namespace

ViewStereo::ViewStereo(const Scene& scene) : mGiven(scene.eyesGiven) {
    reset(scene);
    mNow = mByHand = mTarget;
    if (follows()) follow();  // follows from the new setting
    mArrives = follows();
}

void ViewStereo::look(const Scene& scene) {
    mRoom = scene.offered<RoomAround>();
    mLargest = mRoom ? mRoom->largestSeparation() : std::numeric_limits<double>::infinity();
}

void ViewStereo::reset(const Scene& scene) {
    takeOver();
    endZoom();
    mTarget = begun(scene);
    mFits = !mGiven && !mStart;
    mFitted = mStart.has_value();
    look(scene);
    if (mRoom && mRoom->followsAtStart()) follow();
}

void ViewStereo::replaceScene(const Scene& scene) {
    look(scene);
    if (follows()) follow();
    mTarget.separation = std::min(mTarget.separation, mLargest);
}

void ViewStereo::follow() {
    mNow = now();
    mZoom = mZoomTo = 1;
    mFollower = mRoom ? mRoom->makeFollower(mNow) : nullptr;
    if (follows()) mComfort.restart();
}

// Takes the shown setting as the one asked for.
void ViewStereo::takeOver() {
    if (follows() || clamping()) {
        mTarget = mByHand = mNow;
        mComfort.restart();
    }
    mFollower = nullptr;
    mFits = mFitted = mArrives = false;
}

void ViewStereo::zoom(double factor) {
    if (!(factor > 0) || !std::isfinite(factor)) return;
    if (!follows()) {
        mZoom = mZoomTo = std::clamp(mZoom * factor, kLeastZoom, 1 / kLeastZoom);
        return;
    }
    mNow.separation = std::min(mNow.separation * factor, mLargest);
    mNow.zeroParallax *= factor;
    mFollower = mRoom->makeFollower(mNow);
}

StereoSetting ViewStereo::now() const {
    if (mZoom == 1) return mNow;
    return {std::min(mNow.separation * mZoom, mLargest), mNow.zeroParallax * mZoom};
}

// The largest separation has priority over the distance of the screen.
void ViewStereo::setTarget(const StereoSetting& target) {
    mTarget.zeroParallax = target.zeroParallax;
    const double least = kFirstSeparation * target.zeroParallax;
    mTarget.separation = target.separation < least ? 0 : target.separation;
    mTarget.separation = std::min({mTarget.separation, kLargestSeparation * target.zeroParallax, mLargest});
}

void ViewStereo::scaleSeparation(double factor) {
    takeOver();
    const double least = kFirstSeparation * mTarget.zeroParallax, scaled = mTarget.separation * factor;
    setTarget({factor > 1 ? std::max(scaled, least) : scaled, mTarget.zeroParallax});
}

void ViewStereo::scaleZeroParallax(double factor) {
    takeOver();
    mTarget.zeroParallax = std::max(mTarget.zeroParallax * factor, mTarget.separation / kLargestSeparation);
}

void ViewStereo::setSeparation(double metres) {
    if (!(metres >= 0)) return;
    takeOver();
    setTarget({metres, mTarget.zeroParallax});
}

void ViewStereo::setZeroParallax(double metres) {
    if (!(metres > 0) || !std::isfinite(metres)) return;
    takeOver();
    mTarget.zeroParallax = std::max(metres, mTarget.separation / kLargestSeparation);
}

bool ViewStereo::clamping() const {
    return !follows() && mComfort.share() < 1 - kSettled;
}

void ViewStereo::adopt(const StereoSetting& fitting) {
    mFitted = differs(fitting, mNow);
    mFits = false;
    mStart = mNow = mTarget = mByHand = fitting;
    mComfort.restart();
    if (follows()) follow();  // follows from the new setting
}

void ViewStereo::refit(const Scene& scene) {
    if (!mFitted || follows()) return;
    mNow = mTarget = mByHand = scene.stereo;
    mFits = true;
    mComfort.restart();
}

void ViewStereo::observe(const ViewFrame& frame, bool fitsNow) {
    const FrameRequest& request = frame.request;
    if (!request.twoEyes) return;
    mSeen = true;
    if (mFits && request.fitEyes && fitsNow)
        adopt({request.stereo.separation / mZoom, request.stereo.zeroParallax / mZoom});
    mComfort.observe(request.stereo.separation / mZoom, {frame.nearParallax, frame.farParallax});
}

void ViewStereo::stepByHand(double dt) {
    mByHand.separation = approach(mByHand.separation, mTarget.separation, dt);
    mByHand.zeroParallax = approach(mByHand.zeroParallax, mTarget.zeroParallax, dt);
    const StereoSetting wanted = mClamp ? mComfort.limited(mByHand, dt, 0) : mComfort.released(mByHand, dt);
    if (mComfort.share() == 1 || differs(wanted, mNow)) mNow = wanted;
}

// Lets eyes that follow from the start reach their final place with the first picture, before anybody has
// looked at it: a resting picture is not refined while they move.
void ViewStereo::arrive(double free, double depth, double dt) {
    constexpr double kLong_s = 60;
    constexpr int kMostSteps = 1000;  // a follower may limit each step
    constexpr double kArrived = 1e-6;
    StereoSetting arrived = mNow;
    for (int n = 0; n < kMostSteps; ++n) {
        const StereoSetting next = mFollower(free, depth, kLong_s);
        const bool there = !differs(next, arrived, kArrived);
        arrived = next;
        if (there) break;
    }
    mNow = mComfort.limited(arrived, dt);
    mArrives = false;
}

void ViewStereo::step(double free, double depth, double dt) {
    const StereoSetting before = now();
    mZoom = approach(mZoom, mZoomTo, dt);
    if (mFollower && mArrives && mSeen && dt > 0) {
        arrive(free, depth, dt);
    } else if (mFollower) {
        const StereoSetting wanted = mComfort.limited(mFollower(free, depth, dt), dt);
        if (differs(wanted, mNow)) mNow = wanted;
    } else {
        stepByHand(dt);
    }
    const StereoSetting after = now();
    mMoving = before.separation != after.separation || before.zeroParallax != after.zeroParallax;
}

}  // namespace stereonav
