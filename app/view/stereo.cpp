#include "app/view/stereo.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/view/status.h"

namespace stereonav {
namespace {

constexpr double kStereoSeconds = 0.35;      // time constant: eyes follow a slow change, not a jump
constexpr double kSettled = 1e-3;            // relative difference at which a slow change ends
constexpr double kFirstSeparation = 1e-3;    // of the zero-parallax distance: the step up from none
constexpr double kLargestSeparation = 0.25;  // of the zero-parallax distance
constexpr double kFollowed = 1e-5;           // relative change below which following counts as done

// Exponential approach in the logarithm, so that halving and doubling feel alike.
double approach(double now, double target, double dt) {
    if (!(now > 0) || !(target > 0) || std::abs(now - target) <= kSettled * target) return target;
    return target * std::pow(now / target, std::exp(-dt / kStereoSeconds));
}

}  // namespace

ViewStereo::ViewStereo(const Scene& scene) {
    reset(scene);
    mNow = mTarget;
    if (follows()) follow();  // from there
}

void ViewStereo::look(const Scene& scene) {
    mRoom = scene.offered<RoomAround>();
    mLargest = mRoom ? mRoom->largestSeparation() : std::numeric_limits<double>::infinity();
}

void ViewStereo::reset(const Scene& scene) {
    mTarget = scene.stereo;
    look(scene);
    mFollower = nullptr;
    if (mRoom && mRoom->followsAtStart()) follow();
}

void ViewStereo::replaceScene(const Scene& scene) {
    look(scene);
    if (follows()) follow();
    mTarget.separation = std::min(mTarget.separation, mLargest);
}

void ViewStereo::follow() {
    mFollower = mRoom ? mRoom->makeFollower(mNow) : nullptr;
}

void ViewStereo::scaleSeparation(double factor) {
    if (follows()) mTarget = mNow;
    mFollower = nullptr;
    const double least = kFirstSeparation * mTarget.zeroParallax;
    mTarget.separation =
        factor > 1 ? std::max(mTarget.separation * factor, least) : mTarget.separation * factor;
    if (mTarget.separation < least) mTarget.separation = 0;
    mTarget.separation = std::min({mTarget.separation, kLargestSeparation * mTarget.zeroParallax, mLargest});
}

void ViewStereo::setSeparation(double separation) {
    if (follows()) mTarget = mNow;
    mFollower = nullptr;
    mTarget.separation = std::min({separation, kLargestSeparation * mTarget.zeroParallax, mLargest});
}

void ViewStereo::scaleZeroParallax(double factor) {
    if (follows()) mTarget = mNow;
    mFollower = nullptr;
    mTarget.zeroParallax = std::max(mTarget.zeroParallax * factor, mTarget.separation / kLargestSeparation);
}

void ViewStereo::observe(const ViewFrame& frame) {
    if (frame.request.twoEyes)
        mComfort.observe(frame.request.stereo.separation, {frame.nearParallax, frame.farParallax});
}

void ViewStereo::step(double free, double depth, double dt) {
    const StereoSetting before = mNow;
    if (mFollower) {
        const StereoSetting wanted = mComfort.limited(mFollower(free, depth, dt), dt);
        const auto differs = [](double a, double b) { return std::abs(a - b) > kFollowed * b; };
        if (differs(wanted.separation, mNow.separation) || differs(wanted.zeroParallax, mNow.zeroParallax))
            mNow = wanted;
    } else {
        mNow.separation = approach(mNow.separation, mTarget.separation, dt);
        mNow.zeroParallax = approach(mNow.zeroParallax, mTarget.zeroParallax, dt);
    }
    mMoving = before.separation != mNow.separation || before.zeroParallax != mNow.zeroParallax;
}

}  // namespace stereonav
